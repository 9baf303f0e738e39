#pragma once

#include "characterise/atlas.hpp"
#include "farm/farm.hpp"

namespace granulaw {

/// What a law must reach, and how exactly.
struct BuildOptions
{
  double depth = 0.2;  ///< overlap/length that the law must reach, up to 0.5; beyond 0.1 no single pair law
                       ///< exists: the support matters (the certificate says how much)
  double fastest = 0.25;  ///< sqrt(I), I = rho V^2/Y, that the law must reach, up to 0.3; 0: rate-free
  double slowest = 0;  ///< of a rate-dependent body: sqrt(I) of the slowest impact that its law must know; 0:
                       ///< a fiftieth of `fastest`. Not below the onset of yield, where rates change nothing
  /// Relative, of force and of e, but of an e below 0.5 over 0.5: an e of 0.07 is then known to 0.005. Two
  /// resolutions must agree to this, and sampling is refined until it adds no more.
  double tolerance = 0.01;
  const Atlas* atlas = nullptr;  ///< spares runs where a stiff body begins to yield; none: nothing but runs
  Farm* farm = nullptr;          ///< makes the runs; none: this thread
  Progress progress;             ///< may throw to stop
};

/// Throws Error where an option is outside what a law can reach.
void check(const BuildOptions& options);

}  // namespace granulaw
