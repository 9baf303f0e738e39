#include "characterise/run/build_runs.hpp"

#include "base/error.hpp"

namespace granulaw {

std::vector<RunOutcome> BuildRuns::make(const std::vector<RunJob>& jobs, double until)
{
  const double from = done_;
  ThreadFarm alone(1);
  Farm& farm = options_.farm ? *options_.farm : alone;
  std::vector<RunOutcome> outcomes = farm.run(jobs, [&](double done, const std::string& what) {
    if (options_.progress) options_.progress(from + (until - from) * done, what);
  });
  done_ = until;
  count_ += jobs.size();
  for (std::size_t k = 0; k < outcomes.size(); ++k)
    if (outcomes[k].failed()) holes_.push_back(jobs[k].label + ": " + outcomes[k].error);
  return outcomes;
}

std::vector<RunOutcome> BuildRuns::make_needed(const std::vector<RunJob>& jobs, double until,
                                               const std::string& what)
{
  std::vector<RunOutcome> outcomes = make(jobs, until);
  for (const RunOutcome& outcome : outcomes)
    if (outcome.failed()) fail("", what + " fails: " + outcome.error);
  return outcomes;
}

}  // namespace granulaw
