#pragma once

#include <span>
#include <vector>

#include "characterise/orientations.hpp"
#include "farm/farm.hpp"
#include "law/law.hpp"
#include "solver/particle/particle.hpp"

namespace granulaw {

/// What a contact does in one impact: by the solver, or by a sphere's law.
struct ContactAnswer
{
  double force_max = 0;  ///< N
  /// Of the normal velocity of the point that touches first: J/(m_e V) - 1, J the normal impulse. Where the
  /// contact moves far over the body, as at a flattened corner, m_e grows on the way, and it may exceed 1.
  double restitution = 0;
};

/// One way in which a body of any shape hits a rigid wall, by the solver and by the law of a sphere of the
/// local radius.
struct OrientationCheck
{
  enum class Local {
    curved,     ///< the law answers
    edge,       ///< a radius of curvature is 0: no sphere is like it
    flat,       ///< a radius is infinite, or the surface is hollow
    beyond_law  ///< the overlap leaves the law's table
  };

  Orientation orientation;
  double velocity = 0;      ///< m/s
  double local_radius = 0;  ///< sqrt(R' R''), m: the Gaussian radius of curvature
  Local local = Local::curved;
  ContactAnswer solver, law;  ///< law: only where Local::curved

  double force_error() const { return law.force_max / solver.force_max - 1; }        ///< relative
  double restitution_error() const { return law.restitution - solver.restitution; }  ///< absolute
};

/// Two quantiles of the errors' magnitudes over the directions where the law answers.
struct ErrorQuantiles
{
  double median = 0, largest = 0;  ///< largest: of 95 % of the directions
};

/// What a sphere's law with the local radius of curvature is wrong by for this body, direction by direction:
/// whether spheres' laws serve a DEM code's clumps or superquadrics of this shape.
struct ShapeCertificate
{
  std::vector<OrientationCheck> checks;  ///< by velocity, then by direction
  double solver_error = 0;               ///< relative, of F: two resolutions of one direction

  ErrorQuantiles force() const;
  ErrorQuantiles restitution() const;
  /// Share of all directions where the law has an answer.
  double covered() const;
};

struct ShapeQuestion
{
  int directions = 30;             ///< over all that the body's mirror planes leave
  std::vector<double> velocities;  ///< m/s, over 0
  int resolution = 8;              ///< cells across the contact block of each run
};

/// Throws the body in each direction and replays the law of a sphere of its material. The law's contact has
/// the radius sqrt(R' R'') (a plastic contact of overlap delta has the area 2 pi delta sqrt(R' R''), whatever
/// their ratio) and the mass that resists at the point (effective_mass_share). Frictionless. `particle`:
/// of one material; `law`: of that material's sphere. Throws Error where a run fails twice.
ShapeCertificate certify_shape(const Particle& particle, const BodyLaw& law, const ShapeQuestion& question,
                               Farm& farm, const Progress& progress = {});

}  // namespace granulaw
