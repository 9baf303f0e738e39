#include "calibrate/wall_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "characterise/composed_law.hpp"
#include "law/replay.hpp"

namespace granulaw {

namespace {

constexpr const char* wall_body = "thick wall";
constexpr int replay_steps = 1500;  // e to 2e-4 of that of 20000

}  // namespace

WallModel::WallModel(const Atlas& atlas, const Measurement& drops, std::vector<Parameter> varied)
    : atlas_(&atlas), drops_(&drops), lattice_(std::move(varied)), wall_(atlas, *drops.wall)
{
}

std::vector<double> WallModel::compute(const LawMaterial& asked) const
{
  LawMaterial sphere = within_atlas(*atlas_, asked);
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

const std::vector<double>& WallModel::at(const MaterialLattice::Corner& corner) const
{
  const auto [entry, is_new] = known_.try_emplace(corner.key);
  if (is_new) entry->second = compute(corner.material);
  return entry->second;
}

std::vector<double> WallModel::change(const LawMaterial& sphere) const
{
  std::vector<double> sum(drops_->data.size(), 0.0);
  for (const MaterialLattice::Corner& corner : lattice_.around(sphere)) {
    const std::vector<double>& here = at(corner);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += corner.weight * here[i];
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
