#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <memory>
#include <optional>

#include "base/error.hpp"
#include "solver/loading/flight.hpp"
#include "solver/run/accuracy.hpp"
#include "solver/run/axisymmetric_setup.hpp"
#include "solver/run/mean_run.hpp"
#include "solver/run/simulation.hpp"
#include "solver/run/spatial_setup.hpp"
#include "solver/runs.hpp"
#include "solver/shape/rotation.hpp"

namespace granulaw {

namespace {

/// Sums over the nodes of a part, for the whole body: what the mirrored parts add.
Eigen::Matrix3d lumped_inertia(const Body& body, const Vector3& centre)
{
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  const Reference& reference = body.reference();
  for (int i = 0; i < reference.nodes; ++i) {
    if (reference.mass_i[i] <= 0) continue;
    const Vector3 x = place_now(body, i) - centre;
    second += reference.mass_i[i] * x * x.transpose();
  }
  second *= reference.copies();
  for (int d = 0; d < 3; ++d)
    if (reference.mirrored[d])
      for (int e = 0; e < 3; ++e)
        if (e != d) second(d, e) = second(e, d) = 0;
  return second.trace() * Eigen::Matrix3d::Identity() - second;
}

/// The rigid-body motion after an impact. The tensor of inertia is the exact one of the undeformed body plus
/// what the nodes' own has changed by since (their own is h^2/2 a mass too large).
class ReboundMeter
{
 public:
  /// `centre`: of mass of the body at rest.
  ReboundMeter(const Body& body, const Vector3& centre, const std::optional<Eigen::Matrix3d>& exact)
      : centre_(centre), start_(lumped_inertia(body, centre)), exact_(exact ? *exact : start_)
  {
  }
  const Eigen::Matrix3d& inertia_at_rest() const { return exact_; }
  /// Angular velocity and energy of the rigid motion.
  Vector3 spin(const Body& body) const { return inertia(body).ldlt().solve(angular(body)); }
  double energy(const Body& body) const
  {
    return 0.5 * body.reference().copies() * body.mass() * mean_velocity(body).squaredNorm() +
           0.5 * angular(body).dot(spin(body));
  }

 private:
  Vector3 centre(const Body& body) const { return centre_ + travel_of(body); }
  Eigen::Matrix3d inertia(const Body& body) const { return exact_ + lumped_inertia(body, centre(body)) - start_; }
  Vector3 angular(const Body& body) const { return of_whole(body, angular_momentum(body, centre(body))); }

  Vector3 centre_;
  Eigen::Matrix3d start_, exact_;
};

/// A body that meets a plane, or a second sphere, in three dimensions.
std::unique_ptr<SpatialSetup> thrown_body(const Particle& particle, const Approach& thrown,
                                          const Partner& partner, const RunOptions& options)
{
  Plane wall = touching_plane(Vector3::UnitZ());
  wall.friction = thrown.friction;
  const bool slides = thrown.tangential_velocity != 0 || thrown.spin != 0;
  const Eigen::Matrix3d rotation =
      rotation_to_plane(unit_direction(thrown.orientation, "--orientation"), thrown.turn);
  auto setup = std::make_unique<SpatialSetup>(particle, rotation, std::vector<Plane>{wall},
                                              std::array<bool, 3>{!slides, true, false}, options, partner.attraction);
  if (partner.attraction.work > 0 && slides)
    fail("--work-of-adhesion", "is computed of bodies that neither slide nor spin");
  if (partner.particle && thrown.first_contact_only)
    fail("first contact", "is followed on a rigid plane only", "a particle");
  if (partner.particle) setup->meet(*partner.particle, options);
  return setup;
}

void check_approach(const Approach& thrown, const Scales& scale)
{
  if (!(thrown.velocity > 0))
    fail("--velocity", "cannot be used", fmt::format("{:g}", thrown.velocity), "over 0 (m/s)");
  if (!(thrown.velocity < 0.5 * scale.velocity()))
    fail("--velocity", "is beyond what an impact of a particle can be resolved for",
         fmt::format("{:g} m/s", thrown.velocity),
         fmt::format("up to half the wave speed sqrt(E*/rho), {:.4g} m/s", 0.5 * scale.velocity()));
  if (!(thrown.friction >= 0 && thrown.friction <= 10))
    fail("--friction", "cannot be used", fmt::format("{:g}", thrown.friction), "0 to 10");
}

/// A velocity or a spin in the frame of the second body, which is mirrored in z, in that of the first.
const Vector3 velocity_back(1, 1, -1), spin_back(-1, -1, 1);

/// The body's motion after an impact, over that before; solver units. `velocity`: of the approach.
Rebound rebound_of(const Scene& scene, std::span<const ReboundMeter> meters, const Approach& thrown,
                   const Vector3& velocity)
{
  const Body& body = scene.bodies.front();
  Vector3 after = mean_velocity(body), spin = meters[0].spin(body), partner_spin = Vector3::Zero();
  if (scene.bodies.size() > 1) {
    after -= velocity_back.cwiseProduct(mean_velocity(scene.bodies[1]));
    partner_spin = spin_back.cwiseProduct(meters[1].spin(scene.bodies[1]));
  }
  const double mass = scene.bodies.size() > 1 ? scene.reduced_mass() : body.mass();
  const Vector3 impulse = body.reference().copies() * mass * (after - velocity);
  const bool slides = thrown.tangential_velocity != 0 || thrown.spin != 0;
  Rebound rebound;
  rebound.normal = after[2] / -velocity[2];
  rebound.tangential = after[0] / velocity[0];
  rebound.spin = {spin[0], spin[1], spin[2]};
  rebound.partner_spin = {partner_spin[0], partner_spin[1], partner_spin[2]};
  rebound.impulse_normal = impulse[2];
  rebound.impulse_tangential = slides ? -impulse[0] : 0.0;
  return rebound;
}

}  // namespace

RunResult impact(const Particle& particle, const Approach& thrown, const Partner& partner,
                 const RunOptions& options)
{
  if (options.estimate_error)
    return run_with_estimate(options,
                             [&](const RunOptions& o) { return impact(particle, thrown, partner, o); });
  check_options(options, particle);
  const bool oblique = thrown.tangential_velocity != 0 || thrown.spin != 0 || thrown.friction != 0 ||
                       thrown.orientation != Approach{}.orientation || thrown.turn != 0 ||
                       thrown.first_contact_only;
  std::unique_ptr<SpatialSetup> spatial;
  std::unique_ptr<Setup> flat;
  if (in_three_dimensions(particle, partner, options, oblique ? "an approach that is not head-on" : nullptr))
    spatial = thrown_body(particle, thrown, partner, options);
  else
    flat = std::make_unique<Collision>(particle, partner, options, Support::free);
  const Setup& setup = spatial ? *spatial : *flat;
  const Scales scale = setup.scale();
  check_approach(thrown, scale);
  const double v = thrown.velocity / scale.velocity();
  const Vector3 spin(0, thrown.spin * scale.time(), 0);
  const double deepest = setup.expected_overlap(v), duration = 2.0 * deepest / v + 2.5;

  const int across = setup.cells(options, deepest);
  return mean_of_shifted_grids(
      options, across, setup.cells_made(deepest, across), scale, true,
      [&](int cells, double shift, const auto& fields, const auto& progress, const auto& checkpoint) {
        Simulation run(setup.build(deepest, cells, shift), options, duration, scale.stress);
        Scene& scene = run.scene;
        std::vector<ReboundMeter> meters;
        if (spatial) meters.emplace_back(scene.bodies[0], scene.centre, spatial->exact_inertia());
        if (spatial && spatial->partner())
          meters.emplace_back(scene.bodies[1], Vector3::Zero(), spatial->partner()->exact_inertia());
        std::optional<LeavingPoint> point;
        if (thrown.first_contact_only)
          point = {spatial->first_contact() - scene.centre, meters[0].inertia_at_rest().inverse()};
        const Vector3 along(thrown.tangential_velocity / scale.velocity(), 0, 0);
        const double reduced = scene.reduced_mass();
        for (Body& body : scene.bodies) {
          const bool first = &body == scene.bodies.data();  // the second one has no tangential velocity
          const Vector3 towards = v * (reduced / body.mass()) * scene.outward;
          if (first)
            throw_body(body, along - towards, spin, scene.centre);
          else
            throw_body(body, -towards);
        }
        // surfaces that attract each other gain speed before they touch
        if (partner.attraction.work > 0) move_body(scene.bodies.front(), partner.attraction.range / scale.length * scene.outward);
        Flight programme(duration, point, partner.attraction.work > 0);
        run.run(programme, {fields, scale, duration}, progress, checkpoint);
        RunSummary& s = run.result.summary;
        s.restitution_raw = scene.separation_velocity() / v;
        s.work_load = scene.bodies.front().reference().copies() * run.energy_start;
        s.work_unload = spatial ? 0 : s.work_load * s.restitution_raw * s.restitution_raw;
        for (std::size_t b = 0; b < meters.size(); ++b) s.work_unload += meters[b].energy(scene.bodies[b]);
        if (programme.sticks()) s.sticks = true, s.restitution_raw = 0;
        if (spatial) run.result.rebound = rebound_of(scene, meters, thrown, along - v * scene.outward);
        return std::move(run.result);
      });
}

}  // namespace granulaw
