#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "calibrate/calibrate.hpp"
#include "calibrate/kind/kind.hpp"

namespace granulaw {

namespace {

/// "41 MPa", "3.2 GPa".
std::string stress(double pa)
{
  struct Unit
  {
    double size;
    const char* name;
  };
  for (const Unit u : {Unit{1e9, "GPa"}, Unit{1e6, "MPa"}, Unit{1e3, "kPa"}})
    if (pa >= u.size) return fmt::format("{:.3g} {}", pa / u.size, u.name);
  return fmt::format("{:.3g} Pa", pa);
}

/// 180 for 184, where {:.2g} would have 1.8e+02.
std::string two_digits(double value)
{
  return value < 99.5 ? fmt::format("{:.2g}", value) : fmt::format("{:g}", std::stod(fmt::format("{:.1e}", value)));
}

/// The range of the data, as the beginning of a sentence.
std::string span_of(const CalibrationProblem& problem, const Calibration& c)
{
  const std::shared_ptr<const SphereLaws> kept = problem.laws().of(c.material);
  const SphereLaws& laws = *kept;
  Reach all;
  for (std::size_t k = 0; k < problem.request().measurements.size(); ++k) {
    const Measurement& m = problem.request().measurements[k];
    const Reach r = m.kind->reach(m, {c.material, laws, c.machines[k]});
    all.slowest = std::min(all.slowest, r.slowest), all.fastest = std::max(all.fastest, r.fastest);
    all.overlap_over_onset = std::max(all.overlap_over_onset, r.overlap_over_onset);
  }
  std::string span;
  if (all.fastest > 0)
    span = all.fastest < 2
               ? fmt::format("These impacts are all below {:.2g} V_y", all.fastest)
           : two_digits(all.slowest) == two_digits(all.fastest)
               ? fmt::format("These impacts are at {} V_y", two_digits(all.fastest))
               : fmt::format("These impacts are at {} to {} V_y", two_digits(all.slowest), two_digits(all.fastest));
  if (all.overlap_over_onset > 0)
    span += (span.empty() ? "The curve goes to " : ", the curve to ") +
            fmt::format("{:.3g} times the overlap at which yield begins", all.overlap_over_onset);
  return span.empty() ? "These data" : span;
}

std::string clause(const FittedParameter& p)
{
  const auto number = [&](double value) {
    return is_stress(p.parameter) ? stress(value) : fmt::format("{:.3g}", value);
  };
  const Interval& i = p.profile.within95;
  switch (p.told) {
    case Told::value:
      return fmt::format("{} is {} (95 %: {} to {})", name_of(p.parameter), number(p.profile.value),
                         number(i.low), number(i.high));
    case Told::from_below:
      return fmt::format("they bound {} from below (95 %: over {})", name_of(p.parameter), number(i.low));
    case Told::from_above:
      return i.low_told ? fmt::format("{} lies between {} and {} (95 %), not determined more closely",
                                      name_of(p.parameter), number(i.low), number(i.high))
                        : fmt::format("they bound {} from above (95 %: below {})", name_of(p.parameter),
                                      number(i.high));
    default:
      return fmt::format("they do not determine {}", name_of(p.parameter));
  }
}

std::string names_of(const Calibration& c)
{
  std::string names;
  for (const FittedParameter& p : c.parameters) names += (names.empty() ? "" : ", ") + name_of(p.parameter);
  return names;
}

std::string bound_clause(const Calibration& c)
{
  return fmt::format(
      "the fit lies at an end of the method's range, {}: neither value nor interval of {}. A value may be in "
      "another unit than SI, what is held fixed may be wrong, or the material lies outside.",
      c.bound, names_of(c));
}

std::string misfit_clauses(const Calibration& c)
{
  std::string text;
  for (const Misfit& m : c.misfits)
    text += m.source.empty() ? fmt::format(" Misfit: {}.", m.sentence)
                             : fmt::format(" Misfit of {}: {}.", m.source, m.sentence);
  return text;
}

std::string correlation_clause(const Calibration& c)
{
  constexpr double strong = 0.95;
  std::string said;
  for (Eigen::Index a = 0; a < c.correlation.rows(); ++a)
    for (Eigen::Index b = 0; b < a; ++b)
      if (std::abs(c.correlation(a, b)) > strong)
        said += fmt::format(
            " {} and {} change together (correlation {:.2f}): one known would determine the other.",
            name_of(c.parameters[static_cast<std::size_t>(b)].parameter),
            name_of(c.parameters[static_cast<std::size_t>(a)].parameter), c.correlation(a, b));
  return said;
}

/// The flow stress that a hardness shows, by its strain.
std::string flow_clause(const CalibrationProblem& problem, const Calibration& c)
{
  std::string said;
  for (const Measurement& m : problem.request().measurements)
    if (const auto flow = flow_shown(m, c.material))
      said += fmt::format(
          " {} shows the flow stress at a plastic strain of {:.2g} %, {}{}.", m.source, 100 * flow->strain,
          stress(flow->stress),
          flow->stress > c.material.yield_stress ? "" : ": yield_stress is that, and first yield only without hardening");
  return said;
}

/// The change by a machine that gives way, where it is more than a tenth of the interval's half.
std::string machine_clause(const Calibration& c)
{
  for (const FittedParameter& p : c.parameters) {
    const Interval& i = p.profile.within95;
    if (p.parameter != Parameter::youngs_modulus || !p.identifiable()) continue;
    if (std::abs(c.machine_shift) < 0.1 * 0.5 * std::log(i.high / i.low)) return "";
    return fmt::format(
        " The machine is taken as rigid: if it gave way by {:g} m/N, youngs_modulus would be {:.2g} % {} "
        "(--compliance fits it).",
        stiff_machine, 100 * std::abs(c.machine_shift), c.machine_shift > 0 ? "higher" : "lower");
  }
  return "";
}

/// Hardening and rate both make fast impacts bounce more; impacts of one speed show neither.
std::string rate_clause(const CalibrationProblem& problem, const Calibration& c)
{
  const auto& all = problem.request().measurements;
  const bool fast_only =
      std::all_of(all.begin(), all.end(), [](const Measurement& m) { return m.kind->needs_density; });
  const bool hardens = std::any_of(c.parameters.begin(), c.parameters.end(), [](const FittedParameter& p) {
    return p.parameter != Parameter::youngs_modulus && p.parameter != Parameter::yield_stress &&
           p.profile.within68.low > 0;
  });
  double slowest = 1e300, fastest = 0;
  for (const Measurement& m : all)
    for (const Datum& d : m.data) slowest = std::min(slowest, d.x), fastest = std::max(fastest, d.x);
  if (fast_only && fastest < 1.5 * slowest)
    return " Impacts of about one speed do not show how the yield stress changes with the strain rate: this is that of their rate.";
  return fast_only && hardens
             ? " Impacts alone do not distinguish hardening from a yield stress that grows with the strain "
               "rate: a slow curve beside them would."
             : "";
}

}  // namespace

std::string verdict(const CalibrationProblem& problem, const Calibration& c)
{
  constexpr double unlikely = 0.01;
  std::string text = span_of(problem, c) + ": ";
  if (!c.bound.empty()) return text + bound_clause(c);
  if (!c.followed)
    return text +
           fmt::format("no value of {} follows them, the differences are {:.2g} times the standard deviations (chi^2 "
                       "{:.3g} of {}): neither value nor interval.",
                       names_of(c), std::sqrt(c.chi_squared / static_cast<double>(c.degrees_of_freedom)), c.chi_squared, c.degrees_of_freedom) +
           misfit_clauses(c);
  for (std::size_t k = 0; k < c.parameters.size(); ++k)
    text.append(k > 0 ? "; " : "").append(clause(c.parameters[k]));
  text += "." + correlation_clause(c) + flow_clause(problem, c) + misfit_clauses(c) + rate_clause(problem, c) + machine_clause(c);
  if (c.degrees_of_freedom > 0 && c.p_value < unlikely)
    return text + fmt::format(" The data scatter more than stated (p = {:.2g}); the intervals are widened by {:.2g}.",
                              c.p_value, c.widening.deviations(0.95) / normal95);
  if (c.degrees_of_freedom == 0) return text + " No value is left over to test the fit.";
  return c.misfits.empty() ? text + " The fit is as good as the data." : text;
}

}  // namespace granulaw
