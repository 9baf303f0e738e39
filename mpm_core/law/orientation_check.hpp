#pragma once

#include <array>
#include <string>
#include <vector>

namespace granulaw {

/// Result of a contact in one impact: by the solver, or by a sphere's law.
struct ContactAnswer
{
  double force_max = 0;  ///< N
  /// sqrt(W_u/W_l): W_l is the energy of the rigid motion that the contact takes until that energy is least,
  /// W_u what it gives back (Stronge 1990). Where the contact stays at its place on the body, the ratio of
  /// its normal velocities.
  double restitution = 0;
};

/// One way in which a body of any shape hits a rigid wall, by the solver and by the law of a sphere of the
/// local radius.
struct OrientationCheck
{
  enum class Local {
    curved,     ///< the law applies
    edge,       ///< a radius of curvature is 0: no sphere is like it
    flat,       ///< a radius is infinite, or the surface is hollow
    beyond_law  ///< the overlap leaves the law's table
  };

  std::array<double, 3> direction{};  ///< unit vector in the body's frame that points at the wall
  double velocity = 0;                ///< m/s
  /// m, principal radii of curvature of the surface that touches first; infinite in a flat.
  double sharper_radius = 0, flatter_radius = 0;
  double effective_mass = 1;  ///< that resists there, over the body's (effective_mass_share)
  double height = 0;  ///< m, of the centre of mass over the contact; 0: of a file that does not say
  Local local = Local::curved;
  ContactAnswer solver;
  /// By the law, and by it with the body behind the contact (contact/body_behind.hpp): only where Local::curved, the
  /// second only with a height.
  ContactAnswer law, law_with_body;

  /// sqrt(R' R''), m: the Gaussian radius of curvature.
  double local_radius() const;
  double force_error(const ContactAnswer& by) const { return by.force_max / solver.force_max - 1; }  ///< relative
  double restitution_error(const ContactAnswer& by) const { return by.restitution - solver.restitution; }  ///< absolute
};

/// "curved", "edge", "flat", "beyond the law".
const char* name_of(OrientationCheck::Local local);

/// Two quantiles of the errors' magnitudes over the directions where the law applies.
struct ErrorQuantiles
{
  double median = 0, largest = 0;  ///< largest: of 95 % of the directions
};

/// Errors, by direction, of a sphere's law with the local radius of curvature for one body. They show if
/// spheres' laws serve a DEM code's clumps or superquadrics of this shape.
struct ShapeCertificate
{
  std::string shape;                     ///< which body it is of, on one line
  std::array<bool, 3> mirrors{};         ///< the body's mirror planes x, y, z = 0: the checks lie on one side
  double volume = 0;                     ///< m^3
  double solver_error = 0;               ///< relative, of F and e: four directions by two resolutions
  std::vector<OrientationCheck> checks;  ///< by velocity, then by direction

  /// Errors of the law, or of the law with the body behind the contact.
  ErrorQuantiles force(ContactAnswer OrientationCheck::* by = &OrientationCheck::law) const;
  ErrorQuantiles restitution(ContactAnswer OrientationCheck::* by = &OrientationCheck::law) const;
  /// True: every answer of the law has one with the body, too.
  bool has_body() const;
  /// Share of all directions where the law has an answer.
  double covered() const;
};

}  // namespace granulaw
