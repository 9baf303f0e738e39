#pragma once

#include <span>

#include "law/spline.hpp"

namespace granulaw {

struct SplineSample
{
  double q, value, weight;
};

/// Weighted least squares through 2 samples or more. The penalty on the differences of this order of the
/// B-spline coefficients is `stiffness` times the mean weight of the samples: it bridges intervals without
/// samples and does not follow grid noise.
Spline fit_spline(std::span<const SplineSample> samples, double end, int intervals, double stiffness,
                  int order = 3);

}  // namespace granulaw
