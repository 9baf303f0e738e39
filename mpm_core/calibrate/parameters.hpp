#pragma once

#include <limits>
#include <string>
#include <vector>

#include "atlas/stand_in.hpp"
#include "law/law_material.hpp"
#include "solver/material/material.hpp"

namespace granulaw {

/// A number of a material that a fit may find. Those beyond the named ones belong to hardening laws: the keys
/// that the laws of solver/material/laws.hpp declare with a start; parameter_named() has them.
enum class Parameter : int { youngs_modulus, yield_stress, hardening_modulus };

/// Names as in a materials file; hardening_modulus is the `modulus` of linear hardening.
const std::string& name_of(Parameter parameter);
/// Throws Error naming `where` and the nearest name.
Parameter parameter_named(const std::string& name, const std::string& where);
std::vector<std::string> parameter_names();
bool is_stress(Parameter parameter);  ///< Pa; else a pure number

/// Ends of what is allowed, or of what 95 % of a normal distribution of the logarithm lie between.
struct Range
{
  double low = 0, high = std::numeric_limits<double>::infinity();
};
struct ParameterRange
{
  Parameter parameter;
  Range range;
};

/// A material that a fit tries: the numbers of a law file, or another hardening law in place of the linear
/// one.
struct CandidateMaterial : LawMaterial
{
  CandidateMaterial() = default;
  CandidateMaterial(LawMaterial m) : LawMaterial(std::move(m)) {}  // NOLINT: every law's material is one

  FlowLaw hardening;  ///< no name: linear. A key that the yield stress sets is left out

  bool hardens_linearly() const { return hardening.name.empty(); }
};

/// The solver's material.
Material solver_material(const CandidateMaterial& material);
/// Its flow curve; null: it hardens linearly.
FlowCurve flow_curve(const CandidateMaterial& material);

/// Hardening laws that can be fitted: the solver's whose keys are all numbers. "linear" is among them.
std::vector<std::string> fitted_hardening_laws();
/// The parameters of one, by its name; none or "linear": of linear hardening.
std::vector<Parameter> parameters_of(const std::string& hardening_law);
/// Range of a parameter of the material's hardening law that the solver takes.
Range range_of(const CandidateMaterial& material, Parameter parameter);
/// Start of the search: the flow stress is (1 + gain) Y at about `strain`.
double start_of(const CandidateMaterial& material, Parameter parameter, double gain, double strain);

double value_of(const CandidateMaterial& material, Parameter parameter);  ///< 0: not given
void set_value(CandidateMaterial& material, Parameter parameter, double value);
void set_value(LawMaterial& material, Parameter parameter, double value);

}  // namespace granulaw
