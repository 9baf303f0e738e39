#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "law/spline.hpp"
#include "contact/unloading.hpp"

namespace granulaw {

/// F/F_Hertz = 1 + c1 sqrt(x) + c2 x + c3 x^1.5 and a/a_Hertz = 1 + d1 sqrt(x) of the elastic body: the
/// finite sphere. c3 is that of a law without yield, which goes on elastically to its end; 0 where yield
/// comes first.
struct ElasticCorrection
{
  double c1 = 0, c2 = 0, d1 = 0, c3 = 0;
  /// Measured factor for a body of several materials, whose stiffness changes where the contact is as wide as
  /// a layer is thick: ln of the force as computed over that of the terms, by s. Null: the terms alone.
  std::shared_ptr<const Spline> measured{};

  double force_ratio(double s) const { return terms(s) * beside_terms(s); }
  double force_ratio_slope(double s) const
  {
    const double of_terms = s * (2 * c1 + s * s * (4 * c2 + s * s * 6 * c3));
    return measured ? beside_terms(s) * (of_terms + terms(s) * measured->slope(s)) : of_terms;
  }
  double radius_ratio(double s) const { return 1 + d1 * s * s; }
  double radius_ratio_slope(double s) const { return 2 * d1 * s; }
  /// k of UnloadingRadius from s at sqrt(u) = `root`.
  double unloading_radius(double s, double root) const
  {
    return (1 + d1 * s * s * root) / radius_ratio(s);
  }
  /// this += weight * other, of which neither has a measured part.
  void add(double weight, const ElasticCorrection& other);
  /// Unloading from s along the elastic curve itself (c3 = 0): x^1.5 (1 + c1 sqrt(x) + c2 x).
  UnloadingShape unloading(double s) const
  {
    const double a = 1 / force_ratio(s), b = a * c1 * s * s, c = 1 - a - b;
    return {1.5 * a + 2 * b + 2.5 * c, a};
  }

 private:
  double terms(double s) const { return 1 + s * s * (c1 + s * s * (c2 + s * s * c3)); }
  double beside_terms(double s) const { return measured ? std::exp(measured->value(s)) : 1.0; }
};

/// An elastic correction fitted to presses, and the largest relative deviation of the force.
struct ElasticFit
{
  ElasticCorrection correction;
  double error = 0;
};

/// The law of a yielding body in the coordinates in which materials resemble each other, its master curve:
/// runs are fitted to it, the atlas keeps and interpolates it, a Curve is tabulated from it.
///
/// Nodes uniform in u = ln(x/onset)/ln(end/onset), u = 0..1, x the overlap/R. Each function is 0 with zero slope
/// at the onset:
///     force_reduction  -ln(F_L/F_elastic)       residual     -ln(1 - delta_r/delta_m)
///     widening         ln(a/a_elastic)         dissipation  -ln(W_u/W_L) = -2 ln e
///     hertz_share      A - A_elastic of the unloading's shape
///     radius_0, _1, _2 k - k_elastic of UnloadingRadius, each
/// Differences and means of shapes are shapes again: that is how they are interpolated between materials.
struct LawShape
{
  static constexpr int nodes = 49;

  /// The change by an impact at speed v = sqrt(rho V^2/Y), against the slow press to the same overlap.
  struct VelocityEffect
  {
    static constexpr int shares = 12;  ///< xi = x/X = 0, 1/11, ..., 1

    double speed = 0;           ///< v
    double log_overlap = 0;     ///< ln(X/v), X the overlap/R reached
    double dissipation = 0;     ///< -ln(W_u/W_L) less that of the press
    double residual = 0;        ///< -ln(1 - delta_r/delta_m) less that of the press
    std::vector<double> force;  ///< ln(F_impact/F_press) at the fractions
  };

  ElasticCorrection elastic;
  std::vector<double> force_reduction, widening, residual, dissipation, hertz_share, radius_0, radius_1, radius_2;
  static constexpr std::size_t function_count = 8, first_radius = 5;
  static const std::array<std::vector<double> LawShape::*, function_count> functions;  ///< these
  std::vector<VelocityEffect> velocity_effects;                           ///< ascending speed
  double onset = 0, end = 0;  ///< overlap/R of first yield; where the functions end

  /// Overlap/R of a node.
  double overlap(std::size_t node) const
  {
    return onset * std::exp(std::log(end / onset) * static_cast<double>(node) / (nodes - 1));
  }
  /// One function by q = ln(s/s_onset), s = x^(1/4).
  Spline by_q(std::vector<double> LawShape::*function) const
  {
    return Spline::through(this->*function, q(end));
  }
  double q(double x) const { return 0.25 * std::log(x / onset); }

  /// Loading is the elastic body, force reduction and widening; impacts are the effects of inertia.
  enum class Part { all, loading, unloading, impacts };
  /// this += weight * other, node by node, whose speeds are the same; or a part of it. Onset and end stay.
  void add(double weight, const LawShape& other, Part part = Part::all);
  /// The same functions of x/onset between other ends. Beyond its own end each keeps its last value; inertia is
  /// dropped.
  LawShape at_range(double other_onset, double other_end) const;
  /// Law shape of a body with the same skin, from that of a sphere with its own elastic correction; the body
  /// differs elastically further below. A contact small against the skin adds to its overlap x' the approach
  /// of the rest of the body under its force F, x = x' + C F, C by the two corrections' c1. So its losses are
  /// those of the sphere at x'. Beyond `known`, where the sphere's law ends, the last value is kept. Inertia
  /// is dropped.
  LawShape as_skin_of(const ElasticCorrection& body, double known) const;
  /// All zero at all impact_speeds, ready for add().
  static LawShape zero(double onset = 0, double end = 0);
};

/// Speeds sqrt(I) at which the atlas holds the effect of inertia.
inline constexpr double impact_speeds[] = {0.005, 0.015, 0.03,  0.045, 0.06,  0.08, 0.1,
                                           0.125, 0.15,  0.175, 0.2,   0.225, 0.25, 0.3};

}  // namespace granulaw
