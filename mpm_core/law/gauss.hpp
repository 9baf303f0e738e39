#pragma once

namespace granulaw {

/// Integral of f from `begin` to `end` by 7-point Gauss-Legendre: exact to degree 13.
template <class Function>
double gauss(double begin, double end, const Function& f)
{
  static constexpr double node[7] = {-0.9491079123427585, -0.7415311855993945, -0.4058451513773972, 0.0,
                                     0.4058451513773972,  0.7415311855993945,  0.9491079123427585};
  static constexpr double weight[7] = {0.1294849661688697, 0.2797053914892766, 0.3818300505051189,
                                       0.4179591836734694, 0.3818300505051189, 0.2797053914892766,
                                       0.1294849661688697};
  double sum = 0;
  for (int q = 0; q < 7; ++q) sum += 0.5 * weight[q] * f(begin + 0.5 * (end - begin) * (1.0 + node[q]));
  return sum * (end - begin);
}

}  // namespace granulaw
