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
#include "solver/run/spatial_setup.hpp"

namespace {

using namespace granulaw;

Particle sphere(const std::string& material)
{
  Material m;
  m.density = 1, m.poisson_ratio = 0.3, m.youngs_modulus = 0.91;
  if (material != "elastic") m.yield_stress = 0.01;
  if (material == "voce") m.hardening = {"voce", {{"saturation_stress", {0.02}}, {"strain", {0.1}}}};
  return Particle::sphere(1, m);
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

/// Squeezed under the contact: along z by `size` times a fraction that falls with the depth.
double rate_of_body(Body body, InstructionSet set, double pole)
{
  const Kernels& k = kernels(body, set);
  const NodeField& place = body.reference().place_i;
  const int last = place.components - 1;
  NodeField squeezed[2] = {body.u_i, body.u_i};
  for (int phase : {0, 1})
    for (int i = 0; i < body.nodes(); ++i) {
      const double height = place(i, last) - pole, way = (phase ? 0.01 : 0.012) * std::max(0.0, 1 - height);
      for (int c = 0; c < last; ++c) squeezed[phase](i, c) = way * place(i, c);
      squeezed[phase](i, last) = -way * height;
    }
  int phase = 0;
  return rate_of(body.reference().filled, [&] {
    const NodeField& u = squeezed[++phase % 2];
    std::copy(u.values.begin(), u.values.end(), body.u_i.values.begin());
    k.points_to_grid(body);
  });
}

Body flat_body(GridKind grid, const std::string& material, Precision precision)
{
  RunOptions options;
  options.grid = grid, options.precision = precision;
  return std::move(
      Collision(sphere(material), {}, options, Support::free).build(0.05, 20, 0.0).bodies.front());
}

Body spatial_body(const std::string& material, Precision precision)
{
  Plane wall{Vector3::UnitZ(), std::nan("")};
  RunOptions options;
  options.precision = precision;
  const SpatialSetup setup(sphere(material), Eigen::Matrix3d::Identity(), {wall}, {true, true, false},
                           options);
  return std::move(setup.build(0.05, 8, 0.0).bodies.front());
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
  std::vector<InstructionSet> sets{InstructionSet::generic};
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (avx2) sets.push_back(InstructionSet::avx2);
  if (avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    sets.push_back(InstructionSet::avx512);
  for (const InstructionSet set : sets)
    for (const char* grid : {"mapped", "rectilinear", "spatial"})
      for (const char* material : {"elastic", "perfect", "voce"})
        for (const bool single : {false, true}) {
          const std::string name =
              std::string(name_of(set)) + " " + grid + " " + material + (single ? " single" : " double");
          if (!wanted(name, count, words)) continue;
          const Precision precision = single ? Precision::single : Precision::full;
          const bool spatial = grid == std::string("spatial");
          const GridKind kind = grid == std::string("mapped") ? GridKind::mapped : GridKind::rectilinear;
          const double rate = spatial ? rate_of_body(spatial_body(material, precision), set, -1)
                                      : rate_of_body(flat_body(kind, material, precision), set, 0);
          std::printf("%-36s %7.2f M/s\n", name.c_str(), rate / 1e6);
          std::fflush(stdout);
        }
}
