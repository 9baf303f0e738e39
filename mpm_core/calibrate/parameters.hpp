#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "law/law_material.hpp"
#include "solver/material/material.hpp"

namespace granulaw {

/// The numbers of a material that a fit may find, by their names in a materials file; hardening_modulus is
/// the `modulus` of linear hardening, those after it belong to other hardening laws.
enum class Parameter {
  youngs_modulus,
  yield_stress,
  hardening_modulus,
  saturation_stress,
  strain,
  strength,
  exponent,
  offset
};
inline constexpr std::array all_parameters{
    Parameter::youngs_modulus,    Parameter::yield_stress, Parameter::hardening_modulus,
    Parameter::saturation_stress, Parameter::strain,       Parameter::strength,
    Parameter::exponent,          Parameter::offset};

const char* name_of(Parameter parameter);
/// Throws Error naming `where` and the nearest name.
Parameter parameter_named(const std::string& name, const std::string& where);
std::vector<std::string> parameter_names();
bool is_stress(Parameter parameter);  ///< Pa; else a pure number

/// A material that a fit tries: the numbers of a law file, or another hardening law in place of the linear
/// one.
struct CandidateMaterial : LawMaterial
{
  CandidateMaterial() = default;
  CandidateMaterial(LawMaterial m) : LawMaterial(std::move(m)) {}  // NOLINT: every law's material is one

  std::string hardening;  ///< name of its law in a materials file; empty: linear
  double saturation_stress = 0, strain = 0, strength = 0, exponent = 0, offset = 0;  ///< of that law

  bool hardens_linearly() const { return hardening.empty(); }
  /// Flow stress over the yield stress.
  double flow(double plastic_strain) const;
};

/// Hardening laws that a fit knows, and their parameters; of Swift's law the strength follows from the yield
/// stress.
std::vector<std::string> fitted_hardening_laws();
std::vector<Parameter> parameters_of(const std::string& hardening_law);
/// What is known of a parameter before the data: 95 % of a normal distribution of its logarithm lie between;
/// or a limit that it never exceeds.
struct Range
{
  double low = 0, high = std::numeric_limits<double>::infinity();
};
/// What a parameter of a hardening law may be.
Range range_of(Parameter parameter);

/// The solver's material.
Material solver_material(const CandidateMaterial& material);

double value_of(const CandidateMaterial& material, Parameter parameter);
void set_value(LawMaterial& material, Parameter parameter, double value);
void set_value(CandidateMaterial& material, Parameter parameter, double value);

/// The same of a parameter.
struct ParameterRange
{
  Parameter parameter;
  Range range;
};

}  // namespace granulaw
