#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "solver/runs.hpp"

namespace granulaw {

/// A body of any shape thrown at a rigid plane.
struct BodyThrow
{
  double velocity = 0;             ///< m/s, towards the plane
  double tangential_velocity = 0;  ///< m/s, along the plane
  double spin = 0;                 ///< rad/s: forward, as of a body that rolls in the direction it slides in
  double friction = 0;             ///< Coulomb's coefficient of the plane
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

struct PlanesPlan
{
  std::vector<PressPlane> planes;
  double depth = 0;  ///< m, way of the planes of speed 1
  double ramp = 0;   ///< loading time in R/c*; 0: the default of the run
};

/// The body hits the plane and leaves it. `rebound` and `planes` of the result are filled; restitution
/// is that of the centre's normal velocity.
RunResult run_body_impact(const Particle& particle, const BodyThrow& thrown, const RunOptions& options = {});

/// All planes move in together, are held, and go back until none touches the body. The trace follows the
/// first plane; restitution is sqrt(work given back/work put in) of all planes.
RunResult run_planes_press(const Particle& particle, const PlanesPlan& plan, const RunOptions& options = {});

/// Force of each plane at its largest way, N: the mean of the loading's last percent.
double force_at_depth(const RunResult& press, std::size_t plane);

}  // namespace granulaw
