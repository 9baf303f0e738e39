#include "atlas/pair_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "atlas/interpolation.hpp"

namespace granulaw {

namespace {

// Equivalent spheres: the atlas's spacing in ln(E*/Y), over curvatures 14 times the flat's either way (radii
// 1:10 and a partner that takes a tenth of the curvature).
constexpr double farthest_twin = 14;
constexpr int twins_made = 9;

// Nodes of an equivalent sphere in ln(overlap/overlap at first yield): up to that, and from there to where the
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

/// Contact over radius of the equivalent sphere: a surface that its partner hollows out counts as wider. The square is
/// measured (docs/develop/notes.md); a body on a flat or its like, and one that its partner wraps, is its own.
double equivalent_contact(double curvature, double contact)
{
  const double hollow = std::max(0.0, curvature - contact);
  return contact + hollow * hollow;
}

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

double PressureShape::work(double flatness)
{
  return between(0.3, 8 / (3 * M_PI * M_PI), flatness);
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
    : material_(material), ratios_(MaterialRatios::of(material))
{
  const ElasticSphere sphere = atlas.elastic(material.poisson_ratio);
  elastic_ = sphere.fit.correction;
  finite_body_ = 0.5 * elastic_.c1;
  solver_error_ = sphere.solver_error;
  if (material.yields()) make_twins(atlas);
}

PairBody::PairBody(const Atlas& atlas, const LawMaterial& material, FlowCurve flow, const Curve& own)
    : material_(material), ratios_(MaterialRatios::of(material)), flow_(std::move(flow))
{
  departure_ = Departure::between(own, shape(atlas, ratios_.stiffness));
  make_twins(atlas);
}

/// The law of the body with another stiffness, of the same yield stress.
LawShape PairBody::shape(const Atlas& atlas, double stiffness) const
{
  const double nu = ratios_.poisson_ratio;
  if (!flow_) return atlas.shape({stiffness, nu, ratios_.hardening});
  LawShape shape = stand_in(atlas, stiffness, nu, of_twin(flow_, stiffness / ratios_.stiffness));
  departure_.add_to(shape);
  return shape;
}

void PairBody::make_twins(const Atlas& atlas)
{
  const MaterialRatios& own = ratios_;
  solver_error_ = atlas.bounds_near(own.stiffness).solver;
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

/// An equivalent sphere from its slow law on a rigid flat, up to the overlap `depth`.
PairBody::Twin PairBody::tabulated(const ContactLaw& law, const ElasticCorrection& elastic,
                                   double stiffness, double onset, double depth)
{
  Twin t;
  t.log_stiffness = std::log(stiffness);
  t.log_end = std::log(depth / onset);
  for (int node = 0; node < overlap_nodes; ++node) {
    const double x = onset * std::exp(log_overlap_of(node, t.log_end));
    const Reversal top = law.reversal(x);
    const double force = 4.0 / 3.0 * top.top(), radius = law.radius(x);
    const bool is_elastic = node <= elastic_intervals;
    const UnloadingShape unloading = is_elastic ? elastic.unloading(std::pow(x, 0.25)) : top.shape();
    t.log_contact.push_back(std::log(radius));
    t.log_pressure.push_back(std::log(force * stiffness / (M_PI * radius * radius)));
    t.log_overlap.push_back(std::log(x));
    // -ln of the fraction that is recovered
    t.log_lost.push_back(is_elastic ? 0.0 : -std::log1p(-top.residual() / x));
    t.unloading_work.push_back(unloading.work());
    t.unloading.push_back({unloading.hertz_share});
    const std::array<double, 3> k = law.unloading_radius(x);
    for (std::size_t j = 0; j < k.size(); ++j)
      t.unloading.back()[j + 1] = k[j] - elastic.unloading_radius(std::pow(x, 0.25), static_cast<double>(j) / 3);
  }
  return t;
}

PairBody::Twin PairBody::twin(const Atlas& atlas, double stiffness) const
{
  const LawShape own = shape(atlas, stiffness);
  return tabulated(ContactLaw(own), own.elastic, stiffness, own.onset, own.end);
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
  const double s = std::pow(x, 0.25), force = 4.0 / 3.0 * std::pow(x, 1.5) * elastic_.force_ratio(s);
  State state;
  state.pressure = material_.e_star() * share * force / (M_PI * alpha * alpha);
  state.recovered = share * x / alpha;
  state.returned = state.recovered * elastic_.unloading(s).work();
  state.log_yield_overlap = first_log_overlap;
  state.known = x <= Atlas::depth;
  return state;
}

PairBody::Mixed PairBody::twin_at(double curvature, double contact) const
{
  const double own = std::log(material_.e_star() / material_.yield_stress);
  const double wanted = own + std::log(curvature / equivalent_contact(curvature, contact));
  const double told = std::clamp(wanted, log_stiffnesses_.front(), log_stiffnesses_.back());
  const std::vector<double> weights = interpolation_weights(log_stiffnesses_, told);
  Mixed twin{std::exp(told - own), 0, {}, curvature / std::exp(told - own), told != wanted};
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
  const double alpha = twin.contact, node = place(twin, &Twin::log_contact, std::log(alpha));
  double log_end = 0;
  for (std::size_t k = 0; k < twin.weights.size(); ++k)
    log_end += twin.weights[k] * twins_[twin.first + k].log_end;

  State state;
  state.log_yield_overlap = log_overlap_of(node, log_end);
  // An equivalent sphere put in the place of one that is too stiff for the atlas is soft for lack of a body,
  // not of pressure.
  constexpr double widest_stand_in = 0.35;
  state.known = node < overlap_nodes && !(twin.is_clipped && alpha > std::max(contact, widest_stand_in)) &&
                (!flow_ || state.log_yield_overlap <= std::log(departure_.end()));
  state.pressure = material_.yield_stress * std::exp(value(twin, &Twin::log_pressure, node));
  const double overlap = twin.share * std::exp(value(twin, &Twin::log_overlap, node)) / alpha;
  const double kept = std::exp(-std::max(0.0, value(twin, &Twin::log_lost, node)));
  state.residual = overlap * (1 - kept);
  state.recovered = overlap * kept;
  state.returned = state.recovered * value(twin, &Twin::unloading_work, node);
  // the finite sphere has alpha, its equivalent one alpha'
  const double less = finite_body_ * M_PI * state.pressure / material_.e_star() * (contact - alpha);
  state.recovered -= less, state.returned -= 0.5 * less;
  state.flatness = PressureShape::flatness_of(state.residual / state.recovered);
  return state;
}

PairBody::Unloading PairBody::unloading(double curvature, double contact, double residual_over_recovered) const
{
  if (!yields()) return {elastic_.unloading(std::pow(elastic_overlap(std::max(contact, flat)), 0.25)).hertz_share};
  const Mixed twin = twin_at(curvature, contact);
  const double node = place(twin, &Twin::log_lost, std::log1p(residual_over_recovered));
  const auto low = static_cast<std::size_t>(std::clamp(static_cast<int>(node), 0, overlap_nodes - 2));
  Unloading mixed{};
  for (std::size_t k = 0; k < twin.weights.size(); ++k) {
    const std::vector<Unloading>& of_twin = twins_[twin.first + k].unloading;
    for (std::size_t j = 0; j < mixed.size(); ++j)
      mixed[j] += twin.weights[k] * between(of_twin[low][j], of_twin[low + 1][j], node - static_cast<double>(low));
  }
  return mixed;
}

}  // namespace granulaw
