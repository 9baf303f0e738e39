#pragma once

#include <vector>

#include "contact/unloading.hpp"
#include "solver/output/trace.hpp"

namespace granulaw {

/// Overlap/R and force in any unit, from the reversal to where the force ends; overlaps descend.
struct PathPoint
{
  double x, force;
};
using UnloadingPath = std::vector<PathPoint>;

/// A computed unloading as the law has it: F = F_m phi(u), u = (x - r)/(x_m - r), phi an UnloadingShape.
/// The exponent gives the same work back. The residual r is the one with which a free body needs the same
/// time for it as for the computed one: contact times are what a particle code uses, and the last touch of a
/// faint force falls here or there with the body's vibrations. The Hertz coefficient comes nearest to the
/// path (least squares over the overlap), or is given.
struct UnloadingFit
{
  double residual, hertz_share;
};
UnloadingFit fit_unloading(const UnloadingPath& path, double reversal_force);
double residual_as_long(const UnloadingPath& path, double reversal_force, double hertz_share);

/// One dimensionless collision (R = E* = rho = 1): virgin loading to `depth`, then unloading until the force
/// ends. A press, an impact, or a partial unloading of a press (which has no loading of its own).
struct ContactRecord
{
  struct Sample
  {
    double x, force, radius;
  };                            ///< overlap/R; F/(4/3 E* R^2); a/R
  std::vector<Sample> loading;  ///< ascending x
  double depth = 0;             ///< x_m, largest overlap/R
  double residual = 0;          ///< overlap/R at which the law's unloading ends: UnloadingFit
  double hertz_share = 1;       ///< A of its shape
  UnloadingRadius radius{};     ///< as its contact shrinks
  double work_ratio = 0;        ///< work given back/work put in, W_u/W_L = e^2
  double reversal_force = 0;    ///< as computed just before the reversal, F/(4/3 E* R^2); 0: not known
  double peak = 0;              ///< the summary's force_max, F/(4/3 E* R^2); 0: not known
  UnloadingPath unloading;      ///< from the reversal on, F/(4/3 E* R^2)
  double speed = 0;             ///< sqrt(I) of an impact; 0: a press
  int run = 0;                  ///< which run it is of: a press has several reversal points
  double run_depth = 0;         ///< where that run reverses last; its cells resolve a contact of that depth
};

/// Records of the runs of one body.
struct ContactRecords
{
  struct Impact
  {
    double speed = 0;  ///< sqrt(I)
    ContactRecord path;
  };
  std::vector<ContactRecord> slow;  ///< rate-independent: presses (a partial unloading has no loading of its
                                    ///< own) and slow impacts; ascending depth
  std::vector<Impact> fast;  ///< ascending speed
  double reload_loop = 0;    ///< largest area between a partial unloading and its reloading, over the work
};

/// Takes a run of a sphere of unit radius, density and E* apart: its loading and its last unloading.
ContactRecord contact_record_of(const RunResult& result);

/// The partial unloadings of such a press, in order; without its last. `loop` is raised to the largest area
/// between a partial unloading and its reloading over the work put in until then.
std::vector<ContactRecord> partial_unloadings(const RunResult& result, double& loop);

}  // namespace granulaw
