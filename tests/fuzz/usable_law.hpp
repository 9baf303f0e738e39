#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "law/law.hpp"

namespace granulaw::tests {

/// "" if every pair of an accepted law resolves and gives finite, never negative forces and radii, and finite
/// stiffnesses, quasi-statically and after impacts up to beyond the velocity axis, at overlaps from 1e-9 of
/// its table to three times its end, on and below the largest overlap; else what does not hold.
inline std::string unusable(const Law& law)
{
  const double r_eff = 1e-3;  // m
  const auto sane = [](double value) { return value >= 0 && std::isfinite(value); };
  for (const auto& [a, b] : law.pairs) {
    const PairLaw pair = resolve_pair(law, a, b, "test");
    const double end = pair.max_overlap(r_eff), mass = pair.usual_mass(r_eff);
    for (int k = 0; k <= 60; ++k) {
      const double largest = 3 * end * std::pow(10.0, -9.0 * k / 60);
      for (const double part : {1e-6, 0.1, 0.5, 0.9, 0.999999, 1.0}) {
        for (const double speed : {0.0, 1e-9, 0.3, 0.77, 1.0, 1e3}) {
          if (speed > 0 && !pair.curve->axis()) break;
          const double latched =
              speed > 0 ? pair.impact_overlap(r_eff, mass, speed * pair.max_speed(r_eff, mass)) : 0.0;
          const Answer f = pair.evaluate(r_eff, part * largest, largest, latched);
          if (!sane(f.force) || !sane(f.contact_radius) || !std::isfinite(f.stiffness) ||
              f.delta_max != largest)
            return fmt::format("{}:{} at {:g} of {:g} m, X = {:g}: F = {:g} N, dF/dd = {:g} N/m, a = {:g} m",
                               a, b, part, largest, latched, f.force, f.stiffness, f.contact_radius);
        }
      }
    }
  }
  return "";
}

}  // namespace granulaw::tests
