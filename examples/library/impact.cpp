// One impact from C++: the force law of a contact by the material point method.
//
//     m dv/dt = F,   F = sum of the impulses that keep the body from passing the wall, over the step
//
//          ___
//        /     \  | v          a sphere of radius R, or an ellipsoid that hits off its axis
//        \     /  |
//          \_/    V
//     ----------------  wall, rigid
//
// Commands (the tests run them: tests/verification/CMakeLists.txt):
//
//     example_impact                          a sphere of 1 mm at 1 m/s, in two dimensions
//     example_impact --speed 3                faster: more of the energy stays in the material
//     example_impact --grid                   the sphere on the grid of three dimensions
//     example_impact --oblique                the same with friction and a tangential velocity
//     example_impact --frictional             a granule that yields by Drucker and Prager
//
// Read next: tests/install/consumer/make_law.cpp, which makes a contact law of many such runs.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "base/error.hpp"
#include "solver/runs.hpp"

namespace {

using namespace granulaw;

struct Options
{
  double speed = 1;
  bool grid = false, oblique = false, frictional = false;
};

Options read(int count, char** words)
{
  Options o;
  for (int k = 1; k < count; ++k) {
    if (!std::strcmp(words[k], "--speed") && k + 1 < count)
      o.speed = std::atof(words[++k]);
    else if (!std::strcmp(words[k], "--grid"))
      o.grid = true;
    else if (!std::strcmp(words[k], "--oblique"))
      o.oblique = true;
    else if (!std::strcmp(words[k], "--frictional"))
      o.frictional = true;
    else
      fail("example_impact", "unknown option", words[k], "--speed V, --grid, --oblique, --frictional");
  }
  std::printf("speed %g m/s, %s, %s, %s\n", o.speed, o.grid ? "three dimensions" : "grid as the bodies need",
              o.oblique ? "oblique" : "head-on", o.frictional ? "Drucker-Prager" : "von Mises");
  return o;
}

int run(const Options& o)
{
  // 1. The material, SI: density, Young's modulus, Poisson's ratio, yield stress.
  Material powder{1500, 10e9, 0.3, 100e6};
  if (o.frictional)
    powder.yield_surface = {"drucker-prager", {{"friction_angle", {30}}, {"dilatancy_angle", {10}}}};

  // 2. The particle: a sphere of R = 1 mm.
  const Particle sphere = Particle::sphere(1e-3, powder);

  // 3. How it comes in.
  Approach approach{o.speed};
  if (o.oblique) approach.tangential_velocity = o.speed, approach.friction = 0.3;

  // 4. The grid: eight cells across the contact, one grid; a user takes the defaults.
  RunOptions options;
  options.resolution = 8, options.shifted_grids = 1;
  if (o.grid) options.grid = GridKind::spatial;

  // 5. The impact.
  const RunResult result = impact(sphere, approach, {}, options);

  // 6. Force over overlap, and the balance of energy.
  for (std::size_t k = 0; k < result.trace.size(); k += result.trace.size() / 8 + 1)
    std::printf("t %9.3g s   overlap %9.3g m   force %9.3g N\n", result.trace[k].time, result.trace[k].delta,
                result.trace[k].force);
  const RunSummary& s = result.summary;
  std::printf("e %.4f   largest force %.4g N   overlap %.4g m   contact time %.3g s\n", s.restitution,
              s.force_max, s.delta_max, s.contact_time);
  std::printf("energy put in %.4g J, given back %.4g J, balance open by %.1e of it, %.1f M point updates/s\n",
              s.work_load, s.work_unload, s.energy_error, s.point_updates_per_s / 1e6);
  if (o.oblique)
    std::printf("tangential velocity kept %.4f, spin after %.4g rad/s\n", result.rebound->tangential,
                result.rebound->spin[1]);
  return s.restitution > 0 && s.restitution < 1 && s.energy_error < 1e-2 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int count, char** words)
{
  try {
    return run(read(count, words));
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return EXIT_FAILURE;
  }
}
