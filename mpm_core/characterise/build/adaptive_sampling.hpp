#pragma once

#include <functional>
#include <optional>

#include "characterise/run/request.hpp"
#include "characterise/run/build_runs.hpp"
#include "characterise/fit/fit_curve.hpp"
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
  ElasticCorrection elastic;
  const ContactRecord* elastic_press;  ///< of a body of several materials; else null
  int press_cells, impact_cells;
  /// The law without runs, by the elastic correction; none: there is no guide.
  std::function<std::optional<LawShape>(const ElasticCorrection&)> guide;
  bool known;  ///< the guide is the rate-independent law, for which no run is needed

  bool guided() const { return guide(elastic).has_value(); }
};

/// Runs made, the law's shape by them, and that shape without each run.
struct Sampled
{
  ContactRecords records;
  FittedShape fitted;
  std::vector<LeftOutRun> slow, fast;
};

/// Runs a plan, fits, and adds runs where a run left out is missed, until no interval is left to bisect.
Sampled sample(SamplingPlan plan, const SamplingSetting& setting, BuildRuns& runs);

/// Which axis a body's law has.
AxisTable::By axis_kind_of(const CharacterisedBody& body);

}  // namespace granulaw
