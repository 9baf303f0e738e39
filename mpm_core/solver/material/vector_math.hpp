#pragma once

#include "solver/material/parameter.hpp"

namespace granulaw::flow {

// Logarithm and exponential without calls or branches, so that loops over material points vectorise on every
// instruction set. Relative error of power(x, n) below 1e-14 for |n ln x| < 30.

/// ln x, x > 0 and normal: x = 2^k m with m between sqrt(1/2) and sqrt(2), ln m = 2 artanh((m-1)/(m+1)).
/// Below the normal range (0 included): about -708.
GRANULAW_INLINE double log(double x)
{
  using Bits = unsigned long long;
  const Bits bits = __builtin_bit_cast(Bits, x);
  constexpr Bits root_half = 0x3fe6a09e667f3bcdull, mantissa = 0x000fffffffffffffull;
  constexpr Bits one = 0x3ff0000000000000ull, shift_to_one = one - root_half;
  const Bits moved = bits + shift_to_one;  // its exponent is 1023 + k
  const double k =
      __builtin_bit_cast(double, (moved >> 52) | 0x4330000000000000ull) - (4503599627370496.0 + 1023.0);
  const double m = __builtin_bit_cast(double, (moved & mantissa) + root_half);
  const double s = (m - 1.0) / (m + 1.0), q = s * s;
  double sum = 1.0 / 21.0;
  sum = sum * q + 1.0 / 19.0;
  sum = sum * q + 1.0 / 17.0;
  sum = sum * q + 1.0 / 15.0;
  sum = sum * q + 1.0 / 13.0;
  sum = sum * q + 1.0 / 11.0;
  sum = sum * q + 1.0 / 9.0;
  sum = sum * q + 1.0 / 7.0;
  sum = sum * q + 1.0 / 5.0;
  sum = sum * q + 1.0 / 3.0;
  sum = sum * q + 1.0;
  return 0.693147180559945309 * k + 2.0 * s * sum;
}

/// e^t for |t| < 700; beyond, its value at the end of that range. t = k ln 2 + r, Taylor series to r^13.
GRANULAW_INLINE double exp(double t)
{
  using Bits = unsigned long long;
  t = t < -700.0 ? -700.0 : t;
  t = t > 700.0 ? 700.0 : t;
  constexpr double to_integer =
      6755399441055744.0;  // 1.5 2^52: adding it rounds, the integer is in the low bits
  const double shifted = t * 1.44269504088896341 + to_integer;
  const double k = shifted - to_integer;
  const double r = (t - k * 0.693147180369123816490) - k * 1.90821492927058770002e-10;
  double sum = 1.0 / 6227020800.0;
  sum = sum * r + 1.0 / 479001600.0;
  sum = sum * r + 1.0 / 39916800.0;
  sum = sum * r + 1.0 / 3628800.0;
  sum = sum * r + 1.0 / 362880.0;
  sum = sum * r + 1.0 / 40320.0;
  sum = sum * r + 1.0 / 5040.0;
  sum = sum * r + 1.0 / 720.0;
  sum = sum * r + 1.0 / 120.0;
  sum = sum * r + 1.0 / 24.0;
  sum = sum * r + 1.0 / 6.0;
  sum = sum * r + 0.5;
  sum = sum * r + 1.0;
  sum = sum * r + 1.0;
  const Bits scale = (__builtin_bit_cast(Bits, shifted) << 52) + 0x3ff0000000000000ull;
  return sum * __builtin_bit_cast(double, scale);
}

/// x^n, x > 0 (0 gives about 0).
GRANULAW_INLINE double power(double x, double n)
{
  return exp(n * log(x));
}

}  // namespace granulaw::flow
