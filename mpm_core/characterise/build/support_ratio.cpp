#include "characterise/build/support_ratio.hpp"

#include <algorithm>
#include <vector>

namespace granulaw {

double support_ratio(double overlap)
{
  // measured, E*/Y = 100, nu = 0.3 (docs/evidence/solver-accuracy.md)
  const std::vector<double> overlaps{0, 0.001, 0.01, 0.02, 0.05, 0.1, 0.2, 0.3};
  const std::vector<double> ratios{1, 1.012, 1.025, 1.030, 1.044, 1.092, 1.438, 1.638};
  const auto above = std::upper_bound(overlaps.begin(), overlaps.end(), overlap) - overlaps.begin();
  if (above == static_cast<std::ptrdiff_t>(overlaps.size())) return ratios.back();
  const auto k = static_cast<std::size_t>(above);
  const double t = (overlap - overlaps[k - 1]) / (overlaps[k] - overlaps[k - 1]);
  return ratios[k - 1] + t * (ratios[k] - ratios[k - 1]);
}

}  // namespace granulaw
