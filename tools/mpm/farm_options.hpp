#pragma once

#include <memory>
#include <string>

#include "farm/farm.hpp"
#include "options.hpp"

namespace granulaw {

/// The options of every command that makes many runs: where, how many at once, which are kept.
struct FarmOptions
{
  int jobs = 0;  ///< 0: one for each core, on several ranks one for each
  std::string cache = default_cache_folder();
  bool no_cache = false;

  void add_to(Options& command);
  /// Throws Error if the cache cannot be a folder: before anything is computed.
  void check() const;
  /// Makes the cache, too. Throws Error if it cannot be written to; of the default one that is a warning.
  std::unique_ptr<Farm> farm() const;

 private:
  void prepare_cache() const;
};

/// Runs that the farm spent and saved, as one line.
void print_count(const FarmCount& count);

}  // namespace granulaw
