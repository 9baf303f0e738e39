#include "characterise/node_slopes.hpp"

#include <algorithm>

namespace granulaw {

std::vector<double> difference_slopes(const std::vector<double>& y, double h)
{
  const std::size_t count = y.size();
  std::vector<double> slope(count, 0.0);
  if (count == 2) slope.assign(2, (y[1] - y[0]) / h);
  if (count < 3) return slope;
  const std::size_t last = count - 1;
  slope[0] = (-3 * y[0] + 4 * y[1] - y[2]) / (2 * h);
  for (std::size_t k = 1; k < last; ++k) slope[k] = (y[k + 1] - y[k - 1]) / (2 * h);
  slope[last] = (3 * y[last] - 4 * y[last - 1] + y[last - 2]) / (2 * h);
  return slope;
}

std::vector<double> difference_slopes_in_parts(const std::vector<double>& values, std::size_t kink, double h)
{
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::min(kink, values.size()));
  std::vector<double> slopes = difference_slopes({values.begin(), at}, h);
  const std::vector<double> beyond = difference_slopes({at, values.end()}, h);
  slopes.insert(slopes.end(), beyond.begin(), beyond.end());
  return slopes;
}

double slope_of_a_positive(double slope, double value, double h)
{
  const double most = 3 / h * std::max(0.0, value);
  return std::clamp(slope, -most, most);
}

Rising::Rising(std::vector<double> values, double h) : value(std::move(values))
{
  double most = 0;
  for (double& v : value) v = most = std::max(most, v);
  slope = difference_slopes(value, h);
  if (!slope.empty()) slope.front() = 0;
  for (std::size_t k = 0; k + 1 < value.size(); ++k) {
    const double steepest = 3 * (value[k + 1] - value[k]) / h;
    slope[k] = std::clamp(slope[k], 0.0, steepest);
    slope[k + 1] = std::clamp(slope[k + 1], 0.0, steepest);
  }
}

}  // namespace granulaw
