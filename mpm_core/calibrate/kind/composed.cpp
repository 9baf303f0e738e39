#include "calibrate/kind/composed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibrate/sphere_laws.hpp"
#include "atlas/tabulate_curve.hpp"
#include "contact/pair.hpp"
#include "law/replay.hpp"

namespace granulaw {

namespace {

constexpr double spacing = 0.1;  // of the lattice's logarithms
/// Largest ratio of two partners' E*, either way, that laws are composed for: the stiffer one is rigid to
/// 0.01 % (docs/evidence/pairs.md).
constexpr double most_unlike = 1e4;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// A material brought into the atlas, its yield stress as it is.
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

/// A material with all its stresses brought to at most that ratio: a search tries what no solid has.
LawMaterial within_reach(LawMaterial m, const LawMaterial& partner)
{
  const double ratio = m.e_star() / partner.e_star(),
               factor = std::clamp(ratio, 1 / most_unlike, most_unlike) / ratio;
  m.youngs_modulus *= factor, m.yield_stress *= factor, m.hardening_modulus *= factor;
  return m;
}

/// Without an indenter's modulus the specimen's stresses count by their ratios only.
LawMaterial over_yield_stress(LawMaterial m)
{
  m.youngs_modulus /= m.yield_stress, m.hardening_modulus /= m.yield_stress, m.yield_stress = 1;
  return m;
}

}  // namespace

ComposedModel::ComposedModel(const Atlas& atlas, const Measurement& measured, std::vector<Parameter> varied)
    : atlas_(&atlas), measured_(&measured)
{
  const auto varies = [&](Parameter p) { return std::find(varied.begin(), varied.end(), p) != varied.end(); };
  const bool yield = varies(Parameter::yield_stress), by_ratios = !measured.counterpart;
  varies_ = {varies(Parameter::youngs_modulus) || (by_ratios && yield), yield && !by_ratios,
             varies(Parameter::hardening_modulus) || (by_ratios && yield)};
  if (measured.counterpart) PairBody(atlas, *measured.counterpart);
}

double ComposedModel::nearest(double modulus)
{
  return std::exp(spacing * std::round(std::log(modulus) / spacing));
}

template <class Use>
void ComposedModel::around(const LawMaterial& wanted, Use use) const
{
  const double place[] = {std::log(wanted.youngs_modulus), std::log(wanted.yield_stress),
                          std::log1p(2 * wanted.hardening_modulus / wanted.yield_stress)};
  Steps below{};
  double share[3] = {};
  constexpr double rounding = 1e-9;  // of a fraction, and of a weight
  for (std::size_t k = 0; k < 3; ++k) {
    if (!varies_[k]) continue;
    below[k] = static_cast<int>(std::floor(place[k] / spacing));
    share[k] = place[k] / spacing - below[k];
    if (share[k] > 1 - rounding) ++below[k], share[k] = 0;
  }
  for (unsigned corner = 0; corner < 8; ++corner) {
    Steps steps = below;
    double weight = 1;
    for (unsigned k = 0; k < 3; ++k) {
      const bool upper = (corner >> k) & 1;
      steps[k] += upper ? 1 : 0;
      weight *= upper ? share[k] : 1 - share[k];
    }
    if (weight < rounding) continue;
    auto node = nodes_.find(steps);
    if (node == nodes_.end()) {
      LawMaterial m = wanted;
      if (varies_[0]) m.youngs_modulus = std::exp(spacing * steps[0]);
      if (varies_[1]) m.yield_stress = std::exp(spacing * steps[1]);
      if (varies_[2]) m.hardening_modulus = 0.5 * m.yield_stress * std::expm1(spacing * steps[2]);
      node = nodes_.emplace(steps, compute(m)).first;
    }
    use(weight, node->second);
  }
}

LawMaterial ComposedModel::counterpart_on(const LawMaterial& fitted) const
{
  if (measured_->counterpart) return *measured_->counterpart;
  LawMaterial m;
  m.name = "rigid indenter";
  m.density = fitted.density, m.youngs_modulus = most_unlike * fitted.youngs_modulus, m.poisson_ratio = 0.3;
  return m;
}

ComposedModel::Node ComposedModel::compute(const LawMaterial& asked) const
{
  const LawMaterial fitted = within_atlas(*atlas_, asked);
  const PairBody own(*atlas_, fitted), other(*atlas_, counterpart_on(fitted));
  if (measured_->indenter_radius == 0) return {{}, 0, 0, changes(own, other)};
  LawRange options;
  options.depth = Atlas::depth, options.fastest = 0;
  const double ratio = std::isfinite(measured_->radius) ? measured_->indenter_radius / measured_->radius : 0;
  const ComposedShape composed = compose_shape(*atlas_, own, other, ratio, options);
  return {composed.shape, std::log(composed.body.onset), std::log(composed.end), {}};
}

std::vector<double> ComposedModel::changes(const PairBody& own, const PairBody& other) const
{
  constexpr const char *sphere_body = "sphere", *wall_body = "thick wall";
  constexpr int replay_steps = 1500;  // e to 2e-4 of that of 20000
  const LawMaterial& fitted = own.material();
  const PairBody &sphere = measured_->counterpart_is_ball ? other : own,
                 &wall = measured_->counterpart_is_ball ? own : other;
  const double radius = measured_->radius, density = sphere.material().density;
  const double per_speed = std::sqrt(measured_->sphere_density(density) / fitted.yield_stress);
  LawRange options;
  options.depth = Atlas::depth;
  options.fastest = std::clamp(1.2 * measured_->largest_x() * std::sqrt(density / fitted.yield_stress), 0.03, SphereLaws::fastest);
  options.tolerance = 0;  // laws with their velocity axis: one left out here and there would be a jump between candidates
  Law law;
  law.bodies[sphere_body].material = sphere.material();
  law.bodies[wall_body].material = wall.material();
  for (auto& [name, body] : law.bodies) body.material.name = name;
  law.pairs = {{sphere_body, wall_body}};
  law.pair_laws[std::string(sphere_body) + ":" + wall_body] = {
      yields_first(sphere.material(), wall.material()) ? compose_law(*atlas_, sphere, wall, infinite, options)
                                                       : compose_law(*atlas_, wall, sphere, 0.0, options)};
  const PairLaw pair = resolve_pair(law, sphere_body, wall_body, "wall", radius, infinite);
  const double mass = 4.0 / 3.0 * M_PI * density * radius * radius * radius;
  const SphereLaws rigid(*atlas_, MaterialRatios::of(fitted));
  std::vector<double> change;
  for (const Datum& d : measured_->data)
    change.push_back(replay_collision(pair, radius, mass, d.x, replay_steps, measured_->body).restitution -
                     rigid.impact(d.x * per_speed).restitution);
  return change;
}

std::vector<double> ComposedModel::change(const LawMaterial& fitted) const
{
  std::vector<double> sum(measured_->data.size(), 0.0);
  around(within_reach(within_atlas(*atlas_, fitted), *measured_->counterpart),
         [&](double weight, const Node& node) {
           for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * node.change[i];
         });
  return sum;
}

ComposedModel::IndenterLaw ComposedModel::make(const LawMaterial& specimen) const
{
  Node mean{LawShape::zero(), 0, 0, {}};
  around(measured_->counterpart ? specimen : over_yield_stress(specimen),
         [&](double weight, const Node& node) {
           mean.shape.add(weight, node.shape);
           mean.log_onset += weight * node.log_onset, mean.log_end += weight * node.log_end;
         });
  const double end = std::exp(mean.log_end);
  mean.shape.onset = std::exp(mean.log_onset), mean.shape.end = end;
  const PairMapping mapping =
      PairMapping::deformable_partner(specimen.e_star(), counterpart_on(specimen).e_star());
  const double r_eff = measured_->effective_radius();
  return {specimen, tabulate(mean.shape, end), mapping.length(r_eff), mapping.force(r_eff)};
}

const ComposedModel::IndenterLaw& ComposedModel::law(const LawMaterial& asked) const
{
  const LawMaterial specimen =
      measured_->counterpart ? within_reach(within_atlas(*atlas_, asked), *measured_->counterpart) : asked;
  constexpr std::size_t most = 32;
  const auto same = [&](const IndenterLaw& l) {
    return l.specimen.youngs_modulus == specimen.youngs_modulus &&
           l.specimen.yield_stress == specimen.yield_stress &&
           l.specimen.hardening_modulus == specimen.hardening_modulus;
  };
  if (const auto found = std::find_if(laws_.begin(), laws_.end(), same); found != laws_.end()) {
    laws_.splice(laws_.begin(), laws_, found);
  } else {
    laws_.push_front(make(specimen));
    if (laws_.size() > most) laws_.pop_back();
  }
  return laws_.front();
}

ComposedError ComposedModel::error(const LawMaterial& fitted) const
{
  constexpr double stated = 2;  // standard deviations: 95 % lie within
  const LawMaterial other = counterpart_on(fitted);
  const double ratio = other.e_star() / fitted.e_star();
  const bool fitted_yields = measured_->indenter_radius > 0 || yields_first(fitted, other);
  const ComposedError error = composed_error(fitted_yields ? ratio : 1 / ratio);
  return {error.force / stated, error.restitution / stated};
}

}  // namespace granulaw
