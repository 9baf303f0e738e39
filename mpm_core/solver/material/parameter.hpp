#pragma once

#include <limits>

/// Parts of flow laws. These files are compiled into host code and, once for each instruction set,
/// into the kernels: every function here must be always_inline, so that no copy is shared between the sets.
#define GRANULAW_INLINE static inline __attribute__((always_inline))
#define GRANULAW_MEMBER inline __attribute__((always_inline))

namespace granulaw::flow {

/// A function of one variable and its slope: the static flow stress over the equivalent plastic strain, or
/// the rate factor over the plastic strain rate.
struct ValueAndSlope
{
  double value, slope;
};

/// 1, Pa, 1/s, degrees: how a parameter is made dimensionless and named; of an angle the sine is kept.
enum class Quantity { number, stress, rate, angle };

/// One key of a law in the materials file.
struct Parameter
{
  const char* key;
  Quantity quantity;
  double least, most;  ///< allowed, both included
  bool list = false;   ///< a list of numbers; else one number
};

inline constexpr double over_zero = std::numeric_limits<double>::min();
inline constexpr double no_limit = std::numeric_limits<double>::max();

/// "Not below any strain or rate that occurs."
inline constexpr double unreached = 1e150;

/// Room for what a hardening law, a rate law and a yield surface keep for the kernel, in doubles.
inline constexpr int law_room = 96, rate_room = 8, surface_room = 8;

}  // namespace granulaw::flow
