#pragma once

#include <functional>

#include "calibrate/parameters.hpp"
#include "atlas/atlas.hpp"
#include "contact/curve.hpp"

namespace granulaw {

/// Static flow stress over the yield stress, of the equivalent plastic strain; 1 at 0.
using FlowCurve = std::function<double(double strain)>;
/// That of a material, by the solver's flow law.
FlowCurve flow_curve(const CandidateMaterial& material);

/// The law of a sphere whose hardening is not linear, from the atlas's linear ones, no run.
///
/// A contact shows the flow stress at one strain (Tabor 1951): representative_strain times what the contact's
/// radius has grown by since the onset of yield, over R. So at each overlap the law is the linearly hardening
/// one whose flow stress at that strain is the same. `stiffness`, `poisson_ratio`: of the material. It is
/// within 3 % of F (docs/develop/calibration.md); differences between near materials are far better: what a fit
/// needs.
LawShape flow_shape(const Atlas& atlas, double stiffness, double poisson_ratio, const FlowCurve& flow);
/// Tabor has 0.2; this one serves Voce's, Swift's and Johnson and Cook's laws best (docs/develop/calibration.md).
inline constexpr double representative_strain = 0.23;

/// What a law of the material's own departs from its flow_shape() by: a shape that is added. Both are of the
/// same onset. Beyond the own law's end it keeps its last value; velocity effects are left as they are.
LawShape departure(const Curve& own, const Curve& stand_in);

}  // namespace granulaw
