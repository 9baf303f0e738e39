#pragma once

namespace granulaw {

/// Gauss-Legendre points and weights on (-1, 1): n points integrate exactly to degree 2 n - 1.
template <int n>
struct GaussPoints;

template <>
struct GaussPoints<2>
{
  static constexpr double node[2] = {-0.5773502691896258, 0.5773502691896258};
  static constexpr double weight[2] = {1.0, 1.0};
};

template <>
struct GaussPoints<4>
{
  static constexpr double node[4] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                     0.8611363115940526};
  static constexpr double weight[4] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                       0.3478548451374538};
};

template <>
struct GaussPoints<7>
{
  static constexpr double node[7] = {-0.9491079123427585, -0.7415311855993945, -0.4058451513773972, 0.0,
                                     0.4058451513773972,  0.7415311855993945,  0.9491079123427585};
  static constexpr double weight[7] = {0.1294849661688697, 0.2797053914892766, 0.3818300505051189,
                                       0.4179591836734694, 0.3818300505051189, 0.2797053914892766,
                                       0.1294849661688697};
};

/// Integral of f from `begin` to `end` by n-point Gauss-Legendre.
template <int n, class Function>
double gauss(double begin, double end, const Function& f)
{
  using Points = GaussPoints<n>;
  double sum = 0;
  for (int q = 0; q < n; ++q)
    sum += 0.5 * Points::weight[q] * f(begin + 0.5 * (end - begin) * (1.0 + Points::node[q]));
  return sum * (end - begin);
}

}  // namespace granulaw
