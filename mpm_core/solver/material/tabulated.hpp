#pragma once

#include "solver/material/parameter.hpp"

namespace granulaw::flow {

/// Points (strain, stress), straight lines between them, constant beyond the last; the first is (0, yield
/// stress).
struct Tabulated
{
  static constexpr const char* name = "tabulated";
  static constexpr Parameter parameters[] = {{"strain", Quantity::number, 0, no_limit, true},
                                             {"stress", Quantity::stress, over_zero, no_limit, true}};
  static constexpr int room = law_room / 3;  ///< points

  const double *strain, *stress, *slope;  ///< [room]; unused ones have an infinite strain

  /// Fills what `from` reads; a sentence if the lists cannot be used.
  static const char* pack(const double* strains, int strain_count, const double* stresses, int stress_count,
                          double* out)
  {
    if (strain_count != stress_count) return "'strain' and 'stress' differ in length";
    if (strain_count < 2 || strain_count > room) return "'strain' must have 2 to 32 points";
    if (strains[0] != 0) return "'strain' must start at 0";
    for (int k = 1; k < strain_count; ++k) {
      if (!(strains[k] > strains[k - 1])) return "'strain' must ascend";
      if (!(stresses[k] >= stresses[k - 1])) return "'stress' falls; strain softening is not supported";
    }
    for (int k = 0; k < room; ++k) {
      const bool used = k < strain_count, inner = k + 1 < strain_count;
      out[k] = used ? strains[k] : std::numeric_limits<double>::infinity();
      out[room + k] = used ? stresses[k] : stresses[strain_count - 1];
      out[2 * room + k] = inner ? (stresses[k + 1] - stresses[k]) / (strains[k + 1] - strains[k]) : 0.0;
    }
    return nullptr;
  }
  static GRANULAW_MEMBER Tabulated from(double /*yield_stress*/, const double* v)
  {
    return {v, v + room, v + 2 * room};
  }
  GRANULAW_MEMBER ValueAndSlope operator()(double ep) const
  {
    static_assert(room == 32);
    long k = 0;  // last point at or below ep, by halving
    k += strain[k + 16] <= ep ? 16 : 0;
    k += strain[k + 8] <= ep ? 8 : 0;
    k += strain[k + 4] <= ep ? 4 : 0;
    k += strain[k + 2] <= ep ? 2 : 0;
    k += strain[k + 1] <= ep ? 1 : 0;
    return {stress[k] + slope[k] * (ep - strain[k]), slope[k]};
  }
  GRANULAW_MEMBER double strain_at(double) const { return unreached; }
};

}  // namespace granulaw::flow
