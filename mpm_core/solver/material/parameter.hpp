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

/// Start of a parameter's fit, by the flow stress (1 + gain) Y that a law reaches at about a strain:
/// (per_yield + per_gain gain) Y + per_strain strain + number. All 0: the flow stress goes in proportion to
/// the parameter, and the yield stress sets it; it is not fitted.
struct Start
{
  double per_yield = 0, per_gain = 0, per_strain = 0, number = 0;
  constexpr double at(double yield_stress, double gain, double strain) const
  {
    return (per_yield + per_gain * gain) * yield_stress + per_strain * strain + number;
  }
  bool operator==(const Start&) const = default;
};

/// One key of a law in the materials file.
struct Parameter
{
  const char* key;
  Quantity quantity;
  double least, most;          ///< allowed, both included
  bool list = false;           ///< a list of numbers, which is not fitted; else one number
  Start start{};               ///< of a fit (mpm calibrate)
  double least_per_yield = 0;  ///< of a stress: allowed from this fraction of the yield stress on

  constexpr bool is_fitted() const { return !list && start != Start{}; }
};

inline constexpr double over_zero = std::numeric_limits<double>::min();
inline constexpr double no_limit = std::numeric_limits<double>::max();

/// "Not below any strain or rate that occurs."
inline constexpr double unreached = 1e150;

/// Room for what a hardening law, a rate law and a yield surface keep for the kernel, in doubles.
inline constexpr int law_room = 96, rate_room = 8, surface_room = 8;

}  // namespace granulaw::flow
