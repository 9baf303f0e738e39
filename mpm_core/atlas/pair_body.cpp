#include "atlas/pair_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>

#include "base/error.hpp"
#include "atlas/body_numbers.hpp"
#include "atlas/interpolation.hpp"
#include "atlas/tabulate_curve.hpp"

namespace granulaw {

namespace {

// Equivalent spheres: the atlas's spacing in ln(E*/Y), over curvatures 14 times the flat's either way (radii
// 1:10 and a partner that takes a tenth of the curvature).
constexpr double farthest_twin = 14;
constexpr int twins_made = 9;

// Nodes of a equivalent sphere in ln(overlap/overlap at first yield): up to that, and from there to where the
// atlas ends, in which laws of different stiffness resemble each other (LawShape).
constexpr double first_log_overlap = -8;
constexpr int elastic_intervals = 80, plastic_intervals = 240;
constexpr int overlap_nodes = elastic_intervals + plastic_intervals + 1;

/// `end`: that of the atlas.
double log_overlap_of(double node, double end)
{
  return node < elastic_intervals ? first_log_overlap * (1 - node / elastic_intervals)
                                  : end * (node - elastic_intervals) / plastic_intervals;
}

/// Curvature of a deformable wall, which has no finite body, in place of alpha = 0.
constexpr double flat = 1e-6;

/// Between the values at 0 and 1.
double between(double first, double last, double share)
{
  return first + (last - first) * share;
}

}  // namespace

double PressureShape::flatness_of(double residual_over_recovered)
{
  constexpr double measured = 0.4;
  return -std::expm1(-std::max(0.0, residual_over_recovered) / measured);
}

double PressureShape::displacement(double flatness)
{
  return between(0.75, 2 / M_PI, flatness);
}

double PressureShape::sag(double flatness)
{
  return between(0.375, 2 / M_PI - 4 / (M_PI * M_PI), flatness);
}

double PressureShape::strength(double flatness)
{
  constexpr double weaker = 0.2;
  return 1 / (1 - weaker * flatness);
}

PairBody::PairBody(const Atlas& atlas, const LawMaterial& material)
    : material_(material),
      ratios_(MaterialRatios::of(material)),
      elastic_(atlas.elastic(material.poisson_ratio).fit.correction)
{
  finite_body_ = 0.5 * elastic_.c1;
  if (material.yields()) make_twins(atlas);
}

PairBody::PairBody(const Atlas& atlas, const LawMaterial& material, const Curve& own)
    : material_(material), ratios_(MaterialRatios::of(material))
{
  const double onset = onset_of(ratios_);
  const Twin own_twin = tabulated(own, atlas.elastic(ratios_.poisson_ratio).fit.correction, ratios_.stiffness,
                                  onset, own.end());
  const auto misfit = [&](double log_hardening) {
    return departure(own_twin, stand_in(atlas, std::exp(log_hardening))).rms();
  };
  const std::vector<double>& known = atlas.grid().hardenings;  // the first is 0
  constexpr int bits = 8;                                      // of ln(H/E): the departure takes the rest
  const auto [nearest, least] =
      boost::math::tools::brent_find_minima(misfit, std::log(known[1]), std::log(known.back()), bits);
  ratios_.hardening = least < departure(own_twin, stand_in(atlas, 0)).rms() ? std::exp(nearest) : 0;
  departure_ = departure(own_twin, stand_in(atlas, ratios_.hardening));
  make_twins(atlas);
}

void PairBody::make_twins(const Atlas& atlas)
{
  const MaterialRatios& own = ratios_;
  const AtlasGrid& grid = atlas.grid();
  const double stiffest = std::min(grid.stiffnesses.back(), own.stiffness * farthest_twin);
  const double softest = std::max(grid.stiffnesses.front(), stiffest / (farthest_twin * farthest_twin));
  if (!(softest < stiffest) || !atlas.why_not({stiffest, own.poisson_ratio, 0}).empty())
    fail(fmt::format("material '{}'", material_.name), "has no equivalent spheres in the atlas");
  elastic_ = atlas.shape({std::clamp(own.stiffness, softest, stiffest), own.poisson_ratio, 0}).elastic;
  finite_body_ = 0.5 * elastic_.c1;
  for (int k = 0; k < twins_made; ++k)
    twins_.push_back(
        twin(atlas, softest * std::pow(stiffest / softest, static_cast<double>(k) / (twins_made - 1))));
  for (const Twin& t : twins_) log_stiffnesses_.push_back(t.log_stiffness);
}

PairBody PairBody::elastic() const
{
  PairBody body = *this;
  body.twins_.clear();
  body.material_.yield_stress = std::numeric_limits<double>::infinity();
  body.material_.hardening_modulus = 0;
  return body;
}

/// A equivalent sphere from its slow law on a rigid flat, up to the overlap `depth`.
PairBody::Twin PairBody::tabulated(const Curve& curve, const ElasticCorrection& elastic,
                                   double stiffness, double onset, double depth)
{
  Twin t;
  t.log_stiffness = std::log(stiffness);
  t.log_end = std::log(depth / onset);
  for (int node = 0; node < overlap_nodes; ++node) {
    const double x = onset * std::exp(log_overlap_of(node, t.log_end));
    const Reversal top = curve.reversal(x);
    const double force = 4.0 / 3.0 * top.top(), radius = curve.radius(x);
    const bool is_elastic = node <= elastic_intervals;
    const UnloadingShape unloading = is_elastic ? elastic.unloading(std::pow(x, 0.25)) : top.shape();
    t.log_contact.push_back(std::log(radius));
    t.log_pressure.push_back(std::log(force * stiffness / (M_PI * radius * radius)));
    t.log_overlap.push_back(std::log(x));
    // -ln of the fraction that is recovered
    t.log_lost.push_back(is_elastic ? 0.0 : -std::log1p(-top.residual() / x));
    t.unloading_work.push_back(unloading.work());
    t.hertz_share.push_back(unloading.hertz_share);
  }
  return t;
}

PairBody::Twin PairBody::twin(const Atlas& atlas, double stiffness) const
{
  const MaterialRatios ratios{stiffness, ratios_.poisson_ratio, ratios_.hardening};
  const LawShape shape = atlas.shape(ratios);
  const double onset = onset_of(ratios);
  Twin t = tabulated(tabulate(shape, Atlas::depth), shape.elastic, stiffness, onset,
                     Atlas::depth);
  for (std::size_t node = 0; node < t.log_contact.size(); ++node) {
    const double log_strain = t.log_contact[node] + t.log_stiffness;
    const auto more = [&](const std::vector<double> Departure::*member) {
      return departure_.at(log_strain, member);
    };
    t.log_pressure[node] += more(&Departure::log_pressure);
    t.log_overlap[node] += more(&Departure::log_overlap);
    t.unloading_work[node] += more(&Departure::unloading_work);
    t.hertz_share[node] += more(&Departure::hertz_share);
    // a fit may scatter by rounding, place() needs it rising
    const double lost = t.log_lost[node] + more(&Departure::log_lost);
    t.log_lost[node] = node ? std::max(lost, t.log_lost[node - 1]) : lost;
  }
  return t;
}

/// Equivalent sphere with the body's stiffness and this H/E.
PairBody::Twin PairBody::stand_in(const Atlas& atlas, double hardening) const
{
  const LawShape shape = atlas.shape({ratios_.stiffness, ratios_.poisson_ratio, hardening});
  const double onset = onset_of(ratios_);
  return tabulated(tabulate(shape, Atlas::depth), shape.elastic, ratios_.stiffness,
                   onset, Atlas::depth);
}

PairBody::Departure PairBody::departure(const Twin& own, const Twin& stand_in)
{
  Departure departure;
  for (std::size_t node = elastic_intervals; node < own.log_contact.size(); ++node) {
    const double log_contact = own.log_contact[node];
    const auto above =
        std::upper_bound(stand_in.log_contact.begin(), stand_in.log_contact.end(), log_contact);
    if (above == stand_in.log_contact.begin() || above == stand_in.log_contact.end()) continue;
    const auto low = static_cast<std::size_t>(above - stand_in.log_contact.begin()) - 1;
    const double share = (log_contact - stand_in.log_contact[low]) /
                         (stand_in.log_contact[low + 1] - stand_in.log_contact[low]);
    const auto difference = [&](const std::vector<double> Twin::*member) {
      return (own.*member)[node] - between((stand_in.*member)[low], (stand_in.*member)[low + 1], share);
    };
    departure.log_strain.push_back(log_contact + own.log_stiffness);
    departure.log_pressure.push_back(difference(&Twin::log_pressure));
    departure.log_overlap.push_back(difference(&Twin::log_overlap));
    departure.log_lost.push_back(difference(&Twin::log_lost));
    departure.unloading_work.push_back(difference(&Twin::unloading_work));
    departure.hertz_share.push_back(difference(&Twin::hertz_share));
  }
  return departure;
}

double PairBody::Departure::at(double wanted, const std::vector<double> Departure::*member) const
{
  if (log_strain.empty() || wanted <= log_strain.front()) return 0;
  if (wanted >= log_strain.back()) return (this->*member).back();
  const auto low = static_cast<std::size_t>(std::upper_bound(log_strain.begin(), log_strain.end(), wanted) -
                                            log_strain.begin()) -
                   1;
  return between((this->*member)[low], (this->*member)[low + 1],
                 (wanted - log_strain[low]) / (log_strain[low + 1] - log_strain[low]));
}

double PairBody::Departure::rms() const
{
  double sum = 0;
  for (const double difference : log_pressure) sum += difference * difference;
  return std::sqrt(sum / static_cast<double>(log_pressure.size()));
}

/// Overlap/R of the elastic sphere at this a/R.
double PairBody::elastic_overlap(double contact) const
{
  double x = contact * contact;
  for (int round = 0; round < 30; ++round) {
    const double next = std::pow(contact / elastic_.radius_ratio(std::pow(x, 0.25)), 2);
    if (next == x) break;
    x = next;
  }
  return x;
}

PairBody::State PairBody::elastic_at(double curvature, double contact) const
{
  const double alpha = std::max(contact, flat), x = elastic_overlap(alpha), share = curvature / alpha;
  const double force = 4.0 / 3.0 * std::pow(x, 1.5) * elastic_.force_ratio(std::pow(x, 0.25));
  State state;
  state.pressure = material_.e_star() * share * force / (M_PI * alpha * alpha);
  state.recovered = share * x / alpha;
  state.log_yield_overlap = first_log_overlap;
  state.known = x <= Atlas::depth;
  return state;
}

PairBody::Mixed PairBody::twin_at(double curvature, double contact) const
{
  const double own = std::log(material_.e_star() / material_.yield_stress);
  const double wanted =
      contact > 0 ? own + std::log(curvature / contact) : std::numeric_limits<double>::infinity();
  const double told = std::clamp(wanted, log_stiffnesses_.front(), log_stiffnesses_.back());
  const std::vector<double> weights = interpolation_weights(log_stiffnesses_, told);
  Mixed twin{std::exp(told - own), 0, {}, told != wanted};
  while (twin.first + twin.weights.size() < weights.size() && weights[twin.first] == 0) ++twin.first;
  std::copy_n(weights.begin() + static_cast<std::ptrdiff_t>(twin.first), twin.weights.size(),
              twin.weights.begin());
  return twin;
}

double PairBody::value(const Mixed& twin, const std::vector<double> Twin::*member, int node) const
{
  double sum = 0;
  for (std::size_t k = 0; k < twin.weights.size(); ++k)
    sum += twin.weights[k] * (twins_[twin.first + k].*member)[static_cast<std::size_t>(node)];
  return sum;
}

double PairBody::value(const Mixed& twin, const std::vector<double> Twin::*member, double place) const
{
  const int low = std::clamp(static_cast<int>(place), 0, overlap_nodes - 2);
  return between(value(twin, member, low), value(twin, member, low + 1), place - low);
}

double PairBody::place(const Mixed& twin, const std::vector<double> Twin::*member, double wanted) const
{
  int low = 0, high = overlap_nodes - 1;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    (value(twin, member, middle) <= wanted ? low : high) = middle;
  }
  const double first = value(twin, member, low), last = value(twin, member, high);
  return low + (last > first ? (wanted - first) / (last - first) : 0.0);
}

PairBody::State PairBody::at(double curvature, double contact) const
{
  if (!yields()) return elastic_at(curvature, contact);
  const Mixed twin = twin_at(curvature, contact);
  // Equivalent sphere beyond the atlas: the nearest one within it, at the same kappa; the overlap is
  // corrected for the finite size of that sphere.
  const double alpha = twin.is_clipped ? curvature / twin.share : contact;
  const double node = place(twin, &Twin::log_contact, std::log(alpha));
  double log_end = 0;
  for (std::size_t k = 0; k < twin.weights.size(); ++k)
    log_end += twin.weights[k] * twins_[twin.first + k].log_end;

  State state;
  state.log_yield_overlap = log_overlap_of(node, log_end);
  // A equivalent sphere put in the place of one that is too stiff for the atlas is soft for lack of a body,
  // not of pressure.
  constexpr double widest_stand_in = 0.35;
  const double log_strain = std::log(curvature * ratios_.stiffness);
  state.known = node < overlap_nodes && !(twin.is_clipped && alpha > std::max(contact, widest_stand_in)) &&
                (departure_.log_strain.empty() || log_strain <= departure_.log_strain.back());
  state.pressure = material_.yield_stress * std::exp(value(twin, &Twin::log_pressure, node));
  const double overlap = twin.share * std::exp(value(twin, &Twin::log_overlap, node)) / alpha;
  const double kept = std::exp(-std::max(0.0, value(twin, &Twin::log_lost, node)));
  state.residual = overlap * (1 - kept);
  state.recovered =
      overlap * kept - finite_body_ * M_PI * state.pressure / material_.e_star() * (contact - alpha);
  state.flatness = PressureShape::flatness_of(state.residual / state.recovered);
  return state;
}

PairBody::Unloading PairBody::unloading(double curvature, double contact,
                                        double residual_over_recovered) const
{
  if (!yields()) {
    const UnloadingShape shape = elastic_.unloading(std::pow(elastic_overlap(std::max(contact, flat)), 0.25));
    return {shape.work(), shape.hertz_share};
  }
  const Mixed twin = twin_at(curvature, contact);
  const double node = place(twin, &Twin::log_lost, std::log1p(residual_over_recovered));
  return {value(twin, &Twin::unloading_work, node), value(twin, &Twin::hertz_share, node)};
}

}  // namespace granulaw
