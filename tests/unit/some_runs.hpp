#pragma once

#include <cmath>
#include <string>

#include "farm/run_queue.hpp"
#include "base/state_archive.hpp"

namespace granulaw {

/// A result that no solver has made: twenty samples whose numbers need all their bits.
inline RunResult some_result(double seed)
{
  RunResult r;
  for (int k = 0; k < 20; ++k)
    r.trace.push_back(
        {seed * k / 3.0, 1e-7 * k, std::sqrt(2.0) * k, 1e-5, k < 10 ? Branch::load : Branch::unload, k / 10});
  r.summary.restitution = seed / 7;
  r.summary.steps = 12345;
  return r;
}

inline RunOutcome some_outcome(double seed)
{
  RunOutcome outcome;
  outcome.result = some_result(seed);
  outcome.first_error = "a coarse grid";
  outcome.cpu_s = seed / 3;
  return outcome;
}

/// Everything in it, bit for bit, but for `from_cache`.
inline std::string bytes_of(RunOutcome outcome)
{
  StateArchive archive;
  visit_state(archive, outcome);
  return archive.take();
}

}  // namespace granulaw
