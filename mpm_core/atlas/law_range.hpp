#pragma once

namespace granulaw {

/// Range and tolerance of a law.
struct LawRange
{
  double depth = 0.2;  ///< overlap/length that the law must reach, up to 0.5; beyond 0.1 no single pair law
                       ///< exists: the support matters (the certificate says how much)
  double fastest = 0.25;  ///< sqrt(I), I = rho V^2/Y, that the law must reach, up to 0.3; 0: rate-independent
  double slowest = 0;  ///< of a rate-dependent body: sqrt(I) of the slowest impact that its law must hold for;
                       ///< 0: a fiftieth of `fastest`. Not below the onset of yield, where rates change nothing
  /// Relative, of force and of e, but of an e below 0.5 over 0.5: an e of 0.07 is then known to 0.005. Two
  /// resolutions must agree to this, and sampling is refined until it adds no more.
  double tolerance = 0.01;
};

/// Throws Error where a number is outside what a law can reach.
void check(const LawRange& range);

/// Damage number whose inertia adds less than the tolerance to F and e (docs/develop/notes.md): a press may load,
/// and an impact count as slow, at up to 0.16 of the tolerance. One over 1 % counts as 1 %.
double negligible_damage_number(double tolerance);

}  // namespace granulaw
