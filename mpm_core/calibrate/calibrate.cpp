#include "calibrate/calibrate.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>

#include "calibrate/kind/kind.hpp"
#include "calibrate/misfit.hpp"
#include "calibrate/profile_likelihood.hpp"

namespace granulaw {

namespace {

constexpr double widest =
    1.5;  // a parameter known to less than this factor, 20 % either way, is identifiable

/// An end at no hardening is one: nothing lies beyond.
bool ends_below(const CalibrationProblem& problem, std::size_t unknown, const ParameterProfile& p)
{
  return p.within95.low_told || (problem.unknowns()[unknown].is_hardening() && p.within95.low <= 0);
}

Eigen::MatrixXd correlation_of(const Minimum& minimum, std::size_t parameters)
{
  const auto n = static_cast<Eigen::Index>(parameters);
  Eigen::MatrixXd c = covariance(minimum).topLeftCorner(n, n);
  const Eigen::VectorXd sd = c.diagonal().cwiseSqrt();
  return sd.cwiseInverse().asDiagonal() * c * sd.cwiseInverse().asDiagonal();
}

}  // namespace

const char* name_of(Told told)
{
  switch (told) {
    case Told::value:
      return "value";
    case Told::from_below:
      return "from below";
    case Told::from_above:
      return "from above";
    case Told::at_bound:
      return "at a bound";
    case Told::not_followed:
      return "not followed";
    default:
      return "not determined";
  }
}

double Widening::deviations(double probability) const
{
  return std::sqrt(scale) * boost::math::quantile(boost::math::students_t(degrees), 0.5 + 0.5 * probability);
}

Told told_by(const CalibrationProblem& problem, std::size_t unknown, const ParameterProfile& p)
{
  const bool below = ends_below(problem, unknown, p), above = p.within95.high_told;
  double ratio = p.within95.high / p.within95.low;
  if (problem.unknowns()[unknown].is_hardening()) {
    const double yield = problem.unknowns()[unknown].scale * 2;
    ratio = (1 + 2 * p.within95.high / yield) / (1 + 2 * p.within95.low / yield);
  }
  if (below && above && ratio < widest) return Told::value;
  if (above) return Told::from_above;
  return p.within95.low_told ? Told::from_below : Told::nothing;
}

namespace {

void judge(Calibration& c, const CalibrationProblem& problem)
{
  constexpr double unlikely = 0.05;
  const CalibrationProblem::Scatter scatter = problem.scatter(c.minimum.q);
  c.chi_squared = scatter.chi_squared;
  c.degrees_of_freedom = static_cast<long>(problem.data_count() + problem.request().priors.size()) -
                         static_cast<long>(problem.fitted_count());
  c.p_value = 1, c.widening = {};
  if (c.degrees_of_freedom <= 0) return;
  const auto degrees = static_cast<double>(c.degrees_of_freedom);
  c.p_value = boost::math::gamma_q(degrees / 2, c.chi_squared / 2);
  // the variance of an estimate by a loss of slope psi is that of psi over psi' (Huber, Ann. Math. Statist.
  // 35, 1964); the curvature of the summed loss has one psi' of it already
  if (c.p_value < unlikely) c.widening = {c.chi_squared / degrees / scatter.share_within, degrees};
}

/// The differences from the fit have a pattern, and are too large for noise that was stated too small.
bool follows(const Calibration& c)
{
  constexpr double unlikely = 1e-3, most_scale = 4;  // intervals doubled
  const bool has_pattern = std::any_of(c.misfits.begin(), c.misfits.end(),
                                       [](const Misfit& m) { return m.name != misfit_of_outliers; });
  return !has_pattern || c.p_value >= unlikely || c.widening.scale <= most_scale;
}

/// Values alone, where they are none that the data determine.
void withdraw(Calibration& c, const CalibrationProblem& problem, Told told)
{
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  c.parameters.clear();
  for (std::size_t k = 0; k < problem.request().fit.size(); ++k) {
    FittedParameter f{problem.request().fit[k], {}, told};
    f.profile.value = problem.value(k, c.minimum.q[static_cast<Eigen::Index>(k)]);
    f.profile.within68 = f.profile.within95 = {none, none, false, false};
    c.parameters.push_back(f);
  }
}

/// The profiles of all parameters; where one of them meets a better minimum and `may_move`, only that.
std::optional<Coordinates> profile_all(Calibration& c, const CalibrationProblem& problem, bool may_move)
{
  c.parameters.clear();
  for (std::size_t k = 0; k < problem.request().fit.size(); ++k) {
    FittedParameter f{problem.request().fit[k], profile_likelihood(problem, c.minimum, k, c.widening)};
    if (may_move && f.profile.better) return f.profile.better;
    f.told = told_by(problem, k, f.profile);
    c.parameters.push_back(f);
  }
  return std::nullopt;
}

void add_compliances(Calibration& c, const CalibrationProblem& problem)
{
  c.compliances.assign(problem.request().measurements.size(), std::nullopt);
  for (std::size_t u = 0; u < problem.count(); ++u)
    if (problem.unknowns()[u].machine == &MachineState::compliance && c.has_values())
      c.compliances[problem.unknowns()[u].measurement] =
          profile_likelihood(problem, c.minimum, u, c.widening).within95;
}

/// Shift of Young's modulus if all curves' machines give way, at the minimum of the problem in which none
/// does.
double machine_shift_of(const CalibrationProblem& problem, const Calibration& c)
{
  CalibrationRequest request = problem.request();
  const auto modulus = std::find(request.fit.begin(), request.fit.end(), Parameter::youngs_modulus);
  bool curves = false;
  for (Measurement& m : request.measurements) {
    curves = curves || (m.kind->has_machine && !m.fit_compliance);
    m.fit_compliance = m.fit_compliance || m.kind->has_machine;
  }
  if (!curves || modulus == request.fit.end() || !request.known.hardens_linearly() || !c.has_values())
    return 0;
  const CalibrationProblem gives_way(problem.laws().atlas(), request);
  const auto count = static_cast<Eigen::Index>(gives_way.count());
  // the unknowns in their order, and the compliances that only this problem has
  Coordinates q(count), direction = Coordinates::Zero(count);
  std::vector<Eigen::Index> kept;
  Eigen::Index next = 0;
  for (Eigen::Index u = 0; u < count; ++u) {
    const CalibrationProblem::Unknown& unknown = gives_way.unknowns()[static_cast<std::size_t>(u)];
    if (unknown.machine == &MachineState::compliance &&
        !problem.request().measurements[unknown.measurement].fit_compliance)
      q[u] = 0, direction[u] = stiff_machine / unknown.scale;
    else
      q[u] = c.minimum.q[next++], kept.push_back(u);
  }
  const Eigen::MatrixXd jacobian = jacobian_at(gives_way, q);
  const Eigen::MatrixXd free = jacobian(Eigen::all, kept);
  Eigen::MatrixXd information = free.transpose() * free;
  information.diagonal().array() += 1e-6;  // what nothing determines
  const Eigen::VectorXd shift = -information.ldlt().solve(free.transpose() * (jacobian * direction));
  return std::expm1(shift[modulus - request.fit.begin()]);
}

Calibration calibrate_at(const CalibrationProblem& problem, Minimum minimum)
{
  constexpr int most_moves = 4;
  Calibration c;
  c.minimum = std::move(minimum);
  for (int moves = 0;; ++moves) {
    judge(c, problem);
    c.bound = problem.bound_met(c.minimum.q);
    if (!c.bound.empty()) break;
    const std::optional<Coordinates> better = profile_all(c, problem, moves < most_moves);
    if (!better) break;
    c.minimum = polished(problem, *better);
  }
  c.material = problem.material(c.minimum.q);
  for (std::size_t k = 0; k < problem.request().measurements.size(); ++k)
    c.machines.push_back(problem.machine(c.minimum.q, k));
  c.correlation = correlation_of(c.minimum, problem.request().fit.size());
  c.misfits = name_misfits(problem, c.minimum);
  c.followed = follows(c);
  if (!c.has_values()) withdraw(c, problem, c.bound.empty() ? Told::not_followed : Told::at_bound);
  add_compliances(c, problem);
  c.machine_shift = machine_shift_of(problem, c);
  return c;
}

}  // namespace

Band band_of(const CalibrationProblem& problem, const Calibration& c, std::size_t index)
{
  if (!c.has_values()) return {};
  const auto fit_at = [&](const Coordinates& q) { return problem.compare(q, index).with_errors; };
  const std::vector<double> fit = fit_at(c.minimum.q);
  const auto count = static_cast<Eigen::Index>(c.parameters.size());
  std::vector<std::vector<double>> low, high;
  for (const FittedParameter& p : c.parameters)
    low.push_back(fit_at(p.profile.low95)), high.push_back(fit_at(p.profile.high95));
  const Eigen::MatrixXd inverse = c.correlation.inverse();
  Band band;
  for (std::size_t i = 0; i < fit.size(); ++i) {
    Eigen::VectorXd up(count), down(count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const double a = low[static_cast<std::size_t>(k)][i] - fit[i],
                   b = high[static_cast<std::size_t>(k)][i] - fit[i], sign = b >= a ? 1 : -1;
      up[k] = sign * std::max({a, b, 0.0}), down[k] = sign * std::min({a, b, 0.0});
    }
    band.high.push_back(fit[i] + std::sqrt(std::max(0.0, up.dot(inverse * up))));
    band.low.push_back(fit[i] - std::sqrt(std::max(0.0, down.dot(inverse * down))));
  }
  return band;
}

Calibration calibrate(const CalibrationProblem& problem)
{
  return calibrate_at(problem, best_fit(problem));
}

Calibration calibrate(const CalibrationProblem& problem, const Coordinates& start)
{
  return calibrate_at(problem, polished(problem, start));
}

}  // namespace granulaw
