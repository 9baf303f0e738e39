// Force evaluations of the kernels by themselves, M point updates a second on one core, of each instruction
// set that this processor has: three grids, three materials, two precisions.
//
//   kernel_benchmark                 all cases
//   kernel_benchmark spatial voce    those whose names hold all of these words
//
// The best of several rounds is printed, each over a quarter of a CPU second; a body is moved between two
// deformations so that a part of its points flows in every evaluation.
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "base/larger.hpp"
#include "solver/body/kernels.hpp"
#include "solver/run/axisymmetric_setup.hpp"
#include "solver/body/spatial_kernels.hpp"
#include "solver/run/spatial_setup.hpp"

namespace {

using namespace granulaw;

Particle sphere(const std::string& material)
{
  Material m;
  m.density = 1, m.poisson_ratio = 0.3, m.youngs_modulus = 0.91;
  if (material != "elastic") m.yield_stress = 0.01;
  if (material == "voce") m.hardening = {"voce", {{"saturation_stress", {0.02}}, {"strain", {0.1}}}};
  return Particle::from({1, m});
}

double cpu_seconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Updates a second: `step` makes `points` of them.
template <class Step>
double rate_of(long points, Step step)
{
  double best = 0;
  for (int round = 0; round < 5; ++round) {
    const double start = cpu_seconds();
    double seconds = 0;
    long done = 0;
    for (; seconds < 0.25; seconds = cpu_seconds() - start) step(), done += points;
    best = larger(best, static_cast<double>(done) / seconds);
  }
  return best;
}

double rate_of_flat(const Kernels& kernels, GridKind grid, const std::string& material, Precision precision)
{
  RunOptions options;
  options.grid = grid, options.precision = precision;
  const Collision collision(sphere(material), {}, options, Support::free);
  Body body = std::move(collision.build(0.05, 20, 0.0).bodies.front());
  int phase = 0;
  return rate_of(body.points, [&] {
    const double size = ++phase % 2 ? 0.01 : 0.012;
    for (int i = 0; i < body.nodes; ++i) {
      body.ur_i[i] = size * body.r_i[i] * std::max(0.0, 1 - body.z_i[i]);
      body.uz_i[i] = -size * body.z_i[i] * std::max(0.0, 1 - body.z_i[i]);
    }
    kernels.internal_force(body, false);
  });
}

double rate_of_spatial(const SpatialKernels& kernels, const std::string& material, Precision precision)
{
  Plane wall{Vector3::UnitZ(), std::nan("")};
  const SpatialSetup setup(sphere(material), Eigen::Matrix3d::Identity(), {wall}, {true, true, false});
  SpatialScene scene = setup.build(0.05, 8, 0.0, precision);
  SpatialBody& body = scene.bodies.front();
  std::vector<Vector3> place;
  for (int i = 0; i < body.nodes; ++i) place.push_back(reference_place(body, i));
  int phase = 0;
  return rate_of(body.points, [&] {
    const double size = ++phase % 2 ? 0.01 : 0.012;
    for (int i = 0; i < body.nodes; ++i) {
      const double way = size * std::max(0.0, -place[i][2]);
      body.u_i[4 * i] = way * place[i][0], body.u_i[4 * i + 1] = way * place[i][1];
      body.u_i[4 * i + 2] = -way * (1 + place[i][2]);
    }
    kernels.internal_force(body, false);
  });
}

bool wanted(const std::string& name, int count, char** words)
{
  for (int k = 1; k < count; ++k)
    if (name.find(words[k]) == std::string::npos) return false;
  return true;
}

}  // namespace

int main(int count, char** words)
{
  struct Set
  {
    const Kernels* flat;
    const SpatialKernels* spatial;
  };
  std::vector<Set> sets{{&isa_generic::kernels, &isa_generic::spatial_kernels}};
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (avx2) sets.push_back({&isa_avx2::kernels, &isa_avx2::spatial_kernels});
  if (avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    sets.push_back({&isa_avx512::kernels, &isa_avx512::spatial_kernels});
  for (const Set& set : sets)
    for (const char* grid : {"mapped", "rectilinear", "spatial"})
      for (const char* material : {"elastic", "perfect", "voce"})
        for (const bool single : {false, true}) {
          const std::string name =
              std::string(set.flat->name) + " " + grid + " " + material + (single ? " single" : " double");
          if (!wanted(name, count, words)) continue;
          const Precision precision = single ? Precision::single : Precision::full;
          const double rate =
              grid == std::string("spatial")
                  ? rate_of_spatial(*set.spatial, material, precision)
                  : rate_of_flat(*set.flat,
                                 grid == std::string("mapped") ? GridKind::mapped : GridKind::rectilinear,
                                 material, precision);
          std::printf("%-36s %7.2f M/s\n", name.c_str(), rate / 1e6);
          std::fflush(stdout);
        }
}
