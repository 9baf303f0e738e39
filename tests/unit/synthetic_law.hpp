#pragma once

#include <cmath>
#include <functional>

#include "base/scales.hpp"
#include "law/law.hpp"

namespace granulaw::testing {

/// Samples a table from functions of s; slopes by central differences good to 1e-9.
inline ContactCurve::Table sample_table(double s_end, double onset, int count,
                                        const std::function<double(double)>& force_ratio,
                                        const std::function<double(double)>& residual_ratio,
                                        const std::function<double(double)>& exponent,
                                        const std::function<double(double)>& hertz_share,
                                        const std::function<double(double)>& radius_ratio)
{
  ContactCurve::Table table;
  table.s_end = s_end;
  table.onset = onset;
  const auto fill = [&](const std::function<double(double)>& f, std::vector<double>& value,
                        std::vector<double>& slope) {
    for (int k = 0; k < count; ++k) {
      const double s = s_end * k / (count - 1), step = 1e-5 * s_end;
      value.push_back(f(s));
      slope.push_back((8.0 * (f(s + step) - f(s - step)) - (f(s + 2 * step) - f(s - 2 * step))) /
                      (12.0 * step));
    }
  };
  fill(force_ratio, table.force_ratio, table.force_ratio_slope);
  fill(residual_ratio, table.residual_ratio, table.residual_ratio_slope);
  fill(exponent, table.exponent, table.exponent_slope);
  fill(hertz_share, table.hertz_share, table.hertz_share_slope);
  fill(radius_ratio, table.radius_ratio, table.radius_ratio_slope);
  return table;
}

/// A law with the features of a real one and nothing measured: past the onset, with q = ln(s/s_onset),
/// F/F_Hertz falls as 1/sqrt(1 + b q^2 ...) towards F ~ x, the residual grows to `depth`, n and A stay near
/// those of the elastic sphere.
struct SyntheticLaw
{
  double onset = 6.4e-4;  ///< of E*/Y = 100
  double x_end = 0.1;
  double force_reduction = 1.6;  ///< ln(F/F_elastic) = -force reduction q^2/(1 + q)
  double depth = 1.1;            ///< residual ratio = 0.9999 (1 - exp(-depth q^2))
  double bend = 0.05;  ///< exponent = the elastic one + bend q^2/(1 + q^2); Hertz share: less bend of it

  static constexpr double finite_sphere = 0.9;  ///< F_elastic = F_Hertz (1 + finite_sphere sqrt(x))

  /// Unloading along F_elastic itself (plus 1e-9: an admissible law must not return more than it took, not
  /// even by rounding).
  static UnloadingShape elastic_unloading(double s)
  {
    const double c = finite_sphere * s * s;
    return {(1.5 + 2 * c) / (1 + c) + 1e-9, 1 / (1 + c)};
  }

  UnloadingShape unloading(double s) const
  {
    const double q = past(s, onset), more = bend * q * q / (1 + q * q);
    const UnloadingShape elastic = elastic_unloading(s);
    return {elastic.exponent + more, elastic.hertz_share - more};
  }
  double residual_ratio(double s) const
  {
    const double q = past(s, onset);
    return 0.9999 * (1 - std::exp(-depth * q * q));  // a law may not come nearer to 1 than 1e-5
  }
  static double past(double s, double onset)
  {
    return std::max(0.0, std::log(std::max(s, 1e-12)) - 0.25 * std::log(onset));
  }
  ContactCurve::Table table(int count = 129) const
  {
    return sample_table(
        std::pow(x_end, 0.25), onset, count,
        [&](double s) {
          const double q = past(s, onset);
          return (1 + finite_sphere * s * s) * std::exp(-force_reduction * q * q / (1 + q));
        },
        [&](double s) { return residual_ratio(s); }, [&](double s) { return unloading(s).exponent; },
        [&](double s) { return unloading(s).hertz_share; },
        [&](double s) {
          const double q = past(s, onset);
          return 1 + 0.3 * q * q / (1 + q);
        });
  }
  ContactCurve curve(int count = 129) const { return ContactCurve(table(count), "synthetic"); }

  /// A velocity axis with the features of a real one: the impact's force exceeds the slow press's early in
  /// the contact, crosses it at xi = 0.65 and ends a little below; it leaves a little less residual, rebounds
  /// a little more steeply, and all that grows in proportion to X.
  VelocityAxis::Table axis(int levels = 8, int nodes = 25) const
  {
    VelocityAxis::Table table;
    table.speed_end = 0.066;  // 17 m/s of law()'s powder on a wall
    table.ratio_end = 1.5;
    table.levels = static_cast<std::size_t>(levels);
    table.first_levels = std::min<std::size_t>(3, table.levels);
    for (int j = 0; j <= 16; ++j) {
      const double r = j / 16.0;
      table.impact_overlap.push_back(x_end * r * (0.6 + 0.4 * r));
      table.impact_overlap_slope.push_back(x_end * (0.6 + 0.8 * r) / table.speed_end);
    }
    const ImpactLevels scale = ImpactLevels::from_standstill(table.levels, table.first_levels, 1.0);
    for (int k = 1; k <= levels; ++k)
      for (int l = 0; l < nodes; ++l) {
        const double part = scale.overlap(k), xi = table.ratio_end * l / (nodes - 1);
        const double rest = 1 - xi / table.ratio_end, cross = 1 - xi / 0.65, bottom = 1 + xi * xi;
        table.force_correction.push_back(0.5 * part * rest * rest * cross);
        table.force_correction_slope.push_back(0.5 * part * rest *
                                               (-2 / table.ratio_end * cross - rest / 0.65));
        table.residual_correction.push_back(-0.002 * part * xi * xi / bottom);
        table.residual_correction_slope.push_back(-0.004 * part * xi / (bottom * bottom));
        table.exponent_correction.push_back(0.1 * part * xi * xi / bottom);
        table.exponent_correction_slope.push_back(0.2 * part * xi / (bottom * bottom));
      }
    return table;
  }
  /// The same for a rate-dependent material.
  VelocityAxis::Table rate_axis(double reference_radius, int levels = 8, int nodes = 25) const
  {
    VelocityAxis::Table table = axis(levels, nodes);
    table.first_levels = 1;
    table.kind = VelocityAxis::Kind::rate;
    table.reference_radius = reference_radius;
    table.speed_begin = table.speed_end / 40;
    return table;
  }
  ContactCurve curve_with_axis(int count = 129) const { return {table(count), axis(), "synthetic"}; }

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
  Law whole_law(int count = 129, int levels = 8, int nodes = 25) const
  {
    Law result = law_with_axis();
    BodyLaw& powder = result.bodies.at("powder");
    powder.curve = ContactCurve(table(count), axis(levels, nodes), "synthetic");
    TwoBodyLaw& own = result.pair_laws["powder:glass"].emplace_back();
    own.law = powder;
    own.law.curve = ContactCurve(table(count), rate_axis(1e-3, levels, nodes), "synthetic");
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
    ContactCurve::Table t = sample_table(
        0.5, std::numeric_limits<double>::infinity(), 33, [](double s) { return 1 + 0.9 * s * s; },
        [](double) { return 0.0; }, [](double s) { return elastic_unloading(s).exponent; },
        [](double s) { return elastic_unloading(s).hertz_share; }, [](double) { return 1.0; });
    glass.curve = ContactCurve(t, "glass");
    law.bodies["glass"] = glass;
    law.pairs = {
        {"powder", "powder"}, {"powder", "glass"}, {"glass", "glass"}, {"powder", "wall"}, {"glass", "wall"}};
    law.provenance = {{"version", "0.1.0"}, {"git_hash", "abc"}, {"command", "mpm table x.toml"}};
    return law;
  }
};

}  // namespace granulaw::testing
