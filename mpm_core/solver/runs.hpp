#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/attraction.hpp"
#include "solver/material/material.hpp"
#include "solver/output/checkpoint.hpp"
#include "solver/output/fields.hpp"
#include "solver/output/trace.hpp"
#include "solver/shape/particle.hpp"

namespace granulaw {

/// Support of the pressed body.
enum class Support {
  free,     ///< the whole sphere, its centre of mass driven by a uniform body force: as in a collision
  midplane  ///< half a sphere whose equator plane is driven: as finite-element references do
};

/// Division of a body into cells (docs/theory/method.md).
enum class GridKind {
  automatic,    ///< what the scene needs: `mapped` for homogeneous spheres, else `rectilinear`
  mapped,       ///< fitted to the sphere: fastest and most exact
  rectilinear,  ///< graded Cartesian reference grid: any body of revolution, layers, inclusions
  updated,      ///< the points move through a fixed grid: the independent check
  spatial       ///< graded rectilinear in three dimensions: any shape, side, friction
};

/// "auto", "mapped", "rectilinear", "updated" or "rectilinear-3d", as the command line has it.
const char* name_of(GridKind grid);

/// Precision of the material points; nodes are double always.
enum class Precision { full, single };

/// Partner of the particle; nothing given: the rigid, frictionless plane.
struct Partner
{
  std::optional<Particle> particle{};  ///< a second particle, pole against pole
  std::optional<Material> wall{};      ///< a deformable wall with a flat, frictionless face
  Attraction attraction{};             ///< between their surfaces; three dimensions: of rigid planes
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
  /// Pa, by the particle's materials; given for an elastic body: its run finds where each would begin to
  /// yield (RunResult::yield_overlaps). Infinity: not asked for. Empty: none.
  std::vector<double> yield_stresses{};
  FieldObserver fields;  ///< who wants to see the body while the run goes on (fields.hpp)
  std::function<void(double fraction)>
      progress;                   ///< called now and then with 0..1; may throw to stop the run
  CheckpointStore checkpoints{};  ///< where the runs keep their state (checkpoint.hpp); not with `fields`
};

/// Approach of a particle. With the defaults of all but `velocity`: head-on along its axis, for which two
/// dimensions suffice. Any other approach is computed in three, against the rigid plane or, of a sphere, against
/// a second sphere that has no tangential velocity.
struct Approach
{
  double velocity = 0;             ///< m/s, over 0: towards the plane or the partner
  double tangential_velocity = 0;  ///< m/s, along the plane
  double spin = 0;                 ///< rad/s: forward, as of a body that rolls in the direction it slides in
  double friction = 0;             ///< Coulomb's coefficient of the contact, 0 to 10
  /// Direction in the body's frame that points at the plane. The body's axis nearest to it leans towards +x,
  /// along which the tangential velocity is.
  std::array<double, 3> orientation{0, 0, -1};
  double turn = 0;  ///< rad, by which the body is turned about the plane's normal
  /// The run ends with the first contact, and overlaps are those of the point there. Otherwise it ends when
  /// the centre of mass leaves: an eccentric body may turn over its first contact and hit again elsewhere.
  bool first_contact_only = false;
};

/// A rigid plane that a body is pressed with.
struct PressPlane
{
  std::array<double, 3> direction{0, 0, 1};  ///< from the body to the plane, in the body's frame
  std::optional<double> distance{};          ///< m, from the origin of that frame; none: it touches the body
  double speed = 1;  ///< over that of the programme: 1 moves in by the depth, 0 stands
  double friction = 0;
};

/// The planes of a named arrangement: pair, cube, die (a pair moves in, four planes stand), bcc (8), fcc
/// (12). Empty: no such name.
std::vector<PressPlane> named_planes(const std::string& name);

struct PressPlan
{
  double depth = 0;  ///< m, deepest overlap; with planes: way of those of speed 1. Over 0, up to 0.8 R
  Support support = Support::free;        ///< two dimensions
  std::vector<double> partial_unloads{};  ///< m: ascending overlaps < depth at which the press unloads until
                                          ///< the force ends, then reloads; each makes an unload and a reload
                                          ///< segment
  double ramp = 0;                        ///< loading time in R/c*; 0: the default of the run
  std::vector<PressPlane> planes{};  ///< planes that press the body in three dimensions; none: its partner
};

/// A particle thrown at a partner; runs until they have parted. Overlap: approach of the centres of mass. The
/// dimension is the one that particle, approach and `options.grid` need. Throws Error (base/error.hpp), one
/// sentence, where something cannot be used, or where the run fails. In three dimensions `rebound` of the result
/// is filled and, without a partner, `planes`. Method and accuracy: docs/theory/method.md,
/// docs/evidence/solver-accuracy.md.
RunResult impact(const Particle& particle, const Approach& approach, const Partner& partner = {},
                 const RunOptions& options = {});

/// A particle pressed slowly onto its partner, or by planes, to plan.depth and taken off completely.
/// Dimension and errors as of impact(). With planes the trace follows the first, and restitution is sqrt(work
/// given back/work put in) of all; a body of any shape that names none is pressed by a pair.
RunResult press(const Particle& particle, const PressPlan& plan, const Partner& partner = {},
                const RunOptions& options = {});

/// Force of each plane at its largest way, N: the mean of the loading's last percent.
double force_at_depth(const RunResult& press, std::size_t plane);

/// Loading time, R/c*, that a press to `depth` (over R) takes where its plan names none: slow enough for the
/// rate-independent law. `yield_over_e_star`: Y/E* of the weakest body; infinity: elastic.
double default_press_ramp(double depth, double yield_over_e_star);

/// The grid that `GridKind::automatic` takes for a particle, and why, as the end of a sentence.
struct GridChoice
{
  GridKind grid;
  std::string reason;
};
GridChoice choose_grid(const Particle& particle);

}  // namespace granulaw
