#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "solver/material.hpp"
#include "solver/output/checkpoint.hpp"
#include "solver/output/fields.hpp"
#include "solver/output/trace.hpp"
#include "solver/particle/particle.hpp"

namespace granulaw {

/// How the pressed body is held.
enum class Support {
  free,     ///< the whole sphere, its centre of mass driven by a uniform body force: as in a collision
  midplane  ///< half a sphere whose equator plane is driven: as finite-element references do
};

/// How a body is cut into cells (docs/theory/method.md).
enum class GridKind {
  automatic,    ///< what the scene needs: `mapped` for homogeneous spheres, else `rectilinear`
  mapped,       ///< fitted to the sphere: fastest and most exact
  rectilinear,  ///< graded Cartesian reference grid: any body of revolution, layers, inclusions
  updated,      ///< the points move through a fixed grid: the independent check
  spatial       ///< graded rectilinear in three dimensions: any shape, side, friction (spatial_runs.hpp)
};

/// "auto", "mapped", "rectilinear", "updated" or "rectilinear-3d", as the command line has it.
const char* name_of(GridKind grid);

/// Precision of the material points; nodes are double always.
enum class Precision { full, single };

/// What the particle meets; nothing given: the rigid, frictionless plane.
struct Partner
{
  std::optional<Particle> particle{};  ///< a second particle, pole against pole
  std::optional<Material> wall{};      ///< a thick deformable wall with a flat, frictionless face
};

struct RunOptions
{
  GridKind grid = GridKind::automatic;
  Precision precision = Precision::full;
  int resolution = 0;  ///< cells across the contact block; 0: the default of the run
  double refine = 1;   ///< factor on the resolution, given or default: a run that failed is tried again finer
  int shifted_grids =
      4;  ///< runs on grids shifted against each other by equal parts of a cell; their mean is free
          ///< of the first harmonics of the contact-edge grid noise (shifted_grids.hpp); 1: a single run
  int threads = 1;        ///< threads that share these runs
  double courant = 0.85;  ///< time step over the stability limit, 0.05 to 1
  double slowness = 1;    ///< press: factor on the ramp
  int samples = 800;      ///< trace length aimed at
  bool estimate_error =
      false;  ///< run a second, coarser resolution and fill error_estimate (accuracy.hpp; costs 1/3 more)
  /// Pa, by the particle's materials; given for an elastic body: its run tells where each would begin to
  /// yield (RunResult::yield_overlaps). Infinity: not asked for. Empty: none.
  std::vector<double> yield_stresses{};
  FieldObserver fields;  ///< who wants to see the body while the run goes on (fields.hpp)
  std::function<void(double fraction)>
      progress;                   ///< called now and then with 0..1; may throw to stop the run
  CheckpointStore checkpoints{};  ///< where the runs keep their state (checkpoint.hpp); not with `fields`
};

/// A particle thrown along its axis at a partner, with the relative `velocity` (m/s, > 0); runs until they
/// have parted. Overlap: approach of the centres of mass.
RunResult run_impact(const Particle& particle, double velocity, const RunOptions& options = {},
                     const Partner& partner = {});
RunResult run_impact(const Sphere& sphere, double velocity, const RunOptions& options = {});

struct PressPlan
{
  double depth = 0;  ///< m, deepest overlap
  Support support = Support::free;
  std::vector<double>
      partial_unloads;  ///< m, ascending overlaps < depth at which the press unloads until the
                        ///< force ends, then reloads; each makes an unload and a reload segment
  double ramp = 0;      ///< loading time in R/c*; 0: the default of the run
};

/// Loading time, R/c*, that a press to `depth` (over R) takes where its plan names none: slow enough for the
/// rate-free law. `yield_over_e_star`: Y/E* of the weakest body; infinity: elastic.
double default_press_ramp(double depth, double yield_over_e_star);

/// A particle pressed slowly along its axis onto its partner to plan.depth and taken off completely.
RunResult run_press(const Particle& particle, const PressPlan& plan, const RunOptions& options = {},
                    const Partner& partner = {});
RunResult run_press(const Sphere& sphere, const PressPlan& plan, const RunOptions& options = {});

/// The grid that `GridKind::automatic` takes for a particle, and why, as the end of a sentence.
struct GridChoice
{
  GridKind grid;
  std::string reason;
};
GridChoice choose_grid(const Particle& particle);

}  // namespace granulaw
