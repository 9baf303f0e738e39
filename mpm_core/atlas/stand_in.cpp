#include "atlas/stand_in.hpp"

#include <algorithm>
#include <cmath>

#include "atlas/interpolation.hpp"

namespace granulaw {

namespace {

/// Laws of one stiffness by hardening_coordinate(), cubic between steps of a quarter or less.
class ByHardening
{
 public:
  ByHardening(const Atlas& atlas, double stiffness, double poisson_ratio, double first, double last)
  {
    constexpr double spacing = 0.25;
    const int gaps = static_cast<int>(std::ceil((last - first) / spacing));
    for (int k = 0; k <= gaps; ++k) {
      places_.push_back(gaps ? first + (last - first) * k / gaps : first);
      shapes_.push_back(atlas.shape({stiffness, poisson_ratio, std::expm1(places_.back()) / (2 * stiffness)}));
    }
  }
  /// A number of the law at a coordinate.
  template <class Of>
  double at(double coordinate, const Of& of) const
  {
    const std::vector<double> weights = interpolation_weights(places_, coordinate);
    double sum = 0;
    for (std::size_t k = 0; k < shapes_.size(); ++k)
      if (weights[k] != 0) sum += weights[k] * of(shapes_[k]);
    return sum;
  }
  const LawShape& first() const { return shapes_.front(); }

 private:
  std::vector<double> places_;
  std::vector<LawShape> shapes_;
};

/// H/E of a stress gained over a strain; E/Y = stiffness (1 - nu^2).
double hardening_of(double gain_over_yield, double strain, double stiffness, double poisson_ratio)
{
  return gain_over_yield / (strain * stiffness * (1 - poisson_ratio * poisson_ratio));
}

}  // namespace

LawShape stand_in(const Atlas& atlas, double stiffness, double poisson_ratio, const FlowCurve& flow)
{
  constexpr double least_strain = 1e-6;  // of the secant at first yield
  const LawShape plain = atlas.shape({stiffness, poisson_ratio, 0});
  std::vector<double> places;  // by node
  for (std::size_t k = 0; k < LawShape::nodes; ++k) {
    const double grown = std::sqrt(plain.overlap(k)) * std::exp(plain.widening[k]) - std::sqrt(plain.onset);
    const double strain = std::max(least_strain, representative_strain * grown);
    const double hardening = hardening_of(flow(strain) - 1, strain, stiffness, poisson_ratio);
    places.push_back(
        hardening_coordinate(stiffness, std::clamp(hardening, 0.0, atlas.grid().hardenings.back())));
  }
  const auto [least, most] = std::minmax_element(places.begin(), places.end());
  const ByHardening laws(atlas, stiffness, poisson_ratio, *least, *most);
  LawShape shape = laws.first();
  for (const auto member : LawShape::functions)
    for (std::size_t k = 0; k < LawShape::nodes; ++k)
      (shape.*member)[k] = laws.at(places[k], [&](const LawShape& s) { return (s.*member)[k]; });
  for (std::size_t k = 0; k < shape.velocity_effects.size(); ++k) {
    using Effect = LawShape::VelocityEffect;
    Effect& effect = shape.velocity_effects[k];
    const double overlap =
        std::clamp(effect.speed * std::exp(effect.log_overlap), shape.onset, shape.end);
    const auto node =
        static_cast<std::size_t>(std::lround(shape.q(overlap) / shape.q(shape.end) * (LawShape::nodes - 1)));
    const auto at = [&](const auto& of) {
      return laws.at(places[node], [&](const LawShape& s) { return of(s.velocity_effects[k]); });
    };
    for (double Effect::*number : {&Effect::log_overlap, &Effect::dissipation, &Effect::residual})
      effect.*number = at([&](const Effect& e) { return e.*number; });
    for (std::size_t i = 0; i < effect.force.size(); ++i)
      effect.force[i] = at([i](const Effect& e) { return e.force[i]; });
  }
  return shape;
}

MaterialRatios stand_in_at_equator(const Atlas& atlas, double stiffness, double poisson_ratio,
                                   const FlowCurve& flow)
{
  constexpr double step = 0.05, overlap = 0.2;
  const double strain = representative_strain * std::sqrt(2 * overlap);  // a^2 = 2 R delta
  const double gain = flow((1 + step) * strain) - flow((1 - step) * strain);
  return {stiffness, poisson_ratio,
          std::clamp(hardening_of(gain, 2 * step * strain, stiffness, poisson_ratio), 0.0,
                     atlas.grid().hardenings.back())};
}

FlowCurve of_twin(FlowCurve flow, double q)
{
  return [flow = std::move(flow), q](double strain) { return flow(q * strain); };
}

}  // namespace granulaw
