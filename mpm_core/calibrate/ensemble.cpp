#include <cmath>
#include <random>

#include "calibrate/calibrate.hpp"
#include "calibrate/fit.hpp"

namespace granulaw {

namespace {

/// A square root of the covariance over what is free, with steps along what no data determine kept short.
Eigen::MatrixXd steps_of(const Minimum& minimum)
{
  constexpr double longest = 1;  // of a step along one direction
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(covariance(minimum));
  const Eigen::VectorXd lengths = parts.eigenvalues().cwiseMax(0.0).cwiseSqrt().cwiseMin(longest);
  return parts.eigenvectors() * lengths.asDiagonal();
}

}  // namespace

std::vector<CandidateMaterial> draw_materials(const CalibrationProblem& problem, const Calibration& c,
                                              int count, std::uint32_t seed)
{
  constexpr int burn_in = 200, between = 20;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const auto unknowns = static_cast<double>(problem.count());
  // the fraction of the covariance at which a random walk gets about fastest (Roberts, Gelman and Gilks 1997)
  const Eigen::MatrixXd step = 2.4 / std::sqrt(unknowns) * std::sqrt(c.widening.scale) * steps_of(c.minimum);
  Coordinates q = c.minimum.q;
  double cost = c.minimum.cost;
  std::vector<CandidateMaterial> drawn;
  for (int k = 1; static_cast<int>(drawn.size()) < count; ++k) {
    Coordinates next(q.size());
    for (Eigen::Index i = 0; i < q.size(); ++i) next[i] = normal(random);
    next = q + step * next;
    const double there = problem.residuals(next).squaredNorm();
    if (std::isfinite(there) && std::log(uniform(random)) < 0.5 * (cost - there) / c.widening.scale)
      q = next, cost = there;
    if (k > burn_in && k % between == 0) drawn.push_back(problem.material(q));
  }
  return drawn;
}

}  // namespace granulaw
