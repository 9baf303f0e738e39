#include "calibrate/flow_shape.hpp"

#include <algorithm>
#include <cmath>

#include "base/scales.hpp"
#include "atlas/interpolation.hpp"
#include "solver/material/law_table.hpp"

namespace granulaw {

namespace {

/// Shapes of one stiffness, between whose hardenings is interpolated.
class Ladder
{
 public:
  /// From one coordinate to another (hardening_coordinate).
  Ladder(const Atlas& atlas, double stiffness, double poisson_ratio, double first, double last)
  {
    constexpr double spacing = 0.25;
    const int steps = 1 + static_cast<int>(std::ceil((last - first) / spacing));
    for (int k = 0; k < steps; ++k) {
      const double z = steps > 1 ? first + (last - first) * k / (steps - 1) : first;
      places_.push_back(z);
      shapes_.push_back(atlas.shape({stiffness, poisson_ratio, std::expm1(z) / (2 * stiffness)}));
    }
  }
  const LawShape& front() const { return shapes_.front(); }
  /// The mean of some value of the shapes at a coordinate.
  template <class Of>
  double at(double coordinate, const Of& of) const
  {
    const std::vector<double> weights = interpolation_weights(places_, coordinate);
    double sum = 0;
    for (std::size_t k = 0; k < shapes_.size(); ++k)
      if (weights[k] != 0) sum += weights[k] * of(shapes_[k]);
    return sum;
  }

 private:
  std::vector<double> places_;
  std::vector<LawShape> shapes_;
};

/// H/E of the linear hardening that shows the same flow stress where the contact has grown by this, over R.
double secant_hardening(double stiffness, double poisson_ratio, const FlowCurve& flow, double grown)
{
  constexpr double least = 1e-6;  // where the secant is taken at the onset
  const double strain = std::max(least, representative_strain * grown);
  // H/E = (sigma - Y)/(strain E), E/Y = stiffness (1 - nu^2)
  return (flow(strain) - 1) / (strain * stiffness * (1 - poisson_ratio * poisson_ratio));
}

}  // namespace

FlowCurve flow_curve(const CandidateMaterial& material)
{
  return [solid = solver_material(material)](double strain) {
    return flow_stress(solid, strain) / solid.yield_stress;
  };
}

LawShape flow_shape(const Atlas& atlas, double stiffness, double poisson_ratio, const FlowCurve& flow)
{
  const double onset = onset_overlap(stiffness, 1.0, poisson_ratio), hardest = atlas.grid().hardenings.back();
  const LawShape plain = atlas.shape({stiffness, poisson_ratio, 0});
  const auto coordinate = [&](double overlap, double widening) {
    const double grown = std::sqrt(overlap) * std::exp(widening) - std::sqrt(onset);
    const double hardening = secant_hardening(stiffness, poisson_ratio, flow, grown);
    return hardening_coordinate(stiffness, std::clamp(hardening, 0.0, hardest));
  };
  std::vector<double> places;
  const double range = std::log(Atlas::depth / onset);
  for (std::size_t k = 0; k < LawShape::nodes; ++k)
    places.push_back(coordinate(onset * std::exp(range * static_cast<double>(k) / (LawShape::nodes - 1)),
                                plain.widening[k]));
  const Ladder ladder(atlas, stiffness, poisson_ratio, *std::min_element(places.begin(), places.end()),
                      *std::max_element(places.begin(), places.end()));
  LawShape shape = ladder.front();
  for (const auto member : LawShape::functions)
    for (std::size_t k = 0; k < LawShape::nodes; ++k)
      (shape.*member)[k] = ladder.at(places[k], [&](const LawShape& s) { return (s.*member)[k]; });
  for (std::size_t k = 0; k < shape.velocity_effects.size(); ++k) {
    LawShape::VelocityEffect& effect = shape.velocity_effects[k];
    const double overlap = std::clamp(effect.speed * std::exp(effect.log_overlap), onset, Atlas::depth);
    const auto node =
        static_cast<std::size_t>(std::lround(std::log(overlap / onset) / range * (LawShape::nodes - 1)));
    const auto mean = [&](const auto& of) {
      return ladder.at(places[node], [&](const LawShape& s) { return of(s.velocity_effects[k]); });
    };
    using Effect = LawShape::VelocityEffect;
    effect.log_overlap = mean([](const Effect& e) { return e.log_overlap; });
    effect.dissipation = mean([](const Effect& e) { return e.dissipation; });
    effect.residual = mean([](const Effect& e) { return e.residual; });
    for (std::size_t i = 0; i < effect.force.size(); ++i)
      effect.force[i] = mean([i](const Effect& e) { return e.force[i]; });
  }
  return shape;
}

LawShape departure(const Curve& own, const Curve& stand_in)
{
  LawShape d = LawShape::zero();
  const double onset = stand_in.onset(), range = std::log(Atlas::depth / onset);
  const double end = std::min(own.end(), stand_in.end());
  for (std::size_t k = 1; k < LawShape::nodes; ++k) {
    const double x = std::min(end, onset * std::exp(range * static_cast<double>(k) / (LawShape::nodes - 1)));
    const Curve::Top a = own.top(x), b = stand_in.top(x);
    d.force_reduction[k] = -std::log(a.force / b.force);
    d.widening[k] = std::log(own.radius(x) / stand_in.radius(x));
    d.residual[k] = -std::log(a.span / b.span);
    d.dissipation[k] = -std::log(a.kept / b.kept);
    d.hertz_share[k] = a.share - b.share;
  }
  return d;
}

}  // namespace granulaw
