#pragma once

#include <string>

#include "solver/trace.hpp"

namespace granulaw {

/// Finished runs on disk, so that a killed build takes up where it stopped. One text file for each run, named
/// by a hash of its key; the key itself stands in the file and decides. A file is complete or absent.
class RunCache
{
 public:
  /// An empty folder name: nothing is kept.
  explicit RunCache(std::string folder) : folder_(std::move(folder)) {}

  /// True if the run was found. A damaged file counts as not found.
  bool load(const std::string& key, RunResult& result) const;
  void store(const std::string& key, const RunResult& result) const;
  /// Removes what store() wrote, and the folder if it is then empty.
  void remove() const;

 private:
  std::string file_of(const std::string& key) const;
  std::string folder_;
};

}  // namespace granulaw
