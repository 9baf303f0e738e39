// One axis of a sphere after the other pressed and unloaded, by the solver and by the law (docs/evidence/confined.md). Prints a
// CSV table: sequence, E*/Y, the ways of the three axes over R, and the forces over Y R^2 by both. About 5 CPU s a sequence.
//
//     granulaw_confined_sequences > TABLE
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "atlas/law_from_atlas.hpp"
#include "characterise/atlas_file.hpp"
#include "law/between_planes.hpp"
#include "solver/body/motion.hpp"
#include "solver/loading/programme.hpp"
#include "solver/run/simulation.hpp"
#include "solver/run/spatial_setup.hpp"

namespace granulaw {

namespace {

using Ways = std::array<double, 3>;  // of the planes across x, y and z, over R

/// Pairs of planes that move from one place to the next, smoothly; ends with the last.
class Sequence : public Programme
{
 public:
  Sequence(std::vector<Ways> places, double speed) : places_(std::move(places)), speed_(speed) {}
  double duration() const
  {
    double all = 0;
    for (std::size_t k = 0; k < places_.size(); ++k) all += duration(k);
    return all;
  }
  void lead(Scene& scene, double time, double dt) override
  {
    while (leg_ < places_.size() && time > begin_ + duration(leg_)) begin_ += duration(leg_++);
    for (Plane& p : scene.planes->planes()) {
      int axis = 0;
      for (int a = 1; a < 3; ++a)
        if (std::abs(p.normal[a]) > std::abs(p.normal[axis])) axis = a;
      p.velocity = leg_ < places_.size() ? way(leg_, axis) * speed(time + 0.5 * dt) : 0.0;
    }
  }
  void apply(Scene& scene, double time, double dt, bool) override
  {
    constexpr double damping = 0.1;  // c*/R, of all but the mean velocity: far below what changes a force
    for (Body& b : scene.bodies) damp_velocity(b, mean_velocity(b), damping * dt);
    now_ = time + dt;
  }
  bool finished() const override { return now_ >= duration(); }
  Branch branch() const override { return Branch::load; }
  int segment() const override { return 0; }
  double progress() const override { return now_ / duration(); }
  double overlap(const Scene&) const override { return now_; }
  void visit_state(StateArchive&) override {}

 private:
  double way(std::size_t leg, int axis) const { return places_[leg][axis] - (leg ? places_[leg - 1][axis] : 0.0); }
  double duration(std::size_t leg) const { return std::max({std::abs(way(leg, 0)), std::abs(way(leg, 1)), std::abs(way(leg, 2))}) / speed_; }
  /// Share of the leg's way a unit of time.
  double speed(double time) const
  {
    const double t = (time - begin_) / duration(leg_);
    return t > 0 && t < 1 ? 0.5 * M_PI * std::sin(M_PI * t) / duration(leg_) : 0.0;
  }

  std::vector<Ways> places_;
  double speed_, begin_ = 0, now_ = 0;
  std::size_t leg_ = 0;
};

struct Named
{
  const char* name;
  std::vector<Ways> places;
};

void compare(const Atlas& atlas, const Named& sequence, double stiffness)
{
  const double nu = 0.3, e_star = 1e8, radius = 1e-3, yield = e_star / stiffness;
  LawMaterial m{"m", 1000, e_star * (1 - nu * nu), nu, yield, 0};
  Particle particle;
  particle.radius = radius;
  particle.materials = {{m.density, m.youngs_modulus, nu, yield}};
  RunOptions options;
  options.grid = GridKind::spatial, options.resolution = 8, options.shifted_grids = 1, options.samples = 1500;
  std::vector<Plane> planes;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      Vector3 n = Vector3::Zero();
      n[axis] = side;
      planes.push_back(touching_plane(n));
      planes.back().velocity = 1;
    }
  const SpatialSetup setup(particle, Eigen::Matrix3d::Identity(), planes, {true, true, true}, options);
  constexpr double speed = 1e-3;  // c*, as `mpm press` has at its fastest
  Sequence programme(sequence.places, speed);
  double deepest = 0;
  for (const Ways& w : sequence.places) deepest = std::max({deepest, w[0], w[1], w[2]});
  Simulation run(setup.build(deepest, setup.cells(options, deepest), 0.0), options, programme.duration(), setup.scale().stress);
  run.run(programme, {{}, setup.scale(), programme.duration()}, {}, {});
  std::vector<PlaneTrace> traces = run.result.planes;
  setup.give_planes(traces);

  LawRange range;
  range.depth = Atlas::depth;
  const BodyLaw law = law_from(atlas, m, range);
  const PlasticBody body(law.curve, m.youngs_modulus, nu, {yield});
  std::vector<Vector> normals;
  for (const Plane& p : planes) normals.push_back({-p.normal[0], -p.normal[1], -p.normal[2]});
  BetweenPlanes sphere(body, normals, std::vector<double>(6, 0.0));
  std::vector<double> at(6, 0.0), ways(6);
  const double force = setup.scale().stress / yield;  // samples are the solver's: E* R^2
  for (std::size_t k = 0; k < run.result.trace.size(); ++k) {
    for (std::size_t i = 0; i < 6; ++i) ways[i] = traces[i].samples[k].delta - at[i], at[i] = traces[i].samples[k].delta;
    sphere.move(ways);
    if (k % 5 != 0) continue;
    fmt::print("{},{}", sequence.name, stiffness);
    for (std::size_t i = 0; i < 6; i += 2) fmt::print(",{:.5f}", at[i]);
    for (std::size_t i = 0; i < 6; i += 2) fmt::print(",{:.4f}", traces[i].samples[k].force * force);
    for (std::size_t i = 0; i < 6; i += 2) fmt::print(",{:.4f}", sphere.forces()[i]);
    fmt::print("\n");
  }
}

}  // namespace

}  // namespace granulaw

int main()
{
  using granulaw::Named;
  const std::vector<Named> sequences{
      {"x out y", {{0.12, 0, 0}, {0.08, 0, 0}, {0.08, 0.15, 0}, {0.08, 0.1, 0}}},
      {"x held y", {{0.12, 0, 0}, {0.12, 0.12, 0}, {0.12, 0.12, 0.12}, {0.12, 0.12, 0.08}}},
      {"cube x out and in", {{0.1, 0.1, 0.1}, {0.07, 0.1, 0.1}, {0.13, 0.1, 0.1}}},
      {"xy out z", {{0.1, 0.1, 0}, {0.07, 0.07, 0}, {0.07, 0.07, 0.2}}}};
  const granulaw::Atlas atlas = granulaw::read_atlas(GRANULAW_ATLAS_FILE);
  fmt::print("sequence,stiffness,way_x,way_y,way_z,solver_x,solver_y,solver_z,law_x,law_y,law_z\n");
  for (const Named& s : sequences)
    for (const double stiffness : {30.0, 100.0, 300.0}) granulaw::compare(atlas, s, stiffness);
}
