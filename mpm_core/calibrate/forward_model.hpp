#pragma once

#include <vector>

#include "calibrate/measurement.hpp"
#include "calibrate/sphere_laws.hpp"
#include "law/law_material.hpp"

namespace granulaw {

/// What a measurement adds to the unknowns.
struct MachineState
{
  double offset = 0;      ///< m, displacement at first touch
  double compliance = 0;  ///< m/N
  double beyond = 0;      ///< m, displacement at which the curve turned, less the largest of its data
};

/// Values that a material would show, and how far the model itself may be off.
struct Prediction
{
  std::vector<double> values;  ///< of Measurement::data
  /// What one standard deviation of each of the model's own errors changes of the values. An error of the
  /// model is a smooth function of speed or overlap, no scatter: Legendre polynomials, whose factors a fit
  /// has for unknowns of mean 0.
  std::vector<std::vector<double>> errors;
  std::vector<double> scatter;  ///< sd of what is left of it, which differs from value to value
  double beyond = 0;  ///< ln of how far the fastest impact is beyond what the atlas tells; 0: within
};

/// Predicts a measurement of spheres of this material; an indenter's curve by its own law (IndenterModel) and
/// predict_curve().
Prediction predict(const Measurement& measurement, const CandidateMaterial& material, const SphereLaws& laws,
                   const MachineState& machine);

/// A contact's slow law, the units that bring it to a measured curve, and its errors (sd).
struct CurveModel
{
  const ContactCurve* curve;
  double length, force;   ///< m, N
  double force_error;     ///< relative
  double recovery_error;  ///< of the unloading, over the largest overlap less the residual
};
Prediction predict_curve(const Measurement& measurement, const CurveModel& model,
                         const MachineState& machine);

/// How many Prediction::errors a kind has.
std::size_t model_errors_of(MeasurementKind kind);

/// Hardness over the flow stress: Johnson's expanding cavity for the cone that is as a Vickers pyramid (70.3
/// degrees; Johnson 1985, eq. 6.36), 3 at most; the flow stress is that at a strain of 8 % (Tabor 1951).
double hardness_of(const CandidateMaterial& material);

/// Force on a flat at which a sphere begins to yield (Johnson 1985, sect. 6.1).
double onset_force(const LawMaterial& material, double radius);

}  // namespace granulaw
