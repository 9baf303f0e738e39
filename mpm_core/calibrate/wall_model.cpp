#include "calibrate/wall_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "characterise/composed_law.hpp"
#include "law/replay.hpp"

namespace granulaw {

namespace {

constexpr const char *sphere_body = "sphere", *wall_body = "thick wall";
constexpr int replay_steps = 1500;  // e to 2e-4 of that of 20000

}  // namespace

WallModel::WallModel(const Atlas& atlas, const Measurement& drops, std::vector<Parameter> varied)
    : atlas_(&atlas),
      drops_(&drops),
      lattice_(std::move(varied)),
      known_(atlas, drops.ball ? *drops.ball : *drops.wall)
{
}

std::vector<double> WallModel::compute(const LawMaterial& asked) const
{
  LawMaterial varied = within_atlas(*atlas_, asked);
  const PairBody other(*atlas_, varied);
  const PairBody &sphere = drops_->ball ? known_ : other, &wall = drops_->ball ? other : known_;
  const bool sphere_yields = yields_first(sphere.material(), wall.material());
  const double radius = drops_->radius, infinite = std::numeric_limits<double>::infinity();
  const double density = sphere.material().density;
  double fastest = 0;
  for (const Datum& d : drops_->data) fastest = std::max(fastest, d.x);
  BuildOptions options;
  options.depth = Atlas::depth;
  options.fastest =
      std::clamp(1.2 * fastest * std::sqrt(density / varied.yield_stress), 0.03, SphereLaws::fastest);
  Law law;
  law.bodies[sphere_body].material = sphere.material();
  law.bodies[wall_body].material = wall.material();
  for (auto& [name, body] : law.bodies) body.material.name = name;
  law.pairs = {{sphere_body, wall_body}};
  law.pair_laws[std::string(sphere_body) + ":" + wall_body] = {
      sphere_yields ? compose_law(*atlas_, sphere, wall, infinite, options)
                    : compose_law(*atlas_, wall, sphere, 0.0, options)};
  const PairLaw pair = resolve_pair(law, sphere_body, wall_body, "wall", radius, infinite);
  const double mass = 4.0 / 3.0 * M_PI * density * radius * radius * radius;
  const SphereLaws rigid(*atlas_, MaterialRatios::of(varied));
  const double per_speed = std::sqrt(density / varied.yield_stress);
  std::vector<double> change;
  for (const Datum& d : drops_->data)
    change.push_back(replay_collision(pair, radius, mass, d.x, replay_steps).restitution -
                     rigid.impact(d.x * per_speed).restitution);
  return change;
}

const std::vector<double>& WallModel::at(const MaterialLattice::Corner& corner) const
{
  const auto [entry, is_new] = changes_.try_emplace(corner.key);
  if (is_new) entry->second = compute(corner.material);
  return entry->second;
}

std::vector<double> WallModel::change(const LawMaterial& varied) const
{
  std::vector<double> sum(drops_->data.size(), 0.0);
  for (const MaterialLattice::Corner& corner :
       lattice_.around(within_reach(within_atlas(*atlas_, varied), known_.material()))) {
    const std::vector<double>& here = at(corner);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += corner.weight * here[i];
  }
  return sum;
}

double WallModel::error(const LawMaterial& varied) const
{
  const bool first = yields_first(varied, known_.material());
  const double ratio = known_.material().e_star() / varied.e_star();
  return 0.5 * composed_error(first ? ratio : 1 / ratio).restitution;  // stated: what 95 % lie within
}

}  // namespace granulaw
