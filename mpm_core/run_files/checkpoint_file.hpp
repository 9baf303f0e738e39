#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "solver/runs.hpp"

namespace granulaw {

/// Request of a run and its program: names and values, to the last digit. Runs of equal identity have the
/// identical trace.
using RunIdentity = std::vector<std::pair<std::string, std::string>>;

/// Program, instruction set, particles, partner and those options that the command line does not name;
/// `asked` leads: the command, its drive and all options that it was given and that matter.
RunIdentity identity_of(RunIdentity asked, const Particle& particle, const Partner& partner,
                        const RunOptions& options);

/// --checkpoint FILE: the states of all runs of one command in one file, written whole or not at all.
///
/// Layout: the line "granulaw checkpoint 1", the length and the checksum (FNV-1a, 64 bit) of what follows,
/// then, as StateArchive writes them, the identity and the state of each run by its key.
class CheckpointFile
{
 public:
  /// Reads `path` if it exists. Throws Error, and leaves the file as it is, if it is damaged, no checkpoint
  /// at all or of another run. Each run is saved every `interval` seconds, 0: at every sample of its trace,
  /// and once `at_once` is true.
  CheckpointFile(std::string path, double interval, RunIdentity identity, std::function<bool()> at_once = {});

  bool was_found() const { return was_found_; }
  /// Hooks for RunOptions; must not outlive this.
  CheckpointStore store();
  /// The run is finished and its outputs are written.
  void remove() const;

 private:
  void read();
  void write() const;
  bool due(const std::string& key);

  std::string path_;
  std::chrono::duration<double> interval_;
  RunIdentity identity_;
  std::function<bool()> at_once_;
  bool was_found_ = false;
  std::mutex mutex_;  // of what follows
  std::map<std::string, std::string> states_;
  std::map<std::string, std::chrono::steady_clock::time_point> saved_;
};

}  // namespace granulaw
