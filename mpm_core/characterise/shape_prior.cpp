#include "characterise/shape_prior.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>

namespace granulaw {

namespace {

struct Part
{
  double weight;
  const ShapePrior* law;
};

/// Weighted sum at the same r. `left`: delta_onset/R, or a mean of two, by which the sum is wrong at r = 1.
ShapePrior sum(double onset, double end, std::initializer_list<Part> parts, double left)
{
  const double range = std::log(end / onset);
  ShapePrior prior{LawShape::zero(onset, end), onset, end, {}};
  for (const auto& [weight, law] : parts) prior.shape.add(weight, law->shape.at_range(onset, end));
  for (int k = 0; k < LawShape::nodes; ++k) {
    const double r = std::exp(range * k / (LawShape::nodes - 1));
    double variance = std::pow(r * left / ShapePrior::run_error, 2);
    for (const auto& [weight, law] : parts) variance += std::pow(weight * law->error_at(r * law->onset), 2);
    prior.error.push_back(std::sqrt(variance));
  }
  return prior;
}

}  // namespace

ShapePrior ShapePrior::of(LawShape shape, double onset, double end, double known)
{
  shape.onset = onset, shape.end = end;
  ShapePrior prior{std::move(shape), onset, end, std::vector<double>(LawShape::nodes, law_error)};
  prior.end_at(known);
  return prior;
}

double ShapePrior::error_at(double overlap) const
{
  constexpr double rounding = 1e-9;  // of a place between nodes
  const double place = std::log(overlap / onset) / std::log(end / onset) * (LawShape::nodes - 1);
  if (place > LawShape::nodes - 1 + rounding) return std::numeric_limits<double>::infinity();
  const auto node = [](double at) {
    return static_cast<std::size_t>(std::clamp(at, 0.0, LawShape::nodes - 1.0));
  };
  return std::max(error[node(std::floor(place + rounding))], error[node(std::ceil(place - rounding))]);
}

void ShapePrior::end_at(double overlap)
{
  for (int k = 0; k < LawShape::nodes; ++k)
    if (onset * std::pow(end / onset, static_cast<double>(k) / (LawShape::nodes - 1)) > overlap * (1 + 1e-9))
      error[static_cast<std::size_t>(k)] = std::numeric_limits<double>::infinity();
}

ShapePrior at_range(double onset, double end, const ShapePrior& law)
{
  return sum(onset, end, {{1, &law}}, 0.0);
}

ShapePrior similar_by_two(double onset, double end, const ShapePrior& stiffer, const ShapePrior& softer)
{
  const double y = std::sqrt(onset), a = std::sqrt(stiffer.onset), b = std::sqrt(softer.onset);
  const double slope = (y - a) / (a - b);
  return sum(onset, end, {{1 + slope, &stiffer}, {-slope, &softer}}, finite_body * (a - y) * (b - y));
}

ShapePrior similar_by_change(double onset, double end, const ShapePrior& softer, const ShapePrior& there,
                             const ShapePrior& here, double unlike)
{
  return sum(onset, end, {{1, &softer}, {1, &here}, {-1, &there}}, unlike * (softer.onset - onset));
}

}  // namespace granulaw
