#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "contact/curve.hpp"

namespace granulaw::tests {

/// A column of f at these x; slopes by central differences good to 1e-9.
inline HermiteColumn sampled(const std::vector<double>& nodes, const std::function<double(double)>& f)
{
  HermiteColumn column;
  for (const double x : nodes) {
    const double h = 1e-4 * x;
    column.add(f(x), (8.0 * (f(x + h) - f(x - h)) - (f(x + 2 * h) - f(x - 2 * h))) / (12.0 * h));
  }
  return column;
}

/// A law with the features of a real one and nothing measured: past the onset, with q = ln(s/s_onset),
/// F/F_Hertz falls as 1/sqrt(1 + b q^2 ...) towards F ~ x, the residual grows to `depth`, n and A stay near
/// those of the elastic sphere.
struct SyntheticTables
{
  double onset = 6.4e-4;  ///< of E*/Y = 100
  double end = 0.1;
  double force_reduction = 1.6;  ///< ln(F/F_elastic) = -force reduction q^2/(1 + q)
  double depth = 1.1;            ///< -ln kept = 2.9 depth q^2/(1 + q)
  double span_share = 0.9;       ///< ln span = span_share ln kept
  double bend = 0.05;            ///< Hertz coefficient: less bend q^2/(1 + q^2)
  double speed_end = 0.245;      ///< of the velocity axis
  double impact_loss = 0.05;     ///< share of `kept` that the fastest impact loses beyond the slow press

  static constexpr double finite_sphere = 0.9;  ///< F_elastic = F_Hertz (1 + finite_sphere sqrt(x))

  static double past(double x, double onset)
  {
    return std::max(0.0, 0.25 * (std::log(std::max(x, 1e-48)) - std::log(onset)));
  }
  double force(double x) const
  {
    const double q = past(x, onset);
    return std::pow(x, 1.5) * (1 + finite_sphere * std::sqrt(x)) *
           std::exp(-force_reduction * q * q / (1 + q));
  }
  double radius(double x) const
  {
    const double q = past(x, onset);
    return std::sqrt(x) * (1 + 0.3 * q * q / (1 + q));
  }
  double kept(double x) const
  {
    const double q = past(x, onset);
    return std::exp(-2.9 * depth * q * q / (1 + q));
  }
  double span(double x) const { return std::pow(kept(x), span_share); }
  double hertz_share(double x) const
  {
    const double q = past(x, onset);
    return 1 / (1 + finite_sphere * std::sqrt(x)) - bend * q * q / (1 + q * q);
  }
  /// k of UnloadingRadius at sqrt(u) = j/3: towards a uniform pressure's.
  double unloading_radius(double x, std::size_t j) const
  {
    const double q = past(x, onset), v = static_cast<double>(j) / 3;
    return 1 + (std::sqrt(2 - v * v) - 1) * q * q / (1 + q * q);
  }
  CurveTable table() const
  {
    CurveTable t(onset, end);
    const std::vector<double> nodes = t.nodes(), yielding = t.yielding_nodes();
    t.force = sampled(nodes, [&](double x) { return force(x); });
    t.radius = sampled(nodes, [&](double x) { return radius(x); });
    t.kept = sampled(yielding, [&](double x) { return kept(x); });
    t.span = sampled(yielding, [&](double x) { return span(x); });
    t.hertz_share = sampled(yielding, [&](double x) { return hertz_share(x); });
    make_fall(t.kept, yielding), make_fall(t.span, yielding);
    for (const double x : yielding)
      t.unloading_radius.push_back({unloading_radius(x, 0), unloading_radius(x, 1), unloading_radius(x, 2)});
    return t;
  }
  Curve curve() const { return Curve(table()); }

  /// A velocity axis with the features of a real one: the impact's force exceeds the slow press's early in
  /// the contact, crosses it at about two thirds and ends a little below; impacts lose a little more.
  AxisTable axis(int levels = 8, int nodes = 25) const
  {
    AxisTable t;
    t.speed_end = speed_end;
    t.share_end = 1.5;
    for (int j = 0; j <= 16; ++j) {
      const double r = j / 16.0;
      t.reach.add(end * r * (0.6 + 0.4 * r), end * (0.6 + 0.8 * r) / t.speed_end);
    }
    for (int k = 1; k <= levels; ++k) {
      const double root = static_cast<double>(k) / levels, part = root * root, latched = end * part;
      t.level.push_back(latched);
      t.kept.push_back(kept(latched) * (1 - impact_loss * part));
      t.span.push_back(span(latched) * (1 - 0.01 * part));
      for (int l = 0; l < nodes; ++l) {
        const double xi = t.share_end * l / (nodes - 1), rest = 1 - xi / t.share_end, cross = 1 - xi / 0.65;
        t.force.add(0.5 * part * rest * rest * cross,
                    0.5 * part * rest * (-2 / t.share_end * cross - rest / 0.65));
      }
      t.force.value.back() = t.force.slope.back() = 0;
    }
    return t;
  }
  /// The same for a rate-dependent material.
  AxisTable rate_axis(double reference_radius, int levels = 8, int nodes = 25) const
  {
    AxisTable t = axis(levels, nodes);
    t.by = AxisTable::By::rate;
    t.reference_radius = reference_radius;
    t.speed_begin = t.speed_end / 40;
    return t;
  }
  Curve curve_with_axis() const { return Curve(table(), axis()); }

  /// Table of a body that never yields.
  static Curve elastic()
  {
    CurveTable t(std::numeric_limits<double>::infinity(), 0.0625);
    t.force =
        sampled(t.nodes(), [](double x) { return std::pow(x, 1.5) * (1 + finite_sphere * std::sqrt(x)); });
    t.radius = sampled(t.nodes(), [](double x) { return std::sqrt(x); });
    return Curve(t);
  }
};

}  // namespace granulaw::tests
