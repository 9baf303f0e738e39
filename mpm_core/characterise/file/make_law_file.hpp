#pragma once

#include "characterise/file/law_file_plan.hpp"
#include "farm/farm.hpp"

namespace granulaw {

/// A law file in memory, and what it took to make it.
struct MadeLawFile
{
  /// Runs of the solver for one law.
  struct Runs
  {
    std::size_t made = 0;       ///< runs that the sampling asked for
    double sampling_error = 0;  ///< largest where nothing was sampled, as it counts for the tolerance: above
                                ///< it where sampling ended before it was reached
    std::string size;           ///< of a rate-dependent body: the size and the speeds that its law holds for
  };
  Law law;                           ///< write_law() writes it
  std::map<std::string, Runs> runs;  ///< by name of the body, or of the pair ("a:b") whose own law it is
};

/// Makes every law of the plan, from the atlas or by runs of the solver, with certificates, what each pair
/// costs, and the provenance: version, git_hash, created (UTC), material hashes, counts of runs. Runs are
/// made by `farm` (its cache spares finished ones), without one by this thread. `progress` is called for runs
/// only and may throw to stop. Throws Error where a law is not admissible or misses the tolerance.
///
///     LawFileRequest request;
///     request.materials.materials["powder"] = {1500, 10e9, 0.3, 100e6};
///     const Atlas atlas = read_atlas("atlas.h5");
///     request.atlas = &atlas;
///     write_law(make_law_file(plan_law_file(request)).law, "law.h5");
MadeLawFile make_law_file(const LawFilePlan& plan, Farm* farm = nullptr, const Progress& progress = {});

}  // namespace granulaw
