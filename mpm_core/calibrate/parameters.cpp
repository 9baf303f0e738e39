#include "calibrate/parameters.hpp"

#include <cmath>

#include "base/error.hpp"
#include "characterise/law_material.hpp"

namespace granulaw {

namespace {

struct Named
{
  Parameter parameter;
  const char* name;
  bool is_stress;
  double CandidateMaterial::*member;
};
constexpr Named known[] = {
    {Parameter::youngs_modulus, "youngs_modulus", true, &CandidateMaterial::youngs_modulus},
    {Parameter::yield_stress, "yield_stress", true, &CandidateMaterial::yield_stress},
    {Parameter::hardening_modulus, "hardening_modulus", true, &CandidateMaterial::hardening_modulus},
    {Parameter::saturation_stress, "saturation_stress", true, &CandidateMaterial::saturation_stress},
    {Parameter::strain, "strain", false, &CandidateMaterial::strain},
    {Parameter::strength, "strength", true, &CandidateMaterial::strength},
    {Parameter::exponent, "exponent", false, &CandidateMaterial::exponent},
    {Parameter::offset, "offset", false, &CandidateMaterial::offset}};

const Named& entry(Parameter parameter)
{
  return known[static_cast<std::size_t>(parameter)];
}

/// The law's own parameters as the solver knows them.
FlowLaw flow_law(const CandidateMaterial& m)
{
  if (m.hardening == "voce")
    return {"voce", {{"saturation_stress", {m.saturation_stress}}, {"strain", {m.strain}}}};
  if (m.hardening == "swift")
    return {"swift",
            {{"strength", {m.yield_stress / std::pow(m.offset, m.exponent)}},
             {"exponent", {m.exponent}},
             {"offset", {m.offset}}}};
  return {"johnson-cook", {{"strength", {m.strength}}, {"exponent", {m.exponent}}}};
}

}  // namespace

const char* name_of(Parameter parameter)
{
  return entry(parameter).name;
}

std::vector<std::string> parameter_names()
{
  std::vector<std::string> names;
  for (const Named& n : known) names.emplace_back(n.name);
  return names;
}

Parameter parameter_named(const std::string& name, const std::string& where)
{
  for (const Named& n : known)
    if (name == n.name) return n.parameter;
  fail_unknown(where, "no parameter", name, parameter_names());
}

bool is_stress(Parameter parameter)
{
  return entry(parameter).is_stress;
}

double CandidateMaterial::flow(double plastic_strain) const
{
  if (hardening == "voce") {
    const double most = saturation_stress / yield_stress;
    return most - (most - 1) * std::exp(-plastic_strain / strain);
  }
  if (hardening == "swift") return std::pow(1 + plastic_strain / offset, exponent);
  if (hardening == "johnson-cook") return 1 + strength / yield_stress * std::pow(plastic_strain, exponent);
  return 1 + hardening_modulus / yield_stress * plastic_strain;
}

std::vector<std::string> fitted_hardening_laws()
{
  return {"linear", "voce", "swift", "johnson-cook"};
}

std::vector<Parameter> parameters_of(const std::string& law)
{
  if (law == "voce") return {Parameter::saturation_stress, Parameter::strain};
  if (law == "swift") return {Parameter::exponent, Parameter::offset};
  if (law == "johnson-cook") return {Parameter::strength, Parameter::exponent};
  return {Parameter::hardening_modulus};
}

Range range_of(Parameter parameter)
{
  switch (parameter) {
    case Parameter::strain:
      return {1e-4, 10};
    case Parameter::exponent:
      return {0.05, 1};  // the solver's
    case Parameter::offset:
      return {1e-5, 10};
    default:
      return {};
  }
}

Material solver_material(const CandidateMaterial& m)
{
  Material material = material_of(m);
  if (!m.hardens_linearly()) material.hardening_modulus = 0, material.hardening = flow_law(m);
  return material;
}

double value_of(const CandidateMaterial& m, Parameter parameter)
{
  return m.*entry(parameter).member;
}

void set_value(CandidateMaterial& m, Parameter parameter, double value)
{
  m.*entry(parameter).member = value;
}

void set_value(LawMaterial& m, Parameter parameter, double value)
{
  CandidateMaterial candidate(m);
  set_value(candidate, parameter, value);
  m = candidate;
}

}  // namespace granulaw
