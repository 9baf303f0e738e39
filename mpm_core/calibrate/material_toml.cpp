#include "calibrate/material_toml.hpp"

#include <fmt/format.h>

namespace granulaw {

std::string interval_comments(const CalibrationProblem& problem, const Calibration& c)
{
  std::string text;
  for (const FittedParameter& p : c.parameters) {
    if (p.told == Told::at_bound) continue;
    text +=
        fmt::format("# {}: {:.4g}{}, 68 %: {:.4g} to {:.4g}, 95 %: {:.4g} to {:.4g}{}\n",
                    name_of(p.parameter), p.profile.value, is_stress(p.parameter) ? " Pa" : "",
                    p.profile.within68.low, p.profile.within68.high, p.profile.within95.low,
                    p.profile.within95.high, p.identifiable() ? "" : fmt::format(" ({})", name_of(p.told)));
  }
  return text + fmt::format("# {}\n", verdict(problem, c));
}

std::string material_toml(const CandidateMaterial& m, const std::string& comments)
{
  std::string text = comments + fmt::format(
                                    "[material.{}]\ndensity = {:.6g}\nyoungs_modulus = {:.6g}\n"
                                    "poisson_ratio = {:.6g}\nyield_stress = {:.6g}\n",
                                    m.name, m.density, m.youngs_modulus, m.poisson_ratio, m.yield_stress);
  if (!m.hardens_linearly()) {
    const FlowLaw law = solver_material(m).hardening;
    text += fmt::format("hardening = {{law = \"{}\"", law.name);
    for (const auto& [key, values] : law.values) text += fmt::format(", {} = {:.8g}", key, values.front());
    return text + "}\n";
  }
  if (m.hardening_modulus > 0)
    text += fmt::format("hardening = {{law = \"linear\", modulus = {:.6g}}}\n", m.hardening_modulus);
  return text;
}

}  // namespace granulaw
