#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace granulaw {

namespace detail {

/// Tables of fast_pow: 1.6 kB, made when the program starts.
struct PowTables
{
  static constexpr int log_bits = 6, exp_bits = 5;
  struct Log
  {
    double inverse, log2;
  };
  std::array<Log, 1 << log_bits> log;     // of the middle of each sub-interval of [1, 2)
  std::array<double, 1 << exp_bits> exp;  // 2^(k/32)

  PowTables()
  {
    for (std::size_t k = 0; k < log.size(); ++k) {
      const double middle = 1.0 + (static_cast<double>(k) + 0.5) / static_cast<double>(log.size());
      log[k] = {1.0 / middle, std::log2(middle)};
    }
    for (std::size_t k = 0; k < exp.size(); ++k)
      exp[k] = std::exp2(static_cast<double>(k) / static_cast<double>(exp.size()));
  }
};
inline const PowTables pow_tables;

}  // namespace detail

/// u^n for 0 < u <= 1 and 0 < n <= 16: the unloading branch's power, as exp2(n log2 u), inline.
/// Relative error below 2e-11 n (tests/unit/fast_pow_test.cpp); several times faster than std::pow, which is
/// not inlined. Results below 2^-900, and u below the smallest normal number, come back as 0.
inline double fast_pow(double u, double n)
{
  using T = detail::PowTables;
  const T& tables = detail::pow_tables;
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(u);
  if (bits < 0x0010000000000000ULL) [[unlikely]]
    return 0.0;
  // u = m 2^e, 1 <= m < 2; m = c (1 + r) with c the middle of its sub-interval: |r| < 1/128
  const auto e = static_cast<std::int32_t>(bits >> 52) - 1023;
  const T::Log& c = tables.log[(bits >> (52 - T::log_bits)) & ((1u << T::log_bits) - 1)];
  const double m = std::bit_cast<double>((bits & 0x000fffffffffffffULL) | 0x3ff0000000000000ULL);
  const double r = m * c.inverse - 1.0;
  constexpr double per_ln2 = 1.4426950408889634074;
  // ln(1+r): the first term left out is r^5/5 < 6e-12
  const double log2 =
      (static_cast<double>(e) + c.log2) + per_ln2 * r * ((1.0 - 0.5 * r) + r * r * (1.0 / 3 - 0.25 * r));
  const double y = n * log2;
  if (!(y > -900.0)) [[unlikely]]
    return 0.0;
  // 2^y = 2^k 2^(j/32) 2^f, |f| <= 1/64; adding 1.5*2^47 rounds to the nearest 1/32
  constexpr double shift = 211106232532992.0;
  const double rounded = y + shift, f = y - (rounded - shift);
  const std::uint64_t k = std::bit_cast<std::uint64_t>(rounded);  // its low bits are 32 y, rounded
  const double z = f * 0.69314718055994530942;                    // |z| < 0.0109: z^5/120 < 2e-12
  const double exponential = (1.0 + z) + z * z * ((0.5 + z * (1.0 / 6)) + z * z * (1.0 / 24));
  const double scale =
      std::bit_cast<double>(std::bit_cast<std::uint64_t>(tables.exp[k & 31]) + (k >> 5 << 52));
  return scale * exponential;
}

}  // namespace granulaw
