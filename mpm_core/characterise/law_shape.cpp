#include "characterise/law_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/interpolators/cardinal_cubic_b_spline.hpp>
#include <cmath>
#include <limits>

#include "base/error.hpp"

namespace granulaw {

namespace {

constexpr double rounding_spare = 5e-4;    // of the work
constexpr double target_spacing = 0.0045;  // of table nodes in s: about 128 nodes to x = 0.1

/// One function of a shape between its nodes, in q = ln(s/s_onset): the cubic spline through them.
class ShapeFunction
{
 public:
  enum class Kind {
    any,
    rising,  ///< never falls: nodes below an earlier one are raised to it, slopes limited where it would
             ///< swing
  };

  ShapeFunction(std::vector<double> values, double q_end, Kind kind = Kind::any)
      : values_(kind == Kind::rising ? raised(std::move(values)) : std::move(values)),
        spacing_(q_end / static_cast<double>(values_.size() - 1)),
        q_end_(q_end)
  {
    const boost::math::interpolators::cardinal_cubic_b_spline<double> spline(values_.begin(), values_.end(),
                                                                             0.0, spacing_, 0.0);
    for (std::size_t k = 0; k < values_.size(); ++k)
      slopes_.push_back(k ? spline.prime(spacing_ * static_cast<double>(k)) : 0.0);
    if (kind == Kind::rising) limit_slopes();
  }
  /// Beyond its end, where the last node of a table may lie, it goes on straight.
  double value(double q) const
  {
    if (q > q_end_) return values_.back() + (q - q_end_) * slopes_.back();
    return q > 0 ? at(q, false) : 0.0;
  }
  double slope(double q) const { return q > 0 ? at(std::min(q, q_end_), true) : 0.0; }

 private:
  static std::vector<double> raised(std::vector<double> values)
  {
    double most = 0;
    for (double& v : values) v = most = std::max(most, v);
    return values;
  }

  /// A cubic between two nodes rises if neither slope is negative or over three times the chord's (Fritsch
  /// and Carlson 1980, the sufficient square); slopes within that are left as they are.
  void limit_slopes()
  {
    for (double& slope : slopes_) slope = std::max(0.0, slope);
    for (std::size_t k = 0; k + 1 < values_.size(); ++k) {
      const double most = 3 * (values_[k + 1] - values_[k]) / spacing_;
      slopes_[k] = std::min(slopes_[k], most);
      slopes_[k + 1] = std::min(slopes_[k + 1], most);
    }
  }

  double at(double q, bool slope) const
  {
    const auto k = std::min(static_cast<std::size_t>(q / spacing_), values_.size() - 2);
    const double t = q / spacing_ - static_cast<double>(k), chord = values_[k + 1] - values_[k];
    const double first = spacing_ * slopes_[k], second = first + spacing_ * slopes_[k + 1] - 2 * chord;
    const double c2 = chord - first - second, c3 = second;
    if (slope) return (first + t * (2 * c2 + 3 * t * c3)) / spacing_;
    return values_[k] + t * (first + t * (c2 + t * c3));
  }

  std::vector<double> values_, slopes_;
  double spacing_, q_end_;
};

/// Nodes uniform in s, the onset on a node: everything is smooth on either side of it.
ContactCurve::Table empty_table(double s_onset, double x_end, std::vector<double>& nodes)
{
  const double wanted = std::pow(x_end, 0.25);
  double spacing = target_spacing;
  if (std::isfinite(s_onset) && s_onset < wanted)
    spacing = s_onset / std::max(4.0, std::round(s_onset / target_spacing));
  const auto intervals = static_cast<std::size_t>(std::ceil(wanted / spacing - 1e-9));
  for (std::size_t k = 0; k <= intervals; ++k) nodes.push_back(spacing * static_cast<double>(k));
  ContactCurve::Table table;
  table.s_end = nodes.back();
  return table;
}

/// n of an elastic body: F x/W - 1, which makes the work of F_m u^n the work of loading.
double elastic_exponent(const ElasticCorrection& e, double s)
{
  const double y = s * s;  // integral of x^1.5 (1 + c1 x^.5 + c2 x) = x^2.5 (1/2.5 + c1 x^.5/3 + c2 x/3.5)
  return e.force_ratio(s) / (0.4 + e.c1 * y / 3 + e.c2 * y * y / 3.5) - 1;
}

void add_to(std::vector<double>& sum, double weight, const std::vector<double>& values)
{
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weight * values[k];
}

}  // namespace

LawShape LawShape::zero()
{
  const std::vector<double> none(nodes, 0.0);
  LawShape shape{{}, none, none, none, none, {}};
  for (const double v : inertia_speeds)
    shape.inertia.push_back({v, 0, 0, 0, std::vector<double>(Inertia::shares, 0.0)});
  return shape;
}

void LawShape::add(double weight, const LawShape& other)
{
  elastic.c1 += weight * other.elastic.c1;
  elastic.c2 += weight * other.elastic.c2;
  elastic.d1 += weight * other.elastic.d1;
  for (auto member : {&LawShape::softening, &LawShape::widening, &LawShape::residual, &LawShape::dissipation})
    add_to(this->*member, weight, other.*member);
  for (std::size_t k = 0; k < inertia.size(); ++k) {
    inertia[k].reach += weight * other.inertia[k].reach;
    inertia[k].dissipation += weight * other.inertia[k].dissipation;
    inertia[k].residual += weight * other.inertia[k].residual;
    add_to(inertia[k].force, weight, other.inertia[k].force);
  }
}

LawShape LawShape::stretched(double share) const
{
  LawShape result = zero();
  result.elastic = elastic;
  for (auto member :
       {&LawShape::softening, &LawShape::widening, &LawShape::residual, &LawShape::dissipation}) {
    const ShapeFunction function(this->*member, 1.0);
    for (int k = 0; k < nodes; ++k)
      (result.*member)[static_cast<std::size_t>(k)] = function.value(std::min(1.0, share * k / (nodes - 1)));
  }
  return result;
}

void require_admissible(const ContactCurve& curve)
{
  for (int k = 1; k <= 1000; ++k) {
    const double x = std::pow(curve.table().s_end * k / 1000, 4);
    if (curve.loading(x).stiffness <= 0)
      fail("fit",
           fmt::format("the loading force does not rise at delta/R = {:.4g}: the runs are too coarse", x));
  }
  if (const double margin = curve.admissibility_margin(); margin < 0)
    fail("fit",
         fmt::format("the law would gain energy in a closed cycle (margin {:.3g}): the runs are too coarse",
                     margin));
}

double change_of_restitution(const LawShape& shape, double onset, double shape_end, const ContactCurve& curve)
{
  const double q_end = 0.25 * std::log(shape_end / onset);
  const ShapeFunction fitted(shape.dissipation, q_end);
  double most = 0;
  for (int k = 1; k < 1000; ++k) {
    const double q = q_end * k / 1000, x = onset * std::exp(4 * q);
    if (x >= curve.x_end()) break;
    const double e = std::sqrt(curve.work_unloading(x) / curve.work_loading(x));
    most = std::max(most, std::abs(e * std::exp(0.5 * fitted.value(q)) - 1));
  }
  return most;
}

double table_error(const LawShape& shape, double onset, double shape_end, const ContactCurve& curve)
{
  const double s_onset = std::pow(onset, 0.25);
  const ShapeFunction softening(shape.softening, 0.25 * std::log(shape_end / onset));
  double worst = 0;
  for (int k = 1; k < 2000; ++k) {
    const double s = curve.table().s_end * k / 2000, x = s * s * s * s;
    if (x > shape_end) break;
    const double q = s > s_onset ? std::log(s / s_onset) : 0.0;
    const double exact = std::pow(x, 1.5) * shape.elastic.force_ratio(s) * std::exp(-softening.value(q));
    worst = std::max(worst, std::abs(curve.loading(x).force / exact - 1));
  }
  return worst;
}

ContactCurve tabulate(const LawShape& shape, double onset, double shape_end, double x_end)
{
  const double s_onset = std::pow(onset, 0.25), q_end = 0.25 * std::log(shape_end / onset);
  const ShapeFunction softening(shape.softening, q_end), widening(shape.widening, q_end),
      residual(shape.residual, q_end, ShapeFunction::Kind::rising),
      dissipation(shape.dissipation, q_end, ShapeFunction::Kind::rising);
  std::vector<double> nodes;
  ContactCurve::Table table = empty_table(s_onset, x_end, nodes);
  table.onset = onset;
  const ElasticCorrection& el = shape.elastic;
  const double h = nodes[1];
  const auto at_onset = static_cast<std::size_t>(std::lround(s_onset / h));
  for (const double s : nodes) {
    const double q = s > s_onset ? std::log(s / s_onset) : 0.0;
    const double per_s = s > 0 ? 1.0 / s : 0.0;  // dq/ds; 0 below the onset anyway
    const double g = el.force_ratio(s) * std::exp(-softening.value(q));
    const double a = el.radius_ratio(s) * std::exp(widening.value(q));
    table.force_ratio.push_back(g);
    table.force_ratio_slope.push_back(
        g * (el.force_ratio_slope(s) / el.force_ratio(s) - softening.slope(q) * per_s));
    table.radius_ratio.push_back(a);
    table.radius_ratio_slope.push_back(
        a * (el.radius_ratio_slope(s) / el.radius_ratio(s) + widening.slope(q) * per_s));
    const double kept = std::exp(-residual.value(q));
    table.residual_ratio.push_back(std::max(0.0, 1 - kept));
    table.residual_ratio_slope.push_back(kept * residual.slope(q) * per_s);
  }
  // n needs the loading work of this very table: build it once with any exponent.
  const std::size_t count = nodes.size();
  table.exponent.assign(count, 1.5);
  table.exponent_slope.assign(count, 0.0);
  const ContactCurve loading(table, "fitted curve");
  // At its turn a contact unloads at least as stiffly as it loads, n >= x F'/F at the onset. A power of u
  // cannot have both the elastic curve's work and its slope, so it gives a little less back, e by up to 0.2
  // %, which fades with the overlap: faster than exp(-10 q) a contact turned later would give back more than
  // was put in. Where the force grows ever more slowly (a stiff shell) the work's own n is stiffer already.
  const ContactCurve::Loading first = loading.loading(onset);
  const double needed = 1.2 * std::log(loading.work_loading(onset) *
                                       (onset * first.stiffness / first.force + 1) / (first.force * onset));
  // There nothing would be left for the rounding of n between its nodes (6e-5 of F was seen): e 0.025 %
  // lower.
  const double spare = needed > 0 ? 0.0 : rounding_spare;
  const auto lost_at_onset = [&](double q) { return std::max(0.0, needed) * std::exp(-8 * q) + spare; };
  const auto yielded_exponent = [&](double s) {
    const double x = s * s * s * s, q = std::log(s / s_onset);
    const double returned = loading.work_loading(x) * std::exp(-dissipation.value(q) - lost_at_onset(q));
    return std::max(1.0, loading.loading(x).force * x * std::exp(-residual.value(q)) / returned - 1);
  };
  const auto elastic = [&](double s) { return elastic_exponent(el, s); };
  for (std::size_t k = 0; k < count; ++k) {
    const double s = nodes[k], step = 0.02 * h;
    // one-sided at the ends; the onset's own slope must be the one of the plastic side
    const auto fill = [&](const auto& n, bool begins, bool ends) {
      table.exponent[k] = n(s);
      table.exponent_slope[k] = begins ? (-3 * n(s) + 4 * n(s + step) - n(s + 2 * step)) / (2 * step)
                                : ends ? (3 * n(s) - 4 * n(s - step) + n(s - 2 * step)) / (2 * step)
                                       : (n(s + step) - n(s - step)) / (2 * step);
    };
    if (k < at_onset)
      fill(elastic, k == 0, false);
    else
      fill(yielded_exponent, k == at_onset, k + 1 == count);
  }
  // 1e-7: returned work must not exceed the work put in just past the onset, not even by rounding.
  for (double& n : table.exponent) n += 1e-7;
  ContactCurve curve(table, "fitted curve");
  require_admissible(curve);
  return curve;
}

ContactCurve::Table tabulate_elastic(const ElasticCorrection& elastic, double x_end)
{
  std::vector<double> nodes;
  ContactCurve::Table table = empty_table(std::numeric_limits<double>::infinity(), x_end, nodes);
  table.onset = std::numeric_limits<double>::infinity();
  for (const double s : nodes) {
    table.force_ratio.push_back(elastic.force_ratio(s));
    table.force_ratio_slope.push_back(elastic.force_ratio_slope(s));
    table.radius_ratio.push_back(elastic.radius_ratio(s));
    table.radius_ratio_slope.push_back(elastic.radius_ratio_slope(s));
    table.exponent.push_back(elastic_exponent(elastic, s));
  }
  table.residual_ratio.assign(nodes.size(), 0.0);
  table.residual_ratio_slope = table.residual_ratio;
  table.exponent_slope.assign(nodes.size(), 0.0);
  return table;
}

}  // namespace granulaw
