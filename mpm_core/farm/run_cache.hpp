#pragma once

#include <string>

#include "farm/run_queue.hpp"

namespace granulaw {

/// Finished runs on disk: a killed build takes up where it stopped, and a wider one reuses what a narrower
/// one has made. One file NAME.run for each run (about 30 kB), named by a hash of its key; the key itself
/// stands in the file and decides. A file is complete or absent, so that several builds may share a folder;
/// a damaged one counts as absent. Nothing is ever removed: to empty the cache, remove the folder.
///
///     granulaw run 3
///     key KEY
///     cost COST                    as expected, RunJob::cost
///     cpu_s SECONDS                as it turned out
///     outcome BYTES CHECKSUM       then BYTES bytes: visit_state() of the RunOutcome, order of the machine
class RunCache
{
 public:
  /// An empty folder name: nothing is kept.
  explicit RunCache(std::string folder = {}) : folder_(std::move(folder)) {}

  /// True if the run was found; it is then marked `from_cache`.
  bool load(const std::string& key, RunOutcome& outcome) const;
  /// If this is not possible (disk full, no right to write), the run is not cached, which only costs time.
  void store(const std::string& key, double cost, const RunOutcome& outcome) const;
  const std::string& folder() const { return folder_; }

 private:
  std::string file_of(const std::string& key) const;
  std::string folder_;
};

/// $XDG_CACHE_HOME/granulaw/runs, else ~/.cache/granulaw/runs; empty if neither variable is set.
std::string default_cache_folder();

}  // namespace granulaw
