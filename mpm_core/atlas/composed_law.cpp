#include "atlas/composed_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/math/interpolators/makima.hpp>
#include <cmath>

#include "base/error.hpp"
#include "base/larger.hpp"
#include "atlas/body_numbers.hpp"
#include "atlas/finish_curve.hpp"
#include "atlas/overlap_at_work.hpp"
#include "atlas/unlike_pair.hpp"
#include "atlas/tabulate_curve.hpp"
#include "law/contact_law.hpp"
#include "contact/pair.hpp"
#include "law/damage_number.hpp"
#include "law/radiation.hpp"
#include "linear/linear.hpp"

namespace granulaw {

namespace {

constexpr int root_bits = 40;

/// One body at one contact radius: what it is at any mean pressure under any common shape.
class BodyAtContact
{
 public:
  BodyAtContact(const PairBody& body, double radius, double contact_radius, double most_curvature)
      : body_(body), contact_(contact_radius / radius), first_(std::log(most_curvature) - range_below)
  {
    double last = 0;
    for (int k = 0; k < nodes; ++k) {
      const PairBody::State state = body.at(std::exp(first_ + spacing * k), contact_);
      const double match = std::log(state.pressure / PressureShape::strength(state.flatness));
      last = k ? std::max(match, last + least_rise * spacing) : match;
      states_[static_cast<std::size_t>(k)] = state;
      match_[static_cast<std::size_t>(k)] = last;
    }
  }

  struct Share
  {
    double curvature, residual, recovered, returned;  // kappa; overlaps over a; work given back over F a
    double log_pressure;                              // of the body itself, under the common shape
    double log_yield_overlap;
    bool known;

    void give_back(double part) { recovered *= part, returned *= part; }
  };

  Share at(double pressure, double flatness) const
  {
    const double wanted = std::log(pressure / PressureShape::strength(flatness));
    const auto above = std::upper_bound(match_.begin(), match_.end(), wanted) - match_.begin();
    const int low = std::clamp(static_cast<int>(above) - 1, 0, nodes - 2);
    const auto k = static_cast<std::size_t>(low);
    const double place = (wanted - match_[k]) / (match_[k + 1] - match_[k]);
    if (place < 0) return elastic_below(pressure);
    const PairBody::State &a = states_[k], &b = states_[k + 1];
    const auto mixed = [&](double PairBody::State::*of) { return a.*of + place * (b.*of - a.*of); };
    const double own = std::exp(std::log(a.pressure) + place * std::log(b.pressure / a.pressure));
    const double own_flatness = mixed(&PairBody::State::flatness), e_star = body_.material().e_star();
    // where least_rise bends the match: what the body itself transmits, not what was matched
    const double transmitted =
        own * PressureShape::strength(flatness) / PressureShape::strength(own_flatness);
    const auto change = [&](double (*of)(double)) {
      return M_PI / e_star * (of(flatness) * transmitted - of(own_flatness) * own);
    };
    const double curvature = std::exp(first_ + spacing * (low + place));
    // overlaps go as the curvature: linear between the nodes is what they are over it
    const auto overlap = [&](double PairBody::State::*of) {
      const double at_a = a.*of / std::exp(first_ + spacing * low),
                   at_b = b.*of / std::exp(first_ + spacing * (low + 1));
      return curvature * (at_a + place * (at_b - at_a));
    };
    Share share;
    share.curvature = curvature + 2 * change(PressureShape::sag);
    share.residual = overlap(&PairBody::State::residual);
    share.recovered = overlap(&PairBody::State::recovered) + change(PressureShape::displacement) -
                      body_.finite_body() * M_PI / e_star * contact_ * (transmitted - own);
    share.returned = overlap(&PairBody::State::returned) + change(PressureShape::work) -
                     0.5 * body_.finite_body() * M_PI / e_star * contact_ * (transmitted - own);
    share.log_pressure = std::log(transmitted);
    share.log_yield_overlap = mixed(&PairBody::State::log_yield_overlap);
    share.known = place <= 1 && a.known && b.known;
    return share;
  }

 private:
  /// So stiff against its partner that it takes next to nothing of the curvature.
  Share elastic_below(double pressure) const
  {
    const PairBody::State& least = states_.front();
    const double part = pressure / least.pressure;
    return {part * std::exp(first_), 0,          part * least.recovered, part * least.returned, std::log(pressure),
            least.log_yield_overlap, least.known};
  }

  // Curvatures from 1/12000 of the whole on; up to twice, as an equivalent sphere under its own shape may have
  // more than its fraction.
  static constexpr int nodes = 96;
  static constexpr double range_below = 9.4, range = 10.1, spacing = range / (nodes - 1);
  /// d ln p/d ln kappa, at least: two bodies in full plasticity, whose hardness no longer depends on kappa,
  /// share the curvature somehow; this keeps the solution from jumping. What is transmitted is their own
  /// pressure.
  static constexpr double least_rise = 0.05;

  const PairBody& body_;
  double contact_, first_;
  std::array<PairBody::State, nodes> states_;
  std::array<double, nodes> match_;  // ln(p/strength), rising
};

}  // namespace

ComposedPair::ComposedPair(const PairBody& yielding, double radius, const PairBody& partner,
                           double partner_radius)
    : first_(yielding),
      second_(partner),
      radius_(radius),
      partner_radius_(partner_radius),
      r_eff_(1 / (1 / radius + 1 / partner_radius)),
      yield_radius_(find_yield_radius())
{
}

ComposedState ComposedPair::at(double a) const
{
  const double curvature = a / r_eff_;
  const BodyAtContact first(first_, radius_, a, curvature), second(second_, partner_radius_, a, curvature);
  const double softer = std::min(first_.material().e_star(), second_.material().e_star());
  const double stiffer = std::max(first_.material().e_star(), second_.material().e_star());

  BodyAtContact::Share s{}, h{};
  const auto balance = [&](double flatness) {
    const auto excess = [&](double log_pressure) {
      s = first.at(std::exp(log_pressure), flatness), h = second.at(std::exp(log_pressure), flatness);
      return s.curvature + h.curvature - curvature;
    };
    // Hertz's pressure for both as the softer would have it, and less; as the stiffer, and more
    excess(rising_root(excess, std::log(1e-4 * curvature * softer), std::log(3 * curvature * stiffer),
                       root_bits));
    return flatness - PressureShape::flatness_of((s.residual + h.residual) / (s.recovered + h.recovered));
  };
  const double flatness = rising_root(balance, 0.0, 1.0, root_bits);
  balance(flatness);

  ComposedState state;
  state.contact_radius = a;
  state.flatness = flatness;
  const double pressure =
      std::exp((s.curvature * s.log_pressure + h.curvature * h.log_pressure) / (s.curvature + h.curvature));
  state.force = M_PI * a * a * pressure;
  // Recovery goes as the pressure that both transmit: with least_rise the matched one may exceed it.
  for (BodyAtContact::Share* share : {&s, &h}) share->give_back(pressure / std::exp(share->log_pressure));
  state.overlap = a * (s.residual + s.recovered + h.residual + h.recovered);
  const double residual = s.residual + h.residual, recovered = s.recovered + h.recovered;
  // A surface that its partner hollows out is sloped under the pressure and recovers less, its partner's more.
  const auto slope = [&](BodyAtContact::Share& share, double radius) {
    constexpr double measured = 0.26;  // docs/develop/notes.md
    share.give_back(1 - measured * flatness * (share.curvature - a / radius));
  };
  slope(s, radius_), slope(h, partner_radius_);
  state.recovered = a * (s.recovered + h.recovered);
  state.unloading_work = (s.returned + h.returned) / (s.recovered + h.recovered);
  // Both unload as the body whose dent it is; elastic ones by what each recovers.
  constexpr double elastic = 1e-6;  // residual over recovered overlap from which on the dent counts
  const double share = (s.residual + elastic * s.recovered) / (residual + elastic * (s.recovered + h.recovered));
  const PairBody::Unloading of_first = first_.unloading(s.curvature, a / radius_, residual / recovered),
                            of_second = second_.unloading(h.curvature, a / partner_radius_, residual / recovered);
  for (std::size_t j = 0; j < of_first.size(); ++j)
    state.unloading[j] = share * of_first[j] + (1 - share) * of_second[j];
  state.log_yield_overlap = std::max(s.log_yield_overlap, h.log_yield_overlap);
  state.known = s.known && h.known;
  return state;
}

double ComposedPair::find_yield_radius() const
{
  if (!first_.yields() && !second_.yields()) return std::numeric_limits<double>::infinity();
  const double low = std::log(1e-5 * r_eff_), high = std::log(r_eff_);
  return std::exp(
      rising_root([&](double log_a) { return at(std::exp(log_a)).log_yield_overlap; }, low, high, root_bits));
}

namespace {

/// A pair's states in the coordinates of the pair rule.
struct Sample
{
  double x, force, radius, residual, returned;
  PairBody::Unloading unloading;
  double contact;  // radius over R*
  bool yielded;
};

class RuleCoordinates
{
 public:
  RuleCoordinates(const PairMapping& mapping, double r_eff)
      : length_(mapping.length(r_eff)), force_(mapping.force(r_eff)), radius_(mapping.radius(r_eff)), r_eff_(r_eff)
  {
  }
  Sample of(const ComposedState& s) const
  {
    const double x = s.overlap / length_, force = s.force / force_, recovered = s.recovered / length_;
    return {x,
            force,
            s.contact_radius / radius_,
            std::max(0.0, x - recovered),
            force * recovered * s.unloading_work,
            s.unloading,
            s.contact_radius / r_eff_,
            s.log_yield_overlap > 0};
  }

 private:
  double length_, force_, radius_, r_eff_;
};

/// Least squares of F/Hertz - 1 = c1 sqrt(x) + c2 x + c3 x^1.5 and of a/a_Hertz - 1 = d1 sqrt(x).
ElasticCorrection fit_correction(const std::vector<Sample>& samples, int terms)
{
  const auto rows = static_cast<Eigen::Index>(samples.size());
  Eigen::MatrixXd m(rows, terms);
  Eigen::VectorXd force(rows), root(rows), radius(rows);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const Sample& s = samples[static_cast<std::size_t>(row)];
    for (int term = 0; term < terms; ++term) m(row, term) = std::pow(s.x, 0.5 * (term + 1));
    force(row) = s.force / std::pow(s.x, 1.5) - 1;
    root(row) = std::sqrt(s.x);
    radius(row) = s.radius / std::sqrt(s.x) - 1;
  }
  const Eigen::VectorXd c = least_squares(m, force);
  return {c(0), c(1), root.dot(radius) / root.dot(root), terms > 2 ? c(2) : 0.0};
}

PairMapping mapping_of(const PairBody& yielding, const PairBody& partner)
{
  return PairMapping::deformable_partner(yielding.material().e_star(), partner.material().e_star());
}

ComposedError error_of(const PairBody& yielding, const PairBody& partner)
{
  ComposedError error = composed_error(partner.material().e_star() / yielding.material().e_star());
  error.solver = larger(yielding.solver_error(), partner.solver_error());
  return error;
}

/// Radii of the yielding body and its partner: only their ratio counts.
std::pair<double, double> radii_of(double radius_ratio)
{
  if (radius_ratio == 0) return {std::numeric_limits<double>::infinity(), 1.0};
  return {1.0, radius_ratio};
}

/// Elastic correction of the pair without yield, fitted up to the contact radius `widest`, over R*.
ElasticCorrection elastic_correction(const PairBody& s, const PairBody& h, double radius_ratio,
                                     const RuleCoordinates& rule, double widest, int terms)
{
  const PairBody elastic_s = s.elastic(), elastic_h = h.elastic();
  const auto [radius, partner_radius] = radii_of(radius_ratio);
  const ComposedPair pair(elastic_s, radius, elastic_h, partner_radius);
  std::vector<Sample> samples;
  constexpr int count = 24;
  for (int k = 1; k <= count; ++k) {
    const double a = pair.r_eff() * widest * k / count;
    const ComposedState state = pair.at(a);
    if (state.known) samples.push_back(rule.of(state));
  }
  return fit_correction(samples, terms);
}

/// From this contact radius on, to `depth`, or where the atlas ends or the contact is nearly as wide as the
/// smaller body.
std::vector<Sample> samples_from(double first, const ComposedPair& pair, const RuleCoordinates& rule,
                                 double depth)
{
  constexpr double step = 1.05;   // of the contact radius: 0.1 in ln x
  constexpr double widest = 0.9;  // the atlas's laws end at 0.9 to 1.1 R
  constexpr int last_ones = 2;    // beyond `depth`: makima's slopes up to there need them
  int beyond = 0;
  std::vector<Sample> samples;
  for (double a = first; a <= widest * pair.smaller_radius(); a *= step) {
    const ComposedState state = pair.at(a);
    if (!state.known) break;
    samples.push_back(rule.of(state));
    beyond += samples.back().x > depth;
    if (beyond > last_ones) break;
  }
  return samples;
}

bool covers_an_octave(const std::vector<Sample>& samples, double depth)
{
  constexpr std::size_t fewest = 8;
  return samples.size() >= fewest && std::min(depth, samples.back().x) >= 2 * samples.front().x;
}

/// From first yield on. A pair that yields so late that less than an octave of overlaps would be left begins
/// earlier: up to first yield its samples lose nothing.
std::vector<Sample> plastic_samples(const ComposedPair& pair, const RuleCoordinates& rule, double depth)
{
  constexpr double earlier = 0.9;    // contact radius
  constexpr double earliest = 0.05;  // over R*
  double first = pair.yield_radius();
  std::vector<Sample> samples = samples_from(first, pair, rule, depth);
  while (!covers_an_octave(samples, depth) && earlier * first > earliest * pair.r_eff())
    samples = samples_from(first *= earlier, pair, rule, depth);
  return samples;
}

using Interpolated = boost::math::interpolators::makima<std::vector<double>>;

/// The shape's functions through the samples, the first of which is the onset.
LawShape shape_of(const std::vector<Sample>& samples, const ElasticCorrection& elastic, double end)
{
  std::vector<double> log_x;
  std::array<std::vector<double>, LawShape::function_count> values;  // as LawShape::functions
  const double x0 = samples.front().x;
  double work =
      std::pow(x0, 2.5) * (0.4 + elastic.c1 * std::sqrt(x0) / 3 + elastic.c2 * x0 / 3.5);  // of loading
  double told_at_onset = 1;  // but for the fit of the elastic part
  double lost = 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const Sample& now = samples[k];
    if (k > 0) {  // F goes as a power of x between two samples
      const Sample& last = samples[k - 1];
      const double power = std::log(now.force / last.force) / std::log(now.x / last.x);
      const double more = (now.force * now.x - last.force * last.x) / (power + 1);
      work += more;
    }
    if (k == 0 || !now.yielded)
      told_at_onset = now.returned / work;
    else  // what is lost cannot be given back later
      lost = std::max(work - now.returned / told_at_onset, lost);
    const double s = std::pow(now.x, 0.25);
    log_x.push_back(std::log(now.x));
    const double now_values[] = {-std::log(now.force / (std::pow(now.x, 1.5) * elastic.force_ratio(s))),
                                 std::log(now.radius / (std::sqrt(now.x) * elastic.radius_ratio(s))),
                                 -std::log1p(-now.residual / now.x),
                                 -std::log1p(-lost / work),
                                 now.unloading[0] - elastic.unloading(s).hertz_share,
                                 now.unloading[1],
                                 now.unloading[2],
                                 now.unloading[3]};
    for (std::size_t f = 0; f < values.size(); ++f) values[f].push_back(now_values[f]);
  }
  LawShape shape = LawShape::zero(x0, end);
  shape.elastic = elastic;
  for (std::size_t f = 0; f < values.size(); ++f) {
    const double at_onset = values[f].front();  // rounding of the fitted elastic part
    for (double& value : values[f]) value -= at_onset;
    const Interpolated curve(std::vector<double>(log_x), std::move(values[f]));
    for (int k = 1; k < LawShape::nodes; ++k)
      (shape.*LawShape::functions[f])[static_cast<std::size_t>(k)] = curve(std::min(
          log_x.front() + (std::log(end) - log_x.front()) * k / (LawShape::nodes - 1), log_x.back()));
  }
  return shape;
}

/// Those of the yielding body at its own damage number: an impact reaches so much less than by the slow law
/// as that body's own does. `speed_ratio`: UnlikePair::axis_speed_ratio().
std::vector<LawShape::VelocityEffect> velocity_effects(const LawShape& own, const ContactLaw& own_slow,
                                                       const ContactLaw& pair_slow,
                                                       const BodyNumbers& body, double speed_ratio)
{
  std::vector<LawShape::VelocityEffect> effects = own.velocity_effects;
  const double unit = energy_unit(body.mass, body.yield);
  for (LawShape::VelocityEffect& effect : effects) {
    const double own_overlap = own_slow.overlap_at_work(unit * effect.speed * effect.speed);
    effect.speed *= speed_ratio;
    const double overlap = pair_slow.overlap_at_work(unit * effect.speed * effect.speed);
    effect.log_overlap += std::log(overlap / own_overlap / speed_ratio);
  }
  return effects;
}

}  // namespace

ComposedError composed_error(double e_star_ratio)
{
  const double softness = 1 / (1 + e_star_ratio);
  return {0.006 + 0.036 * softness * softness, 0.0058 + 0.023 * softness * softness, 0};
}

namespace {

/// The law of a pair neither of which yields: e is 1, but for waves.
TwoBodyLaw elastic_law(const PairBody& yielding, const PairBody& partner, double radius_ratio,
                       const LawRange& range)
{
  const auto [radius, partner_radius] = radii_of(radius_ratio);
  const RuleCoordinates rule(mapping_of(yielding, partner), 1 / (1 / radius + 1 / partner_radius));
  const double depth = std::min(range.depth, ElasticSphere::depth);
  TwoBodyLaw result;
  result.radius_ratio = radius_ratio;
  BodyLaw& law = result.law;
  law.material = yielding.material();
  law.curve =
      tabulate({elastic_correction(yielding, partner, radius_ratio, rule, std::sqrt(depth), 3), depth});
  law.certificate.origin = composed_origin;
  law.certificate.damage_number_max = std::numeric_limits<double>::infinity();
  const ComposedError error = error_of(yielding, partner);
  law.certificate.atlas_error_force = error.force;  // e is 1
  law.certificate.solver_error_force = error.solver;
  law.state();
  return result;
}

}  // namespace

double composed_damage_number(const UnlikePair& pair)
{
  constexpr double measured = 0.003;
  const LawMaterial &yielding = pair.yielding, &partner = pair.partner;
  const double part = pair.mapping().sqrt_lambda - 1;  // over the yielding body's
  const double of_partner = part * part * partner.density / yielding.density;
  if (std::isinf(pair.radius_ratio)) return measured / of_partner;
  const bool yielding_is_wall = pair.radius_ratio == 0;
  const double of_axis = yielding_is_wall ? 1.0 : std::pow(pair.axis_speed_ratio(), 2);
  return measured / std::max(of_axis, of_partner);
}

ComposedShape compose_shape(const Atlas& atlas, const PairBody& yielding, const PairBody& partner,
                            double radius_ratio, const LawRange& range)
{
  const auto [radius, partner_radius] = radii_of(radius_ratio);
  const ComposedPair pair(yielding, radius, partner, partner_radius);
  const RuleCoordinates rule(mapping_of(yielding, partner), pair.r_eff());
  const std::vector<Sample> samples = plastic_samples(pair, rule, range.depth);
  if (!covers_an_octave(samples, range.depth))
    fail(fmt::format("the pair {}:{}", yielding.material().name, partner.material().name),
         "begins to yield where the atlas ends, or the law",
         fmt::format("a = {:.3g} R*", pair.yield_radius() / pair.r_eff()));
  const double onset = samples.front().x, end = std::min(range.depth, samples.back().x);
  const double widest = larger(std::sqrt(std::clamp(1.5 * onset, 0.005, 0.04)), samples.front().contact);
  const ElasticCorrection elastic = elastic_correction(yielding, partner, radius_ratio, rule, widest, 2);
  const MaterialRatios ratios = yielding.ratios();
  const UnlikePair unlike{yielding.material(), partner.material(), radius_ratio};
  const double speed_ratio = unlike.axis_speed_ratio();
  ComposedShape composed{
      yielding.material(),
      radius_ratio,
      shape_of(samples, elastic, end),
      body_numbers(ratios),
      end,
      error_of(yielding, partner),
      composed_damage_number(unlike),
      speed_ratio};
  if (range.fastest > 0) {
    const LawShape own = yielding.own_shape(atlas);
    composed.shape.velocity_effects =
        velocity_effects(own, ContactLaw(own), ContactLaw(composed.shape), composed.body, speed_ratio);
  }
  composed.body.onset = onset;
  return composed;
}

TwoBodyLaw law_of(const ComposedShape& composed, const LawRange& range)
{
  TwoBodyLaw result;
  result.radius_ratio = composed.radius_ratio;
  BodyLaw& law = result.law;
  law.material = composed.material;
  law.certificate.origin = composed_origin;
  law.certificate.atlas_error_force = composed.stated.force;
  law.certificate.atlas_error_restitution = composed.stated.restitution;
  law.certificate.solver_error_force = law.certificate.solver_error_restitution = composed.stated.solver;
  LawRange of_pair = range;
  of_pair.depth = composed.end;
  of_pair.fastest = range.fastest * composed.speed_ratio;
  if (!composed.shape.velocity_effects.empty())
    of_pair.fastest = std::min(of_pair.fastest, composed.shape.velocity_effects.back().speed);
  law.certificate.interpolation_error =
      finish_curve(law, composed.shape, composed.body, of_pair);
  double& limit = law.certificate.damage_number_max;  // so far v^2 of the axis
  limit = std::min(limit / (composed.speed_ratio * composed.speed_ratio), composed.damage_number_max);
  law.state();
  return result;
}

void leave_out_axis(TwoBodyLaw& own, const LawMaterial& partner, double tolerance)
{
  const LawMaterial& yielding = own.law.material;
  const PairMapping mapping = PairMapping::deformable_partner(yielding.e_star(), partner.e_star());
  const auto [radius, partner_radius] = radii_of(own.radius_ratio);
  const double r_eff = 1 / (1 / radius + 1 / partner_radius);
  const auto mass = [](const LawMaterial& m, double r) { return 4.0 / 3.0 * M_PI * m.density * r * r * r; };
  const double m_eff = 1 / (1 / mass(yielding, radius) + 1 / mass(partner, partner_radius));
  const double waves = radiation(yielding, radius, partner, partner_radius);
  const auto pair_of = [&](const BodyLaw& law) { return PairLaw{{&law.curve, mapping, waves}, &law}; };
  const double per_speed = pair_of(own.law).axis_speed(r_eff, m_eff, 1.0);
  const AxisCollision collide = [&](const BodyLaw& law, double v) {
    return replay_collision(pair_of(law), r_eff, m_eff, v / per_speed, cheap_replay);
  };
  const double fastest = std::sqrt(own.law.certificate.damage_number_max / damage_number(pair_of(own.law), 1.0));  // m/s
  leave_out_axis(own.law, collide, tolerance, fastest * per_speed);
}

TwoBodyLaw compose_law(const Atlas& atlas, const PairBody& yielding, const PairBody& partner,
                       double radius_ratio, const LawRange& range)
{
  if (!yielding.yields() && !partner.yields()) return elastic_law(yielding, partner, radius_ratio, range);
  TwoBodyLaw law = law_of(compose_shape(atlas, yielding, partner, radius_ratio, range), range);
  leave_out_axis(law, partner.material(), range.tolerance);
  return law;
}

}  // namespace granulaw
