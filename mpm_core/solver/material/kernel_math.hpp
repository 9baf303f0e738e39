#pragma once

#include <type_traits>

#include "solver/material/parameter.hpp"

// Functions of one number that the kernels of all dimensions share, for loops over material points that
// vectorise. As with the flow laws, every function must be always_inline (material/parameter.hpp).

namespace granulaw::kernel {

/// Keeps a quotient by zero finite.
template <class Real>
static constexpr Real tiny = std::is_same_v<Real, float> ? Real(1e-37) : Real(1e-300);

template <class Real>
GRANULAW_INLINE Real root_of(Real x)
{
  if constexpr (std::is_same_v<Real, float>)
    return __builtin_sqrtf(x);
  else
    return __builtin_sqrt(x);
}

/// ln(1 + x) for 1 + x between about 0.2 and 5, relative error below 1e-11 there and 1e-16 for |x| < 0.3
/// (float: rounding): ln(1+x) = 2 ln sqrt(1+x) = 4 artanh(s), s = x/(2 + 2 sqrt(1+x) + x). Exact to rounding
/// as x -> 0.
template <class Real>
GRANULAW_INLINE Real log_1p(Real x)
{
  const Real root = root_of(Real(1) + x);
  const Real s = x / (Real(2) + Real(2) * root + x), q = s * s;
  Real sum;
  if constexpr (std::is_same_v<Real, float>) {
    sum = Real(1.0 / 9.0);
  } else {
    sum = 1.0 / 21.0;
    sum = sum * q + 1.0 / 19.0;
    sum = sum * q + 1.0 / 17.0;
    sum = sum * q + 1.0 / 15.0;
    sum = sum * q + 1.0 / 13.0;
    sum = sum * q + 1.0 / 11.0;
    sum = sum * q + 1.0 / 9.0;
  }
  sum = sum * q + Real(1.0 / 7.0);
  sum = sum * q + Real(1.0 / 5.0);
  sum = sum * q + Real(1.0 / 3.0);
  sum = sum * q + Real(1);
  return Real(4) * s * sum;
}

/// exp(t) - 1 for small t, such as one time step's plastic flow or a volume strain; relative error 1e-16 at
/// |t| = 0.05, 5e-11 at 0.3.
template <class Real>
GRANULAW_INLINE Real exp_m1(Real t)
{
  Real sum;
  if constexpr (std::is_same_v<Real, float>) {
    sum = Real(1.0 / 720.0);
  } else {
    sum = 1.0 / 362880.0;
    sum = sum * t + 1.0 / 40320.0;
    sum = sum * t + 1.0 / 5040.0;
    sum = sum * t + 1.0 / 720.0;
  }
  sum = sum * t + Real(1.0 / 120.0);
  sum = sum * t + Real(1.0 / 24.0);
  sum = sum * t + Real(1.0 / 6.0);
  sum = sum * t + Real(0.5);
  sum = sum * t + Real(1);
  return t * sum;
}

}  // namespace granulaw::kernel
