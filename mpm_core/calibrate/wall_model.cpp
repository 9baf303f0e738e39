#include "calibrate/wall_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "characterise/composed_law.hpp"
#include "law/replay.hpp"

namespace granulaw {

namespace {

constexpr double spacing = 0.1;  // of the logarithms
constexpr const char* wall_body = "thick wall";
constexpr int replay_steps = 1500;  // e to 2e-4 of that of 20000

double hardening_log(const LawMaterial& m)
{
  return std::log1p(2 * m.hardening_modulus / m.yield_stress);
}

/// The sphere brought into the atlas, its yield stress as it is.
LawMaterial within(const Atlas& atlas, LawMaterial m)
{
  const AtlasGrid& grid = atlas.grid();
  const double softening = 1 - m.poisson_ratio * m.poisson_ratio;
  const double stiffness =
      std::clamp(m.e_star() / m.yield_stress, grid.stiffnesses.front(), grid.stiffnesses.back());
  m.youngs_modulus = stiffness * m.yield_stress * softening;
  m.hardening_modulus = std::clamp(m.hardening_modulus, 0.0, grid.hardenings.back() * m.youngs_modulus);
  return m;
}

}  // namespace

WallModel::WallModel(const Atlas& atlas, const Measurement& drops, std::vector<Parameter> varied)
    : atlas_(&atlas), drops_(&drops), varied_(std::move(varied)), wall_(atlas, *drops.wall)
{
}

std::vector<double> WallModel::compute(const LawMaterial& asked) const
{
  LawMaterial sphere = within(*atlas_, asked);
  sphere.name = "sphere";
  const PairBody body(*atlas_, sphere);
  const bool sphere_yields = yields_first(sphere, wall_.material());
  const double radius = drops_->radius, infinite = std::numeric_limits<double>::infinity();
  const double speed_unit = std::sqrt(sphere.density / sphere.yield_stress);
  double fastest = 0;
  for (const Datum& d : drops_->data) fastest = std::max(fastest, d.x);
  BuildOptions options;
  options.depth = Atlas::depth;
  options.fastest = std::clamp(1.2 * fastest * speed_unit, 0.03, SphereLaws::fastest);
  Law law;
  law.bodies[sphere.name].material = sphere;
  law.bodies[wall_body].material = wall_.material();
  law.bodies[wall_body].material.name = wall_body;
  law.pairs = {{sphere.name, wall_body}};
  law.pair_laws[sphere.name + ":" + wall_body] = {sphere_yields
                                                      ? compose_law(*atlas_, body, wall_, infinite, options)
                                                      : compose_law(*atlas_, wall_, body, 0.0, options)};
  const PairLaw pair = resolve_pair(law, sphere.name, wall_body, "wall", radius, infinite);
  const double mass = 4.0 / 3.0 * M_PI * sphere.density * radius * radius * radius;
  const SphereLaws rigid(*atlas_, MaterialRatios::of(sphere));
  std::vector<double> change;
  for (const Datum& d : drops_->data)
    change.push_back(replay_collision(pair, radius, mass, d.x, replay_steps).restitution -
                     rigid.impact(d.x * speed_unit).restitution);
  return change;
}

const std::vector<double>& WallModel::at(const Key& key, const LawMaterial& sphere) const
{
  const auto [entry, is_new] = known_.try_emplace(key);
  if (!is_new) return entry->second;
  LawMaterial m = sphere;
  const auto varies = [&](Parameter p) {
    return std::find(varied_.begin(), varied_.end(), p) != varied_.end();
  };
  if (varies(Parameter::youngs_modulus)) m.youngs_modulus = std::exp(spacing * key.modulus);
  if (varies(Parameter::yield_stress)) m.yield_stress = std::exp(spacing * key.yield);
  if (varies(Parameter::hardening_modulus))
    m.hardening_modulus = 0.5 * m.yield_stress * std::expm1(spacing * key.hardening);
  return entry->second = compute(m);
}

std::vector<double> WallModel::change(const LawMaterial& sphere) const
{
  const double place[3] = {std::log(sphere.youngs_modulus) / spacing, std::log(sphere.yield_stress) / spacing,
                           hardening_log(sphere) / spacing};
  int below[3];
  double share[3];
  for (int k = 0; k < 3; ++k) {
    const bool varies = std::find(varied_.begin(), varied_.end(),
                                  all_parameters[static_cast<std::size_t>(k)]) != varied_.end();
    below[k] = varies ? static_cast<int>(std::floor(place[k])) : 0;
    share[k] = varies ? place[k] - below[k] : 0;
  }
  std::vector<double> sum(drops_->data.size(), 0.0);
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    int key[3];
    for (int k = 0; k < 3; ++k) {
      const bool upper = (corner >> k) & 1;
      key[k] = below[k] + (upper ? 1 : 0);
      weight *= upper ? share[k] : 1 - share[k];
    }
    if (weight < 1e-9) continue;
    const std::vector<double>& here = at({key[0], key[1], key[2]}, sphere);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * here[i];
  }
  return sum;
}

double WallModel::error(const LawMaterial& sphere) const
{
  const bool first = yields_first(sphere, wall_.material());
  const double ratio =
      first ? wall_.material().e_star() / sphere.e_star() : sphere.e_star() / wall_.material().e_star();
  return 0.5 * composed_error(ratio).restitution;  // stated: what 95 % lie within
}

}  // namespace granulaw
