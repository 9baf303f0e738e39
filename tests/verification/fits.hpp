#pragma once

#include <cmath>
#include <vector>

namespace granulaw::verification {

/// Least squares of ln(error) = ln(c) - p ln(cells).
struct Order
{
  double p, standard_error;
};
inline Order fit_order(const std::vector<int>& cells, const std::vector<double>& errors)
{
  const double n = static_cast<double>(cells.size());
  double sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const double x = std::log(cells[k]), y = std::log(std::abs(errors[k]));
    sx += x, sy += y, sxx += x * x, sxy += x * y, syy += y * y;
  }
  const double vxx = sxx - sx * sx / n, vxy = sxy - sx * sy / n, vyy = syy - sy * sy / n;
  const double slope = vxy / vxx;
  return {-slope, std::sqrt(std::max(0.0, vyy - slope * vxy) / (n - 2) / vxx)};
}

/// Least squares of value = limit + c cells^-p; p by search between 0.5 and 4.
struct Limit
{
  double value, p;
};
inline Limit fit_limit(const std::vector<int>& cells, const std::vector<double>& values)
{
  const double n = static_cast<double>(cells.size());
  Limit best{};
  double least = INFINITY;
  for (double p = 0.5; p <= 4; p += 0.01) {
    double sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const double x = std::pow(cells[k], -p), y = values[k] - values.back();  // differences keep digits
      sx += x, sy += y, sxx += x * x, sxy += x * y, syy += y * y;
    }
    const double vxx = sxx - sx * sx / n, vxy = sxy - sx * sy / n, vyy = syy - sy * sy / n;
    const double slope = vxy / vxx, residual = vyy - slope * vxy;
    if (residual < least) least = residual, best = {values.back() + (sy - slope * sx) / n, p};
  }
  return best;
}

inline double root_mean_square(const std::vector<double>& errors)
{
  double sum = 0;
  for (const double e : errors) sum += e * e;
  return std::sqrt(sum / static_cast<double>(errors.size()));
}

}  // namespace granulaw::verification
