#include "calibrate/material_lattice.hpp"

#include <algorithm>
#include <cmath>

#include "characterise/atlas.hpp"

namespace granulaw {

namespace {

constexpr double spacing = 0.1;  // of the logarithms

double hardening_log(const LawMaterial& m)
{
  return std::log1p(2 * m.hardening_modulus / m.yield_stress);
}

}  // namespace

LawMaterial within_atlas(const Atlas& atlas, LawMaterial m)
{
  const AtlasGrid& grid = atlas.grid();
  const double softening = 1 - m.poisson_ratio * m.poisson_ratio;
  const double stiffness =
      std::clamp(m.e_star() / m.yield_stress, grid.stiffnesses.front(), grid.stiffnesses.back());
  m.youngs_modulus = stiffness * m.yield_stress * softening;
  m.hardening_modulus = std::clamp(m.hardening_modulus, 0.0, grid.hardenings.back() * m.youngs_modulus);
  return m;
}

LawMaterial within_reach(LawMaterial m, const LawMaterial& partner)
{
  const double ratio = m.e_star() / partner.e_star(),
               factor = std::clamp(ratio, 1 / most_unlike, most_unlike) / ratio;
  m.youngs_modulus *= factor, m.yield_stress *= factor, m.hardening_modulus *= factor;
  return m;
}

double MaterialLattice::nearest(double modulus)
{
  return std::exp(spacing * std::round(std::log(modulus) / spacing));
}

bool MaterialLattice::varies(Parameter parameter) const
{
  return std::find(varied_.begin(), varied_.end(), parameter) != varied_.end();
}

std::vector<MaterialLattice::Corner> MaterialLattice::around(const LawMaterial& wanted) const
{
  const double place[3] = {std::log(wanted.youngs_modulus) / spacing, std::log(wanted.yield_stress) / spacing,
                           hardening_log(wanted) / spacing};
  int below[3];
  double share[3];
  for (std::size_t k = 0; k < 3; ++k) {
    const bool is_varied = varies(all_parameters[k]);
    below[k] = is_varied ? static_cast<int>(std::floor(place[k])) : 0;
    share[k] = is_varied ? place[k] - below[k] : 0;
    constexpr double rounding = 1e-9;
    if (share[k] > 1 - rounding) ++below[k], share[k] = 0;
  }
  constexpr double negligible = 1e-9;  // of a weight: rounding
  std::vector<Corner> corners;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Corner c{{}, 1, wanted};
    for (unsigned k = 0; k < 3; ++k) {
      const bool upper = (corner >> k) & 1;
      c.key.steps[k] = below[k] + (upper ? 1 : 0);
      c.weight *= upper ? share[k] : 1 - share[k];
    }
    if (c.weight < negligible) continue;
    const auto& steps = c.key.steps;
    if (varies(Parameter::youngs_modulus)) c.material.youngs_modulus = std::exp(spacing * steps[0]);
    if (varies(Parameter::yield_stress)) c.material.yield_stress = std::exp(spacing * steps[1]);
    if (varies(Parameter::hardening_modulus))
      c.material.hardening_modulus = 0.5 * c.material.yield_stress * std::expm1(spacing * steps[2]);
    corners.push_back(c);
  }
  return corners;
}

}  // namespace granulaw
