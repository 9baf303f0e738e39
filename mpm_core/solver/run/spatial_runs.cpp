#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.hpp"
#include "solver/loading/flight.hpp"
#include "solver/loading/press.hpp"
#include "solver/run/accuracy.hpp"
#include "solver/run/mean_run.hpp"
#include "solver/run/simulation.hpp"
#include "solver/run/spatial_setup.hpp"
#include "solver/runs.hpp"
#include "solver/shape/rotation.hpp"

namespace granulaw {

namespace {

constexpr int default_cells = 8;  ///< as a certificate over orientations (characterise/shape_certificate.cpp)
constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

void check(const RunOptions& options)
{
  if (options.resolution != 0 && (options.resolution < 6 || options.resolution > 100))
    fail("--resolution", "cannot be used", std::to_string(options.resolution),
         "6 to 100 cells across the contact block in three dimensions");
  if (options.shifted_grids < 1 || options.shifted_grids > 64)
    fail("shifted grids", "cannot be used", std::to_string(options.shifted_grids), "1 to 64 shifted grids");
  if (!(options.courant >= 0.05 && options.courant <= 1.0))
    fail("courant", "the explicit step is stable up to 1 only", fmt::format("{:g}", options.courant),
         "0.05 to 1");
  if (options.checkpoints && options.fields)
    fail("--checkpoint", "cannot go with --fields: the frames of a run that was stopped are not kept");
}

int cells_of(const RunOptions& options)
{
  return static_cast<int>(
      std::lround(options.refine * (options.resolution ? options.resolution : default_cells)));
}

Vector3 unit(const std::array<double, 3>& v, const char* where)
{
  const Vector3 x(v[0], v[1], v[2]);
  if (!(x.norm() > 0) || !x.allFinite())
    fail(where, "is no direction", fmt::format("{:g}, {:g}, {:g}", v[0], v[1], v[2]),
         "three numbers, not all 0");
  return x.normalized();
}

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
  ReboundMeter(const Scene& scene, const Eigen::Matrix3d* exact)
      : start_(lumped_inertia(scene.bodies.front(), scene.centre)), exact_(exact ? *exact : start_)
  {
  }
  const Eigen::Matrix3d& inertia_at_rest() const { return exact_; }
  /// Angular velocity and energy of the rigid motion.
  Vector3 spin(const Scene& scene) const { return inertia(scene).ldlt().solve(angular(scene)); }
  double energy(const Scene& scene) const
  {
    const Body& body = scene.bodies.front();
    return 0.5 * body.reference().copies() * body.mass() * mean_velocity(body).squaredNorm() +
           0.5 * angular(scene).dot(spin(scene));
  }

 private:
  Eigen::Matrix3d inertia(const Scene& scene) const
  {
    return exact_ + lumped_inertia(scene.bodies.front(), scene.centre_now()) - start_;
  }
  Vector3 angular(const Scene& scene) const
  {
    return of_whole(scene.bodies.front(), angular_momentum(scene.bodies.front(), scene.centre_now()));
  }
  Eigen::Matrix3d start_, exact_;
};

}  // namespace

RunResult run_body_impact(const Particle& particle, const Approach& thrown, const RunOptions& options)
{
  check(options);
  if (options.estimate_error)
    return run_with_estimate(options,
                             [&](const RunOptions& o) { return run_body_impact(particle, thrown, o); });
  Plane wall{Vector3::UnitZ(), not_given};
  wall.friction = thrown.friction;
  const bool slides = thrown.tangential_velocity != 0 || thrown.spin != 0;
  const Eigen::Matrix3d rotation = rotation_to_plane(unit(thrown.orientation, "--orientation"), thrown.turn);
  SpatialSetup setup(particle, rotation, {wall}, {!slides, true, false});
  if (options.fields) setup.draw();
  const Scales scale = setup.scale();
  if (!(thrown.velocity > 0 && thrown.velocity < 0.5 * scale.velocity()))
    fail("--velocity", "cannot be used", fmt::format("{:g} m/s", thrown.velocity),
         fmt::format("over 0, up to half the wave speed sqrt(E*/rho), {:.4g} m/s", 0.5 * scale.velocity()));
  if (!(thrown.friction >= 0 && thrown.friction <= 10))
    fail("--friction", "cannot be used", fmt::format("{:g}", thrown.friction), "0 to 10");
  const double v = thrown.velocity / scale.velocity();
  const Vector3 velocity(thrown.tangential_velocity / scale.velocity(), 0, -v);
  const Vector3 spin(0, thrown.spin * scale.time(), 0);
  const double deepest = setup.expected_overlap(v), duration = 2.0 * deepest / v + 2.5;
  const bool homogeneous = particle.layers.empty() && particle.inclusions.empty();

  return mean_of_shifted_grids(
      options, cells_of(options), scale, true,
      [&](int cells, double shift, const auto& fields, const auto& progress, const auto& checkpoint) {
        Simulation run(setup.build(deepest, cells, shift, options.precision), options, duration,
                       scale.stress);
        Body& body = run.scene.bodies.front();
        const Eigen::Matrix3d exact = setup.inertia();
        const ReboundMeter meter(run.scene, homogeneous ? &exact : nullptr);
        throw_body(body, velocity, spin, run.scene.centre);
        std::optional<LeavingPoint> point;
        if (thrown.first_contact_only)
          point = {setup.first_contact() - run.scene.centre, meter.inertia_at_rest().inverse()};
        Flight programme(duration, point);
        run.run(programme, {fields, scale, duration}, progress, checkpoint);
        RunSummary& s = run.result.summary;
        Rebound rebound;
        const Vector3 after = mean_velocity(body), w = meter.spin(run.scene);
        const int copies = body.reference().copies();
        const Vector3 impulse = copies * body.mass() * (after - velocity);
        rebound.normal = s.restitution_raw = after[2] / v;
        rebound.tangential = after[0] / velocity[0];
        rebound.spin = {w[0], w[1], w[2]};
        rebound.impulse_normal = impulse[2];
        rebound.impulse_tangential = slides ? -impulse[0] : 0.0;
        run.result.rebound = rebound;
        s.work_load = copies * run.energy_start;
        s.work_unload = meter.energy(run.scene);
        return std::move(run.result);
      });
}

namespace {

Plane plane_of(const PressPlane& p, const Scales& scale)
{
  Plane plane{-unit(p.direction, "--planes"), p.distance ? -*p.distance / scale.length : not_given};
  plane.start = plane.position;
  plane.velocity = p.speed;  // until the programme starts: planes of unlike speed are no mirror images
  plane.friction = p.friction;
  return plane;
}

}  // namespace

RunResult run_planes_press(const Particle& particle, const PressPlan& plan, const RunOptions& options)
{
  check(options);
  if (options.estimate_error)
    return run_with_estimate(options,
                             [&](const RunOptions& o) { return run_planes_press(particle, plan, o); });
  const Scales units{particle.radius, particle.materials.front().e_star(),
                     particle.materials.front().density};
  std::vector<Plane> planes;
  for (const PressPlane& p : plan.planes) planes.push_back(plane_of(p, units));
  if (planes.empty()) fail("--planes", "no plane is given");
  SpatialSetup setup(particle, Eigen::Matrix3d::Identity(), planes, {true, true, true});
  if (options.fields) setup.draw();
  const Scales scale = setup.scale();
  const double depth = plan.depth / scale.length;
  if (!(depth > 0 && depth <= 0.8))
    fail("--depth", "cannot be used", fmt::format("{:g} R", depth), "over 0, up to 0.8 R");
  Press::Plan stops{{depth}, 0, 0};
  stops.ramp = options.slowness *
               (plan.ramp > 0 ? plan.ramp : default_press_ramp(depth, setup.yield_stress() / scale.stress));
  stops.unload_ramp = 0.4 * stops.ramp;
  const double duration = stops.ramp + stops.unload_ramp;

  return mean_of_shifted_grids(
      options, cells_of(options), scale, false,
      [&](int cells, double shift, const auto& fields, const auto& progress, const auto& checkpoint) {
        Simulation run(setup.build(depth, cells, shift, options.precision), options, duration, scale.stress);
        for (Plane& plane : run.scene.planes->planes()) plane.velocity = 0;
        Press programme(stops, 1, std::make_unique<MovingPlanes>(setup.speeds()));
        run.run(programme, {fields, scale, duration}, progress, checkpoint);
        RunSummary& s = run.result.summary;
        const double copies = run.scene.bodies.front().reference().copies();
        s.work_load = copies * programme.work_load();
        s.work_unload = copies * programme.work_unload();
        s.restitution_raw = std::sqrt(std::max(0.0, s.work_unload / s.work_load));
        setup.give_mirrored_planes(run.result.planes);
        return std::move(run.result);
      });
}

double force_at_depth(const RunResult& press, std::size_t plane)
{
  double deepest = 0, sum = 0;
  int count = 0;
  for (const TraceSample& t : press.trace)
    if (t.branch == Branch::load) deepest = std::max(deepest, t.delta);
  for (std::size_t k = 0; k < press.trace.size(); ++k)
    if (press.trace[k].branch == Branch::load && press.trace[k].delta >= 0.99 * deepest) {
      sum += press.planes[plane].samples[k].force;
      ++count;
    }
  return count ? sum / count : 0;
}

std::vector<PressPlane> named_planes(const std::string& name)
{
  std::vector<PressPlane> planes;
  const auto add = [&](double x, double y, double z, double speed = 1) {
    const double length = std::sqrt(x * x + y * y + z * z);
    planes.push_back({{x / length, y / length, z / length}, {}, speed, 0});
  };
  if (name == "pair" || name == "cube" || name == "die")
    for (const double side : {1.0, -1.0}) add(0, 0, side);
  if (name == "cube" || name == "die")
    for (const double side : {1.0, -1.0}) {
      add(side, 0, 0, name == "die" ? 0 : 1);
      add(0, side, 0, name == "die" ? 0 : 1);
    }
  if (name == "bcc")
    for (int k = 0; k < 8; ++k) add(k & 4 ? -1 : 1, k & 2 ? -1 : 1, k & 1 ? -1 : 1);
  if (name == "fcc")
    for (int axis = 0; axis < 3; ++axis)
      for (const double a : {1.0, -1.0})
        for (const double b : {1.0, -1.0}) {
          std::array<double, 3> x{};
          x[(axis + 1) % 3] = a, x[(axis + 2) % 3] = b;
          add(x[0], x[1], x[2]);
        }
  return planes;
}

}  // namespace granulaw
