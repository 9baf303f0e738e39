#include "calibrate/sphere_laws.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/gauss.hpp"
#include "atlas/overlap_at_work.hpp"
#include "atlas/tabulate_curve.hpp"

namespace granulaw {

namespace {

MaterialRatios within(const Atlas& atlas, MaterialRatios m)
{
  const AtlasGrid& grid = atlas.grid();
  m.stiffness = std::clamp(m.stiffness, grid.stiffnesses.front(), grid.stiffnesses.back());
  m.hardening = std::clamp(m.hardening, grid.hardenings.front(), grid.hardenings.back());
  return m;
}

/// The linearly hardening material whose midplane departs from its free sphere as this one's does.
MaterialRatios ratios_of(const Atlas& atlas, const CandidateMaterial& m)
{
  const MaterialRatios ratios = within(atlas, MaterialRatios::of(m));
  const FlowCurve flow = flow_curve(m);
  return flow ? stand_in_at_equator(atlas, ratios.stiffness, ratios.poisson_ratio, flow) : ratios;
}

LawShape shape_of(const Atlas& atlas, const CandidateMaterial& m, const Departure* departure)
{
  const MaterialRatios ratios = within(atlas, MaterialRatios::of(m));
  const FlowCurve flow = flow_curve(m);
  if (!flow) return atlas.shape(ratios);
  LawShape shape = stand_in(atlas, ratios.stiffness, ratios.poisson_ratio, flow);
  if (departure) departure->add_to(shape);
  return shape;
}

constexpr double sphere_mass = 4.0 / 3.0 * M_PI;  // over rho R^3

}  // namespace

SphereLaws::SphereLaws(const Atlas& atlas, const MaterialRatios& material, LawShape shape)
    : material_(material),
      errors_(errors_of(atlas, material.stiffness)),
      atlas_(&atlas),
      energy_unit_(energy_unit(sphere_mass, 1 / material.stiffness)),
      shape_(std::move(shape)),
      free_(tabulate(shape_, Atlas::depth)),
      impacts_(shape_, free_, energy_unit_, AxisTable::By::inertia)
{
}

SphereLaws::SphereLaws(const Atlas& atlas, const MaterialRatios& m)
    : SphereLaws(atlas, within(atlas, m), atlas.shape(within(atlas, m)))
{
}

SphereLaws::SphereLaws(const Atlas& atlas, const CandidateMaterial& m, const Departure* departure)
    : SphereLaws(atlas, ratios_of(atlas, m), shape_of(atlas, m, departure))
{
}

SphereLaws::Impact SphereLaws::impact(double v) const
{
  v = std::clamp(v, 1e-9, fastest);
  const double x = std::min(impacts_.impact_overlap(v), free_.end());
  if (x <= onset()) return {1.0, x, 0.0, free_.loading(x).radius, contact_time(x, 0.0, 1.0)};
  const LawShape::VelocityEffect effect = impacts_.effect(v);
  const double slow = free_.kept(x);
  const double kept = free_.top(x).span * std::exp(-effect.residual);
  const double residual = x * std::clamp(1 - kept, 0.0, 0.9999);
  const double e = std::min(1.0, std::sqrt(slow * std::exp(-effect.dissipation)));
  return {e, x, residual, free_.radius(x), contact_time(x, residual, e)};
}

/// Loading by the slow press's work, brought to the impact's energy; unloading by the shape that gives e^2 of
/// it back.
double SphereLaws::contact_time(double x, double residual, double restitution) const
{
  // x' = x (1 - w^2), u = 1 - w^2: the integrands are smooth at the reversal
  const double all = free_.work(x);
  const double loading = gauss<7>(0.0, 1.0, [&](double w) {
    return 2 * w / std::sqrt(std::max(1e-12, 1 - free_.work(x * (1 - w * w)) / all));
  });
  const Reversal top = free_.reversal(x);
  UnloadingShape shape = top.shape();
  const double share = restitution * restitution * all / (top.top() * (x - residual));
  shape.exponent =
      std::clamp(UnloadingShape::exponent_of(share, shape.hertz_share), UnloadingShape::least_exponent,
                 UnloadingShape::largest_exponent(shape.hertz_share));
  const double unloading = gauss<7>(0.0, 1.0, [&](double w) {
    return 2 * w / std::sqrt(std::max(1e-12, 1 - shape.work(1 - w * w) / shape.work()));
  });
  return x * loading + (x - residual) / restitution * unloading;
}

const Curve& SphereLaws::midplane() const
{
  if (!midplane_) {
    if (atlas_->midplane().empty()) fail("atlas", "holds no midplane curves: make it anew (tools/atlas)");
    midplane_ = tabulate(atlas_->midplane().shape(material_, shape_), MidplaneShapes::depth);
  }
  return *midplane_;
}

void SphereLawsCache::set_departure(Departure departure)
{
  departure_ = std::move(departure);
  kept_.clear();
}

std::shared_ptr<const SphereLaws> SphereLawsCache::of(const CandidateMaterial& material)
{
  const MaterialRatios wanted = within(atlas_, MaterialRatios::of(material));
  Key key{wanted.stiffness, wanted.poisson_ratio};
  for (const Parameter p : parameters_of(material.hardening.name))
    key.push_back(p == Parameter::hardening_modulus
                      ? wanted.hardening
                      : value_of(material, p) / (is_stress(p) ? material.yield_stress : 1.0));
  const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const auto& k) { return k.first == key; });
  if (found != kept_.end()) {
    kept_.splice(kept_.begin(), kept_, found);
    return kept_.front().second;
  }
  kept_.emplace_front(std::move(key),
                      std::make_shared<const SphereLaws>(atlas_, material, departure_ ? &*departure_ : nullptr));
  if (kept_.size() > most) kept_.pop_back();
  return kept_.front().second;
}

}  // namespace granulaw
