#include "identities.hpp"

#include <cmath>
#include <random>

#include "base/larger.hpp"
#include "solver/body/kernels.hpp"
#include "solver/grid/mapped_body.hpp"

namespace granulaw::verification {

Identities identities(int cells_across)
{
  const Moduli elastic{0.35, 0.76, 0.0, 0.0, false};
  const Body undeformed =
      mapped_body(MappedGrid::build(cells_across, 0.3, true), {elastic}, 0.05 * elastic.shear);
  Identities left{};

  Body b = undeformed;
  const double er = 0.01, ez = -0.02;
  for (int i = 0; i < b.nodes(); ++i)
    b.u_i(i, 0) = er * b.reference().place_i(i, 0), b.u_i(i, 1) = ez * b.reference().place_i(i, 1);
  kernels(b).points_to_grid(b);
  const double lr = std::log1p(er), lz = std::log1p(ez), trace = 2 * lr + lz;
  const double deviator2 = 2 * std::pow(lr - trace / 3, 2) + std::pow(lz - trace / 3, 2);
  const double energy = elastic.shear * deviator2 + 0.5 * elastic.bulk * trace * trace;
  for (int p = 0; p < b.points(); ++p)
    left.patch =
        larger(left.patch, std::abs(b.state.elastic_energy_p[p] / b.reference().volume_p[p] / energy - 1));

  b = undeformed;
  for (int i = 0; i < b.nodes(); ++i)
    b.u_i(i, 0) = -0.01 * b.reference().place_i(i, 0), b.u_i(i, 1) = -0.01 * b.reference().place_i(i, 1);
  kernels(b).points_to_grid(b);
  double inside = 0, outside = 0;
  for (int i = 0; i < b.nodes(); ++i) {
    double& largest = std::hypot(b.reference().place_i(i, 0), b.reference().place_i(i, 1) - 1) > 1 - 1e-9
                          ? outside
                          : inside;
    largest = larger(largest, std::abs(b.f_i(i, 1)));
    if (b.reference().place_i(i, 0) > 0)
      largest = larger(largest, std::abs(b.f_i(i, 0)));  // the axis carries hoop force
  }
  left.equilibrium = inside / outside;

  b = undeformed;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> jitter(-1e-4, 1e-4);
  for (int i = 0; i < b.nodes(); ++i)
    b.u_i(i, 0) = b.reference().place_i(i, 0) > 0 ? jitter(random) : 0, b.u_i(i, 1) = jitter(random);
  kernels(b).points_to_grid(b);
  double sum = 0, magnitudes = 0, mass = 0;
  for (int i = 0; i < b.nodes(); ++i)
    sum += b.f_i(i, 1), magnitudes += std::abs(b.f_i(i, 1)), mass += b.reference().mass_i[i];
  left.momentum = std::abs(sum) / magnitudes;
  left.mass = std::abs(mass / (4.0 / 3.0 * M_PI) - 1);
  return left;
}

}  // namespace granulaw::verification
