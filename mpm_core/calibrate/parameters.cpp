#include "calibrate/parameters.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "solver/material/law_table.hpp"

namespace granulaw {

namespace {

struct Named
{
  std::string name;
  bool is_stress;
  double LawMaterial::*member;  ///< null: a key of a hardening law
};

/// In the order of Parameter, then of the solver's list.
const std::vector<Named>& known()
{
  static const std::vector<Named> all = [] {
    std::vector<Named> names{{"youngs_modulus", true, &LawMaterial::youngs_modulus},
                             {"yield_stress", true, &LawMaterial::yield_stress},
                             {"hardening_modulus", true, &LawMaterial::hardening_modulus}};
    for (const FlowLawKeys& law : hardening_laws())
      for (const flow::Parameter& p : law.parameters) {
        const auto is_it = [&](const Named& n) { return n.name == p.key; };
        if (law.name != flow::Linear::name && p.is_fitted() &&
            std::none_of(names.begin(), names.end(), is_it))
          names.push_back({p.key, p.quantity == flow::Quantity::stress, nullptr});
      }
    return names;
  }();
  return all;
}

const Named& entry(Parameter parameter)
{
  return known()[static_cast<std::size_t>(parameter)];
}

const FlowLawKeys& keys_of(const std::string& law)
{
  const std::string name = law.empty() ? flow::Linear::name : law;
  return *std::find_if(hardening_laws().begin(), hardening_laws().end(),
                       [&](const FlowLawKeys& k) { return k.name == name; });
}

/// The law's own declaration of a parameter.
const flow::Parameter& declared(const CandidateMaterial& m, Parameter parameter)
{
  const std::vector<flow::Parameter>& own = keys_of(m.hardening.name).parameters;
  if (m.hardens_linearly()) return own.front();
  return *std::find_if(own.begin(), own.end(),
                       [&](const flow::Parameter& p) { return name_of(parameter) == p.key; });
}

}  // namespace

const std::string& name_of(Parameter parameter)
{
  return entry(parameter).name;
}

std::vector<std::string> parameter_names()
{
  std::vector<std::string> names;
  for (const Named& n : known()) names.push_back(n.name);
  return names;
}

Parameter parameter_named(const std::string& name, const std::string& where)
{
  const std::vector<std::string> names = parameter_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) fail_unknown(where, "no parameter", name, names);
  return static_cast<Parameter>(found - names.begin());
}

bool is_stress(Parameter parameter)
{
  return entry(parameter).is_stress;
}

Material solver_material(const CandidateMaterial& m)
{
  Material material{m.density, m.youngs_modulus, m.poisson_ratio, m.yield_stress, m.hardening_modulus};
  if (m.hardens_linearly()) return material;
  material.hardening_modulus = 0, material.hardening = m.hardening;
  for (const flow::Parameter& p : keys_of(m.hardening.name).parameters)
    if (!p.is_fitted()) {
      double& set_by_yield = (material.hardening.values[p.key] = {1.0}).front();
      set_by_yield = m.yield_stress / flow_stress(material, 0);
    }
  return material;
}

FlowCurve flow_curve(const CandidateMaterial& m)
{
  if (m.hardens_linearly()) return {};
  return [solid = solver_material(m)](double strain) { return flow_stress(solid, strain) / solid.yield_stress; };
}

std::vector<std::string> fitted_hardening_laws()
{
  std::vector<std::string> names;
  for (const FlowLawKeys& law : hardening_laws())
    if (std::none_of(law.parameters.begin(), law.parameters.end(),
                     [](const flow::Parameter& p) { return p.list; }))
      names.push_back(law.name);
  return names;
}

std::vector<Parameter> parameters_of(const std::string& law)
{
  if (law.empty() || law == flow::Linear::name) return {Parameter::hardening_modulus};
  std::vector<Parameter> own;
  for (const flow::Parameter& p : keys_of(law).parameters)
    if (p.is_fitted()) own.push_back(parameter_named(p.key, law));
  return own;
}

Range range_of(const CandidateMaterial& m, Parameter parameter)
{
  const flow::Parameter& p = declared(m, parameter);
  return {std::max(p.least, p.least_per_yield * m.yield_stress), p.most};
}

double start_of(const CandidateMaterial& m, Parameter parameter, double gain, double strain)
{
  return declared(m, parameter).start.at(m.yield_stress, gain, strain);
}

double value_of(const CandidateMaterial& m, Parameter parameter)
{
  const Named& named = entry(parameter);
  if (named.member) return m.*named.member;
  const auto found = m.hardening.values.find(named.name);
  return found == m.hardening.values.end() || found->second.empty() ? 0 : found->second.front();
}

void set_value(CandidateMaterial& m, Parameter parameter, double value)
{
  const Named& named = entry(parameter);
  if (named.member)
    m.*named.member = value;
  else
    m.hardening.values[named.name] = {value};
}

void set_value(LawMaterial& m, Parameter parameter, double value)
{
  m.*entry(parameter).member = value;
}

}  // namespace granulaw
