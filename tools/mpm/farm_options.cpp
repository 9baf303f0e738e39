#include "farm_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <thread>

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "option_checks.hpp"
#include "ranks.hpp"

namespace granulaw {

void FarmOptions::add_to(Options& command)
{
  command.add_option("--jobs", jobs, "runs at the same time in each process (default: one for each core; under mpirun: one)").check(whole_from_to(1, 1024));
  const Option folder = command.add_option("--cache", cache, "folder for finished runs").capture_default_str();
  command.add_flag("--no-cache", no_cache, "keep no finished run and reuse none").excludes(folder);
}

void FarmOptions::check() const
{
  if (!no_cache && std::filesystem::exists(cache) && !std::filesystem::is_directory(cache)) fail("--cache", "is no folder", fmt::format("'{}'", cache));
}

std::unique_ptr<Farm> FarmOptions::farm() const
{
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int threads = jobs > 0 ? jobs : ranks() > 1 ? 1 : cores;
  if (no_cache || cache.empty() || rank() != 0) return make_farm(threads, RunCache{});
  try {
    prepare_cache();
  } catch (const Error& refused) {
    // a folder that nobody named stops no run
    if (cache != default_cache_folder()) throw;
    fmt::print(stderr, "mpm: warning: {}: runs that finish are not kept\n", refused.what());
  }
  return make_farm(threads, RunCache(cache));
}

void FarmOptions::prepare_cache() const
{
  std::error_code problem;
  std::filesystem::create_directories(cache, problem);
  if (problem) fail("--cache", fmt::format("the folder '{}' cannot be made ({})", cache, problem.message()));
  require_writable((std::filesystem::path(cache) / "a.run").string(), "--cache");
}

void print_count(const FarmCount& c)
{
  fmt::print("{} runs made in {:.1f} CPU s", c.made, c.cpu_s);
  if (ranks() > 1) fmt::print(" on {} ranks", ranks());
  if (c.from_cache) fmt::print(", {} taken from the cache ({:.1f} CPU s saved)", c.from_cache, c.cpu_s_saved);
  if (c.retried) fmt::print("; {} of them failed at first, {} at a higher resolution too", c.retried, c.failed);
  fmt::print("\n");
}

}  // namespace granulaw
