#include "energy_audit.hpp"

#include <array>
#include <cmath>

#include "solver/runs.hpp"

namespace granulaw::verification {

namespace {

/// Volumes of the rings that the cells sweep, and the nodes' shares in them (integrals of the bilinear shape
/// functions), by 2 x 2 Gauss points: exact for straight-sided cells.
struct Volumes
{
  std::vector<double> cell, node;
};

Volumes volumes(const FieldFrame& undeformed, const std::vector<std::array<int, 4>>& cells)
{
  Volumes v{std::vector<double>(cells.size()), std::vector<double>(undeformed.r.size())};
  constexpr double sign_x[] = {-1, 1, 1, -1}, sign_y[] = {-1, -1, 1, 1};
  const double g = 1 / std::sqrt(3.0);
  for (std::size_t p = 0; p < cells.size(); ++p)
    for (const double x : {-g, g})
      for (const double y : {-g, g}) {
        double n[4], r = 0, rx = 0, ry = 0, zx = 0, zy = 0;
        for (int k = 0; k < 4; ++k) {
          const double rk = undeformed.r[cells[p][k]], zk = undeformed.z[cells[p][k]];
          const double fx = 1 + x * sign_x[k], fy = 1 + y * sign_y[k];
          n[k] = 0.25 * fx * fy;
          r += n[k] * rk;
          rx += 0.25 * sign_x[k] * fy * rk, ry += 0.25 * sign_y[k] * fx * rk;
          zx += 0.25 * sign_x[k] * fy * zk, zy += 0.25 * sign_y[k] * fx * zk;
        }
        const double volume = 2 * M_PI * r * (rx * zy - ry * zx);
        v.cell[p] += volume;
        for (int k = 0; k < 4; ++k) v.node[cells[p][k]] += n[k] * volume;
      }
  return v;
}

/// J of ln J = -p J/K: fixed-point steps contract by p/K.
double jacobian(double pressure_over_bulk)
{
  double j = 1;
  for (int k = 0; k < 30; ++k) j = std::exp(-pressure_over_bulk * j);
  return j;
}

}  // namespace

std::vector<EnergyShares> energy_audit(const Particle& sphere, double velocity, int cells_across, int frames)
{
  const Material& m = sphere.materials[0];
  const double shear = m.youngs_modulus / (2 * (1 + m.poisson_ratio));
  const double bulk = m.youngs_modulus / (3 * (1 - 2 * m.poisson_ratio));
  const double mass = 4.0 / 3.0 * M_PI, whole = 0.5 * mass * velocity * velocity;

  std::vector<EnergyShares> shares;
  std::vector<std::array<int, 4>> cells;
  Volumes v;
  std::vector<double> strain_before;
  double meshed = 0, plastic = 0;
  RunOptions options;
  options.resolution = cells_across;
  options.shifted_grids = 1;
  options.fields.frames = frames;
  options.fields.begin = [&](int, const auto& c) { cells = c; };
  options.fields.frame = [&](const FieldFrame& f) {
    if (shares.empty()) {
      v = volumes(f, cells);
      for (const double x : v.cell) meshed += x;
      strain_before = f.plastic_strain;
    }
    double kinetic = 0, elastic = 0;
    // the chords of the surface cells cut a little volume off: the solver keeps the sphere's mass exact
    for (std::size_t i = 0; i < f.vr.size(); ++i)
      kinetic += 0.5 * v.node[i] * mass / meshed * (f.vr[i] * f.vr[i] + f.vz[i] * f.vz[i]);
    for (std::size_t p = 0; p < cells.size(); ++p) {
      const double j = jacobian(f.pressure[p] / bulk);
      const double q = j * f.von_mises[p], pressure = j * f.pressure[p];
      elastic += v.cell[p] * (q * q / (6 * shear) + pressure * pressure / (2 * bulk));
      if (m.yields()) plastic += v.cell[p] * j * m.yield_stress * (f.plastic_strain[p] - strain_before[p]);
    }
    strain_before = f.plastic_strain;
    shares.push_back({f.time, kinetic / whole, elastic / whole, plastic / whole});
  };
  impact(sphere, {velocity}, {}, options);
  return shares;
}

double impulse(const std::vector<TraceSample>& trace)
{
  double sum = 0, start = 0;
  for (const TraceSample& t : trace) {
    const double length = 2 * (t.time - start);
    sum += t.force * length;
    start += length;
  }
  return sum;
}

}  // namespace granulaw::verification
