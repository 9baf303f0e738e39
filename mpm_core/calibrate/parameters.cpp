#include "calibrate/parameters.hpp"

#include "base/error.hpp"

namespace granulaw {

const char* name_of(Parameter parameter)
{
  switch (parameter) {
    case Parameter::youngs_modulus:
      return "youngs_modulus";
    case Parameter::yield_stress:
      return "yield_stress";
    default:
      return "hardening_modulus";
  }
}

std::vector<std::string> parameter_names()
{
  std::vector<std::string> names;
  for (const Parameter p : all_parameters) names.emplace_back(name_of(p));
  return names;
}

Parameter parameter_named(const std::string& name, const std::string& where)
{
  for (const Parameter p : all_parameters)
    if (name == name_of(p)) return p;
  fail_unknown(where, "no parameter", name, parameter_names());
}

double value_of(const LawMaterial& m, Parameter parameter)
{
  switch (parameter) {
    case Parameter::youngs_modulus:
      return m.youngs_modulus;
    case Parameter::yield_stress:
      return m.yield_stress;
    default:
      return m.hardening_modulus;
  }
}

void set_value(LawMaterial& m, Parameter parameter, double value)
{
  switch (parameter) {
    case Parameter::youngs_modulus:
      m.youngs_modulus = value;
      break;
    case Parameter::yield_stress:
      m.yield_stress = value;
      break;
    default:
      m.hardening_modulus = value;
  }
}

}  // namespace granulaw
