#include "calibrate/fit.hpp"

#include <algorithm>
#include <unsupported/Eigen/NonLinearOptimization>

namespace granulaw {

namespace {

/// The free unknowns of a problem, as Eigen's minimiser asks for them. A negative answer ends the search.
struct FreeProblem
{
  const CalibrationProblem& problem;
  Coordinates q;                   ///< fixed unknowns keep these
  std::vector<Eigen::Index> free;  ///< the others' places

  Coordinates at(const Eigen::VectorXd& x) const
  {
    Coordinates full = q;
    full(free) = x;
    return full;
  }

  using Scalar = double;
  int operator()(const Eigen::VectorXd& x, Eigen::VectorXd& residuals) const
  {
    if (!x.allFinite()) return -1;  // a step along a direction that nothing determines
    residuals = problem.residuals(at(x));
    return residuals.allFinite() ? 0 : -1;
  }
  int df(const Eigen::VectorXd& x, Eigen::MatrixXd& jacobian) const
  {
    jacobian = differences(at(x));
    return jacobian.allFinite() ? 0 : -1;
  }
  int inputs() const { return static_cast<int>(free.size()); }
  int values() const { return static_cast<int>(problem.residuals(q).size()); }

  /// Forward differences over the unknowns' own steps: wide against what tables leave of the model's
  /// smoothness.
  Eigen::MatrixXd differences(const Coordinates& place) const
  {
    const Eigen::VectorXd base = problem.residuals(place);
    Eigen::MatrixXd jacobian(base.size(), static_cast<Eigen::Index>(free.size()));
    for (std::size_t k = 0; k < free.size(); ++k) {
      const double step = problem.unknowns()[static_cast<std::size_t>(free[k])].step;
      Coordinates moved = place;
      moved[free[k]] += step;
      jacobian.col(static_cast<Eigen::Index>(k)) = (problem.residuals(moved) - base) / step;
    }
    return jacobian;
  }
};

}  // namespace

Minimum minimise(const CalibrationProblem& problem, const Coordinates& start, const std::vector<bool>& fixed,
                 int most_steps)
{
  FreeProblem free{problem, start, {}};
  for (std::size_t k = 0; k < fixed.size(); ++k)
    if (!fixed[k]) free.free.push_back(static_cast<Eigen::Index>(k));
  Minimum found{start, problem.residuals(start).squaredNorm(), {}};
  if (free.free.empty()) return found;

  using namespace Eigen::LevenbergMarquardtSpace;
  Eigen::VectorXd x = start(free.free);
  Eigen::LevenbergMarquardt<FreeProblem> search(free);
  search.parameters.xtol = 1e-7, search.parameters.ftol = search.parameters.gtol = 1e-10;
  search.parameters.factor = 0.3;  // of the scaled unknowns: the first step
  Status status = search.minimizeInit(x);
  for (int step = 0; step < most_steps && (status == NotStarted || status == Running); ++step) status = search.minimizeOneStep(x);
  if (!x.allFinite()) return found;
  const Coordinates end = free.at(x);
  const double cost = problem.residuals(end).squaredNorm();
  if (cost < found.cost) found.q = end, found.cost = cost;
  return found;
}

Minimum best_fit(const CalibrationProblem& problem)
{
  const std::vector<bool> none(problem.count(), false);
  Minimum best;
  bool first = true;
  for (const Coordinates& start : problem.starts()) {
    const Minimum found = minimise(problem, start, none);
    if (first || found.cost < best.cost) best = found;
    first = false;
  }
  return polished(problem, best.q);
}

Minimum polished(const CalibrationProblem& problem, const Coordinates& start)
{
  constexpr int most_rounds = 5;
  constexpr double no_gain = 1e-3;  // of the sum of squares: a thousandth of what a 68 % interval takes
  const std::vector<bool> none(problem.count(), false);
  Minimum best = minimise(problem, start, none);
  for (int round = 0; round < most_rounds; ++round) {
    Minimum next = minimise(problem, best.q, none);
    const double gain = best.cost - next.cost;
    if (gain > 0) best = std::move(next);
    if (gain < no_gain) break;
  }
  best.jacobian = jacobian_at(problem, best.q);
  return best;
}

Eigen::MatrixXd jacobian_at(const CalibrationProblem& problem, const Coordinates& q)
{
  FreeProblem all{problem, q, {}};
  for (std::size_t k = 0; k < problem.count(); ++k) all.free.push_back(static_cast<Eigen::Index>(k));
  return all.differences(q);
}

Eigen::MatrixXd covariance(const Minimum& minimum)
{
  Eigen::MatrixXd information = minimum.jacobian.transpose() * minimum.jacobian;
  information.diagonal().array() += 1e-6;
  return information.inverse();
}

}  // namespace granulaw
