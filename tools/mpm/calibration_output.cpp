#include "calibration_output.hpp"

#include <fmt/format.h>

#include "calibrate/kind/kind.hpp"
#include "calibrate/material_toml.hpp"
#include "json_output.hpp"

namespace granulaw {

namespace {

nlohmann::ordered_json measurement_json(const CalibrationProblem& problem, const Calibration& c, std::size_t k)
{
  const Measurement& m = problem.request().measurements[k];
  const CalibrationProblem::Comparison compared = problem.compare(c.minimum.q, k);
  nlohmann::ordered_json out;
  out["source"] = m.source;
  out["kind"] = m.kind->name;
  if (const auto flow = flow_shown(m, c.material)) out["flow_strain"] = flow->strain, out["flow_stress"] = flow->stress;
  if (m.fit_offset) out["offset_m"] = c.machines[k].offset;
  if (m.fit_compliance) {
    out["compliance_m_per_N"] = c.machines[k].compliance;
    if (c.compliances[k]) out["compliance_low95"] = c.compliances[k]->low, out["compliance_high95"] = c.compliances[k]->high;
  }
  std::vector<double> x, y;
  std::vector<int> rows;
  for (const Datum& d : m.data) x.push_back(d.x), y.push_back(d.y), rows.push_back(d.rows);
  out["x"] = x, out["measured"] = y, out["rows"] = rows, out["sd"] = compared.sd, out["fit"] = compared.with_errors;
  const Band band = band_of(problem, c, k);
  std::vector<double> sd;
  for (std::size_t i = 0; i < band.low.size(); ++i) sd.push_back((band.high[i] - band.low[i]) / (2 * normal95));
  out["fit_sd"] = sd, out["fit_low95"] = band.low, out["fit_high95"] = band.high;
  return out;
}

}  // namespace

nlohmann::ordered_json calibration_json(const CalibrationProblem& problem, const Calibration& c)
{
  nlohmann::ordered_json out;
  for (const FittedParameter& p : c.parameters) {
    const Interval &a = p.profile.within68, &b = p.profile.within95;
    out["parameters"][name_of(p.parameter)] = {{"value", json_number(p.profile.value)}, {"low68", json_number(a.low)}, {"high68", json_number(a.high)},
        {"low95", json_number(b.low)}, {"high95", json_number(b.high)}, {"unit", is_stress(p.parameter) ? "Pa" : ""}, {"identifiable", p.identifiable()},
        {"told", name_of(p.told)}};
  }
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (Eigen::Index a = 0; a < c.correlation.rows(); ++a) {
    std::vector<double> row;
    for (Eigen::Index b = 0; b < c.correlation.cols(); ++b) row.push_back(c.correlation(a, b));
    rows.push_back(row);
  }
  out["correlation"] = rows;
  out["chi2"] = json_number(c.chi_squared);
  out["degrees_of_freedom"] = c.degrees_of_freedom;
  out["p_value"] = json_number(c.p_value);
  out["interval_scale"] = c.widening.scale;
  out["verdict"] = verdict(problem, c);
  out["bound"] = c.bound;
  out["followed"] = c.followed;
  out["misfits"] = nlohmann::ordered_json::array();
  for (const Misfit& m : c.misfits) out["misfits"].push_back({{"source", m.source}, {"name", m.name}, {"sentence", m.sentence}});
  out["material"] = {{"density", c.material.density}, {"youngs_modulus", c.material.youngs_modulus}, {"poisson_ratio", c.material.poisson_ratio},
      {"yield_stress", c.material.yield_stress}, {"hardening_modulus", c.material.hardening_modulus}};
  if (!c.material.hardens_linearly()) {
    const FlowLaw law = solver_material(c.material).hardening;
    out["material"]["hardening"]["law"] = law.name;
    for (const auto& [key, values] : law.values) out["material"]["hardening"][key] = values.front();
  }
  out["measurements"] = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < problem.request().measurements.size(); ++k) out["measurements"].push_back(measurement_json(problem, c, k));
  return out;
}

void print_calibration(const CalibrationProblem& problem, const Calibration& c)
{
  fmt::print("{:<20}{:>12}{:>26}{:>26}\n", "", "SI", "68 %", "95 %");
  for (const FittedParameter& p : c.parameters) {
    const Interval &a = p.profile.within68, &b = p.profile.within95;
    if (!c.has_values()) {
      fmt::print("{:<20}{:>12.4g}{:>26}{:>26}\n", name_of(p.parameter), p.profile.value, "no interval", name_of(p.told));
      continue;
    }
    fmt::print("{:<20}{:>12.4g}{:>12.4g} to {:<10.4g}{:>12.4g} to {:<10.4g}{}\n", name_of(p.parameter), p.profile.value, a.low, a.high, b.low, b.high,
        p.identifiable() ? "" : name_of(p.told));
  }
  for (std::size_t k = 0; k < c.machines.size(); ++k) {
    const Measurement& m = problem.request().measurements[k];
    if (m.fit_offset) fmt::print("first touch of {}: {:.4g} m\n", m.source, c.machines[k].offset);
    if (m.fit_compliance)
      fmt::print("compliance of {}: {:.4g} m/N{}\n", m.source, c.machines[k].compliance,
          c.compliances[k] ? fmt::format(", 95 %: {:.4g} to {:.4g}", c.compliances[k]->low, c.compliances[k]->high) : "");
  }
  fmt::print("chi^2 {:.4g} of {} degrees of freedom, p = {:.2g}\n{}\n", c.chi_squared, c.degrees_of_freedom, c.p_value, verdict(problem, c));
}

}  // namespace granulaw
