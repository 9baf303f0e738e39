#include "law/law_shape.hpp"

#include <algorithm>
#include <cmath>

#include "law/rising_root.hpp"
#include "law/contact_law.hpp"

namespace granulaw {

namespace {

void add_to(std::vector<double>& sum, double weight, const std::vector<double>& values)
{
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weight * values[k];
}

}  // namespace

LawShape LawShape::zero(double onset, double end)
{
  const std::vector<double> none(nodes, 0.0);
  LawShape shape{{}, none, none, none, none, none, none, none, none, {}, onset, end};
  for (const double v : impact_speeds)
    shape.velocity_effects.push_back({v, 0, 0, 0, std::vector<double>(VelocityEffect::shares, 0.0)});
  return shape;
}

const std::array<std::vector<double> LawShape::*, LawShape::function_count> LawShape::functions = {
    &LawShape::force_reduction, &LawShape::widening, &LawShape::residual, &LawShape::dissipation,
    &LawShape::hertz_share,     &LawShape::radius_0, &LawShape::radius_1, &LawShape::radius_2};

void ElasticCorrection::add(double weight, const ElasticCorrection& other)
{
  c1 += weight * other.c1, c2 += weight * other.c2, c3 += weight * other.c3;
  d1 += weight * other.d1;
}

void LawShape::add(double weight, const LawShape& other, Part part)
{
  const auto wanted = [part](Part one) { return part == Part::all || part == one; };
  if (wanted(Part::loading)) {
    elastic.add(weight, other.elastic);
    add_to(force_reduction, weight, other.force_reduction);
    add_to(widening, weight, other.widening);
  }
  if (wanted(Part::unloading))
    for (std::size_t f = 2; f < functions.size(); ++f) add_to(this->*functions[f], weight, other.*functions[f]);
  for (std::size_t k = 0; wanted(Part::impacts) && k < velocity_effects.size(); ++k) {
    VelocityEffect& effect = velocity_effects[k];
    for (double VelocityEffect::*number :
         {&VelocityEffect::log_overlap, &VelocityEffect::dissipation, &VelocityEffect::residual})
      effect.*number += weight * other.velocity_effects[k].*number;
    add_to(effect.force, weight, other.velocity_effects[k].force);
  }
}

LawShape LawShape::at_range(double other_onset, double other_end) const
{
  LawShape result = zero(other_onset, other_end);
  result.elastic = elastic;
  const double ratio = onset / other_onset;
  for (const auto member : functions) {
    const Spline function = by_q(member);
    for (std::size_t k = 0; k < nodes; ++k)
      (result.*member)[k] = function.value(q(std::min(end, ratio * result.overlap(k))));
  }
  return result;
}

LawShape LawShape::as_skin_of(const ElasticCorrection& body, double known) const
{
  const ContactLaw sphere(*this, known);
  const double at_onset = std::pow(onset, 0.25);
  const double difference = body.measured  // of c1
                                ? (elastic.force_ratio(at_onset) - body.force_ratio(at_onset)) / std::sqrt(onset)
                                : elastic.c1 - body.c1;
  const double compliance = 2.0 / 3.0 * difference;
  LawShape result = *this;
  result.elastic = body;
  result.velocity_effects = zero().velocity_effects;
  std::array<Spline, 3> radii;
  for (std::size_t j = 0; j < 3; ++j) radii[j] = by_q(functions[first_radius + j]);
  for (std::size_t k = 1; k < nodes; ++k) {
    const double x = overlap(k);
    if (x > known) {
      for (const auto member : functions) (result.*member)[k] = (result.*member)[k - 1];
      continue;
    }
    const double skin =  // x', the root of x' + C F(x') = x
        rising_root([&](double at) { return at + compliance * sphere.force(at) - x; }, 0.0, x, 50);
    const double s = std::pow(x, 0.25), force = sphere.force(skin);
    const double below = 0.5 * compliance * force * force;  // work
    const double work = sphere.work(skin), returned = work * sphere.kept(skin);
    result.force_reduction[k] = -std::log(force / (std::pow(x, 1.5) * body.force_ratio(s)));
    result.widening[k] = std::log(sphere.radius(skin) / (std::sqrt(x) * body.radius_ratio(s)));
    result.residual[k] = -std::log1p(-sphere.reversal(skin).residual() / x);
    result.dissipation[k] = -std::log((returned + below) / (work + below));
    for (std::size_t j = 0; j < 3; ++j) (result.*functions[first_radius + j])[k] = radii[j].value(q(skin));
  }
  return result;
}

}  // namespace granulaw
