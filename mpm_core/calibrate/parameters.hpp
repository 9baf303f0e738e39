#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "law/law_material.hpp"

namespace granulaw {

/// The numbers of a material that a fit may find, by their names in a materials file; hardening_modulus is
/// the `modulus` of linear hardening.
enum class Parameter { youngs_modulus, yield_stress, hardening_modulus };
inline constexpr std::array all_parameters{Parameter::youngs_modulus, Parameter::yield_stress,
                                           Parameter::hardening_modulus};

const char* name_of(Parameter parameter);
/// Throws Error naming `where` and the nearest name.
Parameter parameter_named(const std::string& name, const std::string& where);
std::vector<std::string> parameter_names();

double value_of(const LawMaterial& material, Parameter parameter);
void set_value(LawMaterial& material, Parameter parameter, double value);

/// What is known of a parameter before the data: 95 % of a normal distribution of its logarithm lie between;
/// or a limit that it never exceeds.
struct Range
{
  double low = 0, high = std::numeric_limits<double>::infinity();
};
struct ParameterRange
{
  Parameter parameter;
  Range range;
};

}  // namespace granulaw
