#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "characterise/run/sampling_plan.hpp"
#include "farm/farm.hpp"
#include "law/law_shape.hpp"

namespace granulaw {

inline CharacterisedBody sphere_of(const MaterialRatios& m) { return characterised_body_of(m.stiffness, m.poisson_ratio, m.hardening); }

/// The runs of a material's plan, named by `before` and the material.
inline void add_jobs(std::vector<RunJob>& jobs, const MaterialRatios& m, const SamplingPlan& plan, const RunSource& source, const std::string& before = {})
{
  for (RunJob& job : sampling_jobs(sphere_of(m), plan, source)) {
    job.label = fmt::format("{}E*/Y {:g}, nu {:g}, H/E {:g}: {}", before, m.stiffness, m.poisson_ratio, m.hardening, job.label);
    jobs.push_back(std::move(job));
  }
}

/// What they showed: the outcomes from `next` on, which counts on.
inline ContactRecords records_of(const MaterialRatios& m, const SamplingPlan& plan, const std::vector<RunOutcome>& outcomes, std::size_t& next)
{
  const auto first = outcomes.begin() + static_cast<std::ptrdiff_t>(next);
  ContactRecords records;
  add_to(records, sphere_of(m), plan, {first, first + static_cast<std::ptrdiff_t>(plan.runs())});
  next += plan.runs();
  return records;
}

}  // namespace granulaw
