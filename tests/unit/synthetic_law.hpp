#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "law/law.hpp"

namespace granulaw::testing {

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

/// No closed cycle gains energy: the work lost never falls, without an impact and at every level of the axis.
inline bool loses_no_less_further_on(const Curve& curve)
{
  std::vector<double> latched = curve.examined_levels();
  latched.push_back(0);
  for (const double at : latched) {
    double before = 0;
    for (double x = 0.9 * curve.onset(); x < 1.05 * curve.end(); x *= 1.003) {
      const double lost = curve.lost(x, at);
      if (!(lost >= before - 1e-12 * curve.work(x))) return false;  // rounding
      before = lost;
    }
  }
  return true;
}

/// A law with the features of a real one and nothing measured: past the onset, with q = ln(s/s_onset),
/// F/F_Hertz falls as 1/sqrt(1 + b q^2 ...) towards F ~ x, the residual grows to `depth`, n and A stay near
/// those of the elastic sphere.
struct SyntheticLaw
{
  double onset = 6.4e-4;  ///< of E*/Y = 100
  double end = 0.1;
  double force_reduction = 1.6;  ///< ln(F/F_elastic) = -force reduction q^2/(1 + q)
  double depth = 1.1;            ///< -ln kept = 2.9 depth q^2/(1 + q)
  double span_share = 0.9;       ///< ln span = span_share ln kept
  double bend = 0.05;            ///< Hertz share: less bend q^2/(1 + q^2)

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
    return t;
  }
  Curve curve() const { return Curve(table()); }

  /// A velocity axis with the features of a real one: the impact's force exceeds the slow press's early in
  /// the contact, crosses it at about two thirds and ends a little below; impacts lose a little more.
  AxisTable axis(int levels = 8, int nodes = 25) const
  {
    AxisTable t;
    t.speed_end = 0.245;
    t.share_end = 1.5;
    for (int j = 0; j <= 16; ++j) {
      const double r = j / 16.0;
      t.reach.add(end * r * (0.6 + 0.4 * r), end * (0.6 + 0.8 * r) / t.speed_end);
    }
    for (int k = 1; k <= levels; ++k) {
      const double part = static_cast<double>(k) / levels, latched = end * part;
      t.level.push_back(latched);
      t.kept.push_back(kept(latched) * (1 - 0.05 * part));
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

  /// law() with a velocity axis for the powder.
  Law law_with_axis() const
  {
    Law result = law();
    BodyLaw& powder = result.bodies.at("powder");
    powder.curve = curve_with_axis();
    powder.certificate.damage_number_max = 0.06;
    powder.certificate.axis_cost_force = 0.031;
    powder.certificate.axis_cost_restitution = 0.08;
    return result;
  }

  /// All that a file may hold: law_with_axis() and a law of its own for powder:glass, with a rate axis.
  Law whole_law(int levels = 8, int nodes = 25) const
  {
    Law result = law_with_axis();
    BodyLaw& powder = result.bodies.at("powder");
    powder.curve = Curve(table(), axis(levels, nodes));
    TwoBodyLaw& own = result.pair_laws["powder:glass"].emplace_back();
    own.law = powder;
    own.law.curve = Curve(table(), rate_axis(1e-3, levels, nodes));
    own.radius_ratio = 2;
    return result;
  }

  /// A law file's worth: one plastic material "powder" and an elastic one "glass", every pair.
  Law law() const
  {
    Law law;
    BodyLaw powder;
    powder.material = {"powder", 1500.0, 9.1e9, 0.3, 1e8, 0.0};
    powder.curve = curve();
    powder.certificate.damage_number_max = 0.002;
    law.bodies["powder"] = powder;
    BodyLaw glass;
    glass.material = {"glass", 2500.0, 70e9, 0.2, std::numeric_limits<double>::infinity(), 0.0};
    CurveTable t(std::numeric_limits<double>::infinity(), 0.0625);
    t.force =
        sampled(t.nodes(), [](double x) { return std::pow(x, 1.5) * (1 + finite_sphere * std::sqrt(x)); });
    t.radius = sampled(t.nodes(), [](double x) { return std::sqrt(x); });
    glass.curve = Curve(t);
    law.bodies["glass"] = glass;
    law.pairs = {
        {"powder", "powder"}, {"powder", "glass"}, {"glass", "glass"}, {"powder", "wall"}, {"glass", "wall"}};
    law.provenance = {{"version", "0.1.0"}, {"git_hash", "abc"}, {"command", "mpm table x.toml"}};
    return law;
  }
};

}  // namespace granulaw::testing
