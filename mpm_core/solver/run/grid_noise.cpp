#include "solver/run/grid_noise.hpp"

#include <algorithm>
#include <cmath>

#include "linear/linear.hpp"

namespace granulaw {

namespace {

/// The samples of virgin loading from `from` of the deepest overlap on.
std::vector<const TraceSample*> loading_samples(std::span<const TraceSample> trace, double from,
                                                double deepest)
{
  std::vector<const TraceSample*> used;
  for (const TraceSample& s : trace)
    if (s.branch == Branch::load && s.delta >= from * deepest && s.force > 0) used.push_back(&s);
  return used;
}

double deepest_loading(std::span<const TraceSample> trace)
{
  double deepest = 0;
  for (const TraceSample& s : trace)
    if (s.branch == Branch::load) deepest = std::max(deepest, s.delta);
  return deepest;
}

}  // namespace

TreatedLoading::TreatedLoading(std::span<const TraceSample> trace, double from)
{
  const double deepest = deepest_loading(trace);
  const std::vector<const TraceSample*> used = loading_samples(trace, from, deepest);
  if (used.size() < 12) return;
  from_ = from * deepest;
  fit(used, deepest);
  measure_ripple(used, deepest);
}

/// ln F by Chebyshev polynomials in ln delta, least squares. Relative grid noise falls like (h/a)^1.65, a^2 ~
/// delta: weight of a residual in ln F ~ delta^0.8. Samples stand at equal times; what counts is equal steps
/// of ln delta: weight by the step as well.
void TreatedLoading::fit(const std::vector<const TraceSample*>& used, double deepest)
{
  const double low = std::log(from_), high = std::log(deepest);
  centre_ = 0.5 * (low + high), half_ = 0.5 * (high - low);
  const int degree = used.size() > 60 ? 5 : 3;
  const auto rows = static_cast<Eigen::Index>(used.size());
  Eigen::MatrixXd a(rows, degree + 1);
  Eigen::VectorXd b(rows);
  for (Eigen::Index k = 0; k < rows; ++k) {
    const TraceSample& s = *used[static_cast<std::size_t>(k)];
    const double before = std::log(used[static_cast<std::size_t>(std::max<Eigen::Index>(k - 1, 0))]->delta);
    const double after = std::log(used[static_cast<std::size_t>(std::min(k + 1, rows - 1))]->delta);
    const double weight = std::pow(s.delta / deepest, 0.8) * std::sqrt(std::max(1e-6, after - before));
    const double t = (std::log(s.delta) - centre_) / half_;
    for (int j = 0; j <= degree; ++j)
      a(k, j) = weight * (j == 0 ? 1 : j == 1 ? t : 2 * t * a(k, j - 1) / weight - a(k, j - 2) / weight);
    b(k) = weight * std::log(s.force);
  }
  const Eigen::VectorXd x = least_squares(a, b);
  coefficients_.assign(x.data(), x.data() + x.size());
}

void TreatedLoading::measure_ripple(const std::vector<const TraceSample*>& used, double deepest)
{
  double sum = 0;
  int count = 0;
  for (const TraceSample* s : used)
    if (s->delta >= 0.25 * deepest) {
      const double ratio = s->force / force(s->delta) - 1;
      sum += ratio * ratio;
      ++count;
    }
  grid_noise_ = count ? std::sqrt(sum / count) : 0;
}

double TreatedLoading::largest_force(double until) const
{
  constexpr int steps = 400;
  double largest = 0;
  for (int k = 0; k <= steps; ++k)
    largest = std::max(largest, force(from_ * std::pow(until / from_, static_cast<double>(k) / steps)));
  return largest;
}

double TreatedLoading::force(double delta) const
{
  const double t = (std::log(delta) - centre_) / half_;
  // Clenshaw
  double b1 = 0, b2 = 0;
  for (std::size_t j = coefficients_.size(); j-- > 1;) {
    const double b0 = coefficients_[j] + 2 * t * b1 - b2;
    b2 = b1;
    b1 = b0;
  }
  return std::exp(coefficients_[0] + t * b1 - b2);
}

double smoothed_peak(std::span<const TraceSample> trace)
{
  const auto loading = std::count_if(trace.begin(), trace.end(),
                                     [](const TraceSample& s) { return s.branch == Branch::load; });
  const auto m = std::max<std::ptrdiff_t>(2, std::lround(0.02 * static_cast<double>(loading)));
  const auto count = static_cast<std::ptrdiff_t>(trace.size());
  const double scale = static_cast<double>((2 * m - 1) * (2 * m + 1) * (2 * m + 3));
  double largest = 0;
  for (std::ptrdiff_t k = m; k + m < count; ++k) {
    double force = 0;  // at k, of the quadratic through the 2 m + 1 samples around it
    for (std::ptrdiff_t j = -m; j <= m; ++j)
      force += static_cast<double>(3 * (3 * m * m + 3 * m - 1 - 5 * j * j)) / scale *
               trace[static_cast<std::size_t>(k + j)].force;
    largest = std::max(largest, force);
  }
  return largest;
}

}  // namespace granulaw
