#pragma once

#include <optional>
#include <string>

#include "base/attraction.hpp"
#include "options.hpp"
#include "solver/runs.hpp"

namespace granulaw {

/// The kind of grid of this name. Throws Error.
GridKind grid_of(const std::string& name);

/// Request of `mpm impact` and `mpm press`: the bodies, the options of the run, and the files it writes.
struct RunRequest
{
  std::string materials, particle, against, wall;
  std::string grid = "auto", precision = "double";
  std::string output, fields, checkpoint;
  double checkpoint_every = 30;  ///< s
  double courant = RunOptions{}.courant;
  std::optional<double> tolerance;
  std::optional<int> resolution;
  std::optional<int> shifted_grids;
  int jobs = 1, frames = 40;
  bool json = false, no_estimate = false;
  Attraction attraction;  // of the command, else of the materials

  void add_to(Options& command);
  /// Throws Error where an option, or two together, cannot be used: before anything is read or computed.
  void check() const;
  /// For the solver, but for what watches the run.
  RunOptions options(bool three_dimensions) const;
};

/// A particle and what it meets.
struct Meeting
{
  Particle particle;
  Partner partner;
};

/// Those that the request names, from its materials file. Throws Error.
Meeting read_meeting(const RunRequest& request);

/// The grid of the particle, by name: the one asked for, else what the particle needs.
std::string grid_name(const RunRequest& request, const Particle& particle);

/// To be called where an option was given that only the three-dimensional grid knows; throws Error where
/// another grid is asked for.
void require_three_dimensions(RunRequest& request, const std::string& option);

/// True if the run is three-dimensional; throws Error where particle, partner and grid do not go together.
bool in_three_dimensions(const RunRequest& request, const Particle& particle);

}  // namespace granulaw
