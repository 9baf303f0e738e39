#pragma once

#include <string>

#include "atlas/unlike_pair.hpp"
#include "characterise/run/sampling_plan.hpp"
#include "farm/farm.hpp"

namespace granulaw {

/// The two bodies in units of the yielding one: R_s = E*_s = rho_s = 1. The smaller first: impulses act at its surface
/// points, the finer ones.
struct TwoBodies
{
  Particle first;
  Partner partner;

  explicit TwoBodies(const UnlikePair& pair);
};

/// Their impact at the relative `velocity`, m/s, in those units.
RunSummary run_two_bodies(const UnlikePair& pair, double velocity, const RunOptions& options);

/// Runs of a pair's two bodies in place of those of one: reported as the runs of the one sphere that the pair
/// rule says they are (radius lambda R*, force lambda F; at the velocity of equal energy, so that I means the
/// same). `pair.radius_ratio` over 0; infinity, a deformable wall, for impacts only.
RunSource two_body_runs(const UnlikePair& pair);

/// A farm that distinguishes the runs of this pair from those of its yielding body alone. `farm` outlives it.
class PairFarm : public Farm
{
 public:
  PairFarm(Farm& farm, const UnlikePair& pair);

 private:
  std::vector<RunOutcome> make(const std::vector<RunJob>& jobs, const Progress& progress) override;

  Farm& farm_;
  std::string text_;
};

/// Overlap over lambda R* up to which two bodies are run: 0.4 of the smaller radius. Beyond, the softer one
/// is squeezed flat.
double deepest_of_two_bodies(const UnlikePair& pair);

/// The yielding body, as the sampling plan wants it.
CharacterisedBody yielding_body(const UnlikePair& pair);

}  // namespace granulaw
