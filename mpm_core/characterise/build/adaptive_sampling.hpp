#pragma once

#include "characterise/run/request.hpp"
#include "characterise/run/build_runs.hpp"
#include "characterise/fit/fit_curve.hpp"
#include "characterise/onset_similarity.hpp"
#include "characterise/run/refinement.hpp"
#include "characterise/run/sampling_plan.hpp"

namespace granulaw {

/// Input of the sampling of a body's law.
struct SamplingSetting
{
  const CharacterisedBody& body;
  const CharacterisedBody&
      slow;  ///< the same without rate: its presses and slow impacts give the rate-independent law
  const BuildOptions& options;
  const RunSource& source;
  const LawShape*
      known;  ///< the rate-independent law, to Atlas::depth, where no run is needed for it; else null
  ElasticCorrection elastic;
  const ContactRecord* elastic_press;  ///< of a body of several materials; else null
  int press_cells, impact_cells;

  /// End of the shape's functions of u.
  double shape_end() const { return known ? Atlas::depth : options.depth; }
};

/// Runs made, the law's shape by them, and that shape without each run.
struct Sampled
{
  ContactRecords records;
  FittedShape fitted;
  std::vector<LeftOutRun> slow, fast;
};

/// Runs a plan, fits, and adds runs where a run left out is missed, until no interval is left to bisect.
/// `guide`: gives the law below the first run; its spheres are run beside the plan; may be null.
Sampled sample(SamplingPlan plan, const SamplingSetting& setting, OnsetSimilarity* guide, BuildRuns& runs);

/// Which axis a body's law has.
AxisTable::By axis_kind_of(const CharacterisedBody& body);

}  // namespace granulaw
