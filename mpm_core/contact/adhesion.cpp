#include "contact/adhesion.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <limits>

namespace granulaw {

PowerCubic PowerCubic::through(const std::array<double, 4>& y)
{
  return {{y[0], -5.5 * y[0] + 9.0 * y[1] - 4.5 * y[2] + y[3], 9.0 * y[0] - 22.5 * y[1] + 18.0 * y[2] - 4.5 * y[3],
           -4.5 * y[0] + 13.5 * y[1] - 13.5 * y[2] + 4.5 * y[3]}};
}

namespace {

using Nodes = std::array<double, 4>;
constexpr double share_of_node(std::size_t j) { return static_cast<double>(j) / 3.0; }  // v
/// Where elastic laws are read in place of v = 0: they are Hertz's there, to 1e-6.
constexpr double nearly_none = 1e-3;

/// a/a_m over v at the nodes.
Nodes radii(const Curve& curve, double depth, double radius)
{
  constexpr double least = 0.1;  // the end at v = 0 is extrapolated, and may lie below 0
  Nodes k{};
  const std::array<double, 3> stored = curve.unloading_radius(depth).k;
  for (std::size_t j = 0; j < 3; ++j) {
    const double v = std::max(share_of_node(j), nearly_none);
    k[j] = std::max(depth > curve.onset() ? stored[j] : curve.radius(v * v * depth) / (radius * v), least);
  }
  k[3] = 1.0;
  // A dent is smooth at its axis, or hollow: k does not rise from v = 0, where it is extrapolated
  if (std::isfinite(curve.onset())) k[0] = std::max(k[0], (9.0 * k[1] - 4.5 * k[2] + k[3]) / 5.5);
  return k;
}

}  // namespace

/// Makes the numbers of a dent.
struct DentMaker
{
  AdhesiveDent dent;

  void scale_stiffness(double force)
  {
    const double factor = force / dent.free_at(1.0);
    for (double& c : dent.h.c) c *= factor;
  }
  /// Stiffness 2 E* a (1 + K a/a_m), in these units 1.5 a (1 + K a/a_m), whose integral over the unloading is the force at full load:
  /// K is how much stiffer the finite body is. Where it would be negative, the stiffness is less by a factor. Returns dS/da over
  /// 1.5 at the nodes.
  Nodes set_stiffness(const Nodes& k, double radius, double force)
  {
    const auto with = [&](double stiffer) {
      Nodes y{};
      for (std::size_t j = 0; j < 4; ++j) y[j] = 1.5 * radius * k[j] * (1.0 + stiffer * share_of_node(j) * k[j]);
      dent.h = PowerCubic::through(y);
      return dent.free_at(1.0);
    };
    const double half_space = with(0.0), twice = with(1.0), stiffer = std::max((force - half_space) / (twice - half_space), 0.0);
    with(stiffer);
    scale_stiffness(force);
    Nodes rise{};
    for (std::size_t j = 0; j < 4; ++j) rise[j] = 1.0 + 2.0 * stiffer * share_of_node(j) * k[j];
    return rise;
  }
  /// The same of a body that never yields: its own stiffness.
  Nodes take_stiffness(const Curve& curve, double depth, const Nodes& k, double radius)
  {
    Nodes y{};
    for (std::size_t j = 0; j < 4; ++j) {
      const double v = std::max(share_of_node(j), nearly_none);
      y[j] = curve.loading(v * v * depth).stiffness / v;
    }
    dent.h = PowerCubic::through(y);
    scale_stiffness(curve.force(depth));
    const PowerCubic share = PowerCubic::through(k);
    Nodes rise{};
    for (std::size_t j = 0; j < 4; ++j) {
      const double v = share_of_node(j);
      rise[j] = (dent.h.at(v) + v * dent.h.slope(v)) / (1.5 * radius * (share.at(v) + v * share.slope(v)));
    }
    return rise;
  }

  /// The q at which the overlap is least: Newton's steps, kept between bounds.
  void find_snap()
  {
    double low = 0.0, high = 1.0, q = std::cbrt(0.25 * dent.s.c[0] * dent.per_span);
    if (!(dent.slope_at(1.0) > 0.0))
      q = 1.0;  // not even the whole edge is stable: the surfaces part where the straight line ends
    else
      for (int step = 0; step < 60; ++step) {
        const double v = q * q, slope = dent.slope_at(q);
        (slope > 0.0 ? high : low) = q;
        const double bend = 12.0 * dent.span * v - q * (6.0 * dent.s.slope(v) + 4.0 * v * (2.0 * dent.s.c[2] + 6.0 * dent.s.c[3] * v));
        double next = q - slope / bend;
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        if (std::abs(next - q) < 1e-14) break;
        q = next;
      }
    dent.q_snap = q, dent.x_snap = dent.overlap_at(q);
  }

  /// Integral of the attached force from the snap to x <= x_max - shift.
  double work_to(double x) const
  {
    if (dent.q_snap >= 1.0) return 0.0;
    double q = dent.first_q(x);
    for (int step = 0; step < 12 && dent.beyond_snap(x); ++step) q -= (dent.overlap_at(q) - x) / dent.slope_at(q);
    // Gauss and Legendre, nine points: the integrand is a polynomial of q
    constexpr std::array place{0.0, 0.3242534234038089, 0.6133714327005904, 0.8360311073266358, 0.9681602395076261};
    constexpr std::array weight{0.3302393550012598, 0.3123470770400029, 0.2606106964029354, 0.1806481606948574, 0.0812743883615744};
    const double half = 0.5 * (q - dent.q_snap), middle = 0.5 * (q + dent.q_snap);
    const auto at = [&](double p) { return dent.force_at(middle + half * p) * dent.slope_at(middle + half * p); };
    double sum = weight[0] * at(0.0);
    for (std::size_t j = 1; j < 5; ++j) sum += weight[j] * (at(place[j]) + at(-place[j]));
    return half * sum;
  }
  double free_work(double x) const
  {
    const double u = std::max((x - dent.x_r) * dent.per_span, 0.0), v = std::sqrt(u);
    const auto& h = dent.h.c;
    return 4.0 * dent.span * dent.span * u * u * v * (h[0] / 15.0 + v * (h[1] / 24.0 + v * (h[2] / 35.0 + v * (h[3] / 48.0))));
  }
};

AdhesiveDent AdhesiveDent::of(const Curve& curve, double depth, double W, double zone)
{
  DentMaker make;
  AdhesiveDent& dent = make.dent;
  const Reversal back = curve.reversal(depth);
  const double radius = curve.radius(depth);
  dent.x_max = depth, dent.per_span = back.per_span;
  dent.complete();
  const Nodes k = radii(curve, depth, radius);
  const Nodes rise = std::isfinite(curve.onset()) ? make.set_stiffness(k, radius, back.top()) : make.take_stiffness(curve, depth, k, radius);
  Nodes s{};
  for (std::size_t j = 0; j < 4; ++j) s[j] = std::sqrt(2.0 * M_PI * W * radius * k[j] / rise[j]);  // sqrt(2 w dA/dS)/q
  dent.s = PowerCubic::through(s);
  dent.complete();
  if (!(W > 0.0)) return dent;
  make.find_snap();
  if (!(zone > 0.0)) return dent;
  // The force is least where span q^3 is three times that of the snap, if s, k and h/(1 + K a/a_m) were the same
  const double v = std::min(std::cbrt(9.0) * dent.q_snap * dent.q_snap, 1.0), rise_of_range = range_rise(zone / (radius * v * PowerCubic::through(k).at(v)));
  for (std::size_t j = 0; j < 4; ++j) s[j] *= std::sqrt(1.0 + rise_of_range * (1.0 - share_of_node(j) * share_of_node(j)));
  dent.s = PowerCubic::through(s);
  dent.complete();
  make.find_snap();
  return dent;
}

double AdhesiveDent::energy(double x) const
{
  const DentMaker made{*this};
  const double line_end = x_max - shift, top = std::min(x, x_max);
  double work = made.work_to(std::min(top, line_end));
  if (top > line_end) {
    const double t = top - line_end;
    work += t * (free_at(1.0) - stiffness() * (shift - 0.5 * t));
  }
  return work - made.free_work(top);
}

namespace {

/// J, of energies in the curve's units.
double energy_unit(const Tabulated& law, double r_eff) { return law.force_scale * r_eff * r_eff * (r_eff * law.lambda); }

}  // namespace

void DentAdhesion::turn(const Tabulated& law, const ContactMotion& m, double depth, double* history, Ledger& ledger) const
{
  if (history[2] != depth) {
    const auto kept = dent_of(law, m.r_eff, depth).kept();
    std::copy(kept.begin(), kept.end(), history + 2);
  }
  if (history[0] != owing || !m.advances) return;
  const double energy = AdhesiveDent::of(history + 2).energy(depth);
  ledger[Mechanism::adhesion] += energy_unit(law, m.r_eff) * (history[1] - energy);
  history[0] = booked, history[1] = energy;
}

void DentAdhesion::attach(const Tabulated& law, double r_eff, double* history, Ledger& ledger) const
{
  const AdhesiveDent dent = history[2] == 0.0 ? dent_of(law, r_eff, first) : AdhesiveDent::of(history + 2);
  history[0] = booked, history[1] = dent.energy(dent.x_max);
  // surfaces that jump into contact gain no speed: the energy of the attraction there is lost
  ledger[Mechanism::adhesion] -= energy_unit(law, r_eff) * dent.energy(dent.x_max > first ? dent.x_r : 0.0);
}

double DentAdhesion::stored_energy(const Tabulated& law, double r_eff, double overlap, const double* normal_history, const double* history) const
{
  if (!holds(history)) return 0.0;
  if (history[0] == owing) return energy_unit(law, r_eff) * history[1];  // as booked: it is at its depth
  const double per_length = law.per_lambda / r_eff, depth = std::max(normal_history[0] * per_length, first);
  const AdhesiveDent dent = history[2] != depth ? dent_of(law, r_eff, depth) : AdhesiveDent::of(history + 2);
  return energy_unit(law, r_eff) * dent.energy(std::max(overlap * per_length, dent.x_snap));
}

double DentAdhesion::pull_off(const Tabulated& law, double r_eff, double depth) const
{
  if (!(length_of_w > 0.0)) return 0.0;
  const double x_max = std::max(depth * (law.per_lambda / r_eff), first);
  const AdhesiveDent dent = dent_of(law, r_eff, x_max);
  const Reversal back = law.curve->reversal(x_max);
  const auto pull = [&](double x) { return dent.free_force(x) - dent.force(x) - (x > 0.0 ? back.force(x) : 0.0); };
  // by sqrt(x - x_snap), in which the snap is smooth
  const double way = std::sqrt(std::max(x_max - dent.x_snap, 0.0));
  constexpr int pieces = 200;
  int best = 0;
  const auto at = [&](double piece) { return pull(dent.x_snap + std::pow(way * piece / pieces, 2)); };
  for (int k = 1; k <= pieces; ++k)
    if (at(k) > at(best)) best = k;
  double low = std::max(best - 1.0, 0.0), high = std::min(best + 1.0, 1.0 * pieces);
  for (int step = 0; step < 60; ++step) {  // golden section
    constexpr double share = 0.381966;
    const double a = low + share * (high - low), b = high - share * (high - low);
    (at(a) > at(b) ? high : low) = at(a) > at(b) ? b : a;
  }
  return law.force_scale * r_eff * r_eff * at(0.5 * (low + high));
}

AdhesionNumbers DentAdhesion::numbers(const Tabulated& law, double r_eff, double depth) const
{
  AdhesionNumbers now{.W = relative_work(r_eff), .range = length_of_range * law.mapping.length(law.scale.length)};
  const double R = r_eff * law.scale.length, w = now.W * law.mapping.e_star * law.mapping.length(R);
  now.tabor = std::cbrt(w * w * R) / (std::pow(law.mapping.e_star_pair(), 2.0 / 3.0) * now.range);
  const Curve& curve = *law.curve;
  const double x = depth * (law.per_lambda / r_eff);
  if (!(x >= curve.onset())) return now;
  const double a = curve.radius(x);
  const double relative_pressure = 4.0 / 3.0 * curve.force(x) / (M_PI * a * a);
  now.pressure = law.mapping.e_star * relative_pressure;
  now.S = 2.0 * w / (now.range * now.pressure);
  now.chi = now.W / (relative_pressure * relative_pressure * a);
  return now;
}

namespace {

[[gnu::format(printf, 1, 2)]] std::string sentence(const char* format, ...)
{
  char text[512];
  va_list values;
  va_start(values, format);
  std::vsnprintf(text, sizeof text, format, values);
  va_end(values);
  return text;
}

/// `undented`: contacts that did not yield are among them, which Tabor's number is about.
std::string fault_of(const AdhesionNumbers& n, bool undented)
{
  const double longest = n.range * n.tabor / AdhesionNumbers::least_tabor, shortest = n.range * n.S / AdhesionNumbers::largest_S;
  if (undented && n.tabor < AdhesionNumbers::least_tabor)
    return sentence("the adhesion range %.3g m is long against the elastic neck (Tabor number %.2g, at least 1): at most %.3g m here", n.range, n.tabor, longest);
  if (undented && n.S > AdhesionNumbers::largest_S && shortest > longest)
    return sentence("the attraction is %.2g of the contact pressure (at most 0.8), and no range is accepted: the bond is as strong as the material", n.S);
  if (n.S > AdhesionNumbers::largest_S)
    return sentence("the attraction over the contact pressure is %.2g (at most 0.8), where the bond tears the material: the least adhesion range is %.3g m here", n.S, shortest);
  if (n.chi > AdhesionNumbers::largest_chi)
    return sentence("chi = w E*/(p_m^2 a) is %.2g (at most 0.2): this much adhesion changes the plastic flow itself", n.chi);
  return {};
}

}  // namespace

std::string DentAdhesion::fault(const Tabulated& law, double r_eff, double depth) const
{
  if (!(length_of_w > 0.0)) return {};
  if (!law.curve->states_unloading_radius()) return "the law file has no contact radius of unloading, which adhesion takes: build it again with mpm table";
  const AdhesionNumbers n = numbers(law, r_eff, depth);
  return fault_of(n, n.S == 0.0);
}

std::string DentAdhesion::fault(const Tabulated& law, double r_eff) const
{
  if (std::string why = fault(law, r_eff, 0.0); !(length_of_w > 0.0) || !why.empty()) return why;
  AdhesionNumbers best = numbers(law, r_eff, 0.0);
  best.S = best.chi = law.curve->onset() < law.curve->end() ? std::numeric_limits<double>::infinity() : 0.0;
  const double end = law.curve->end();
  for (double x = 1.01 * first; x < end; x *= 1.1) {  // beyond the onset, of which rounding makes less
    const AdhesionNumbers now = numbers(law, r_eff, x * r_eff / law.per_lambda);
    best.S = std::min(best.S, now.S), best.chi = std::min(best.chi, now.chi);
  }
  return fault_of(best, true);
}

}  // namespace granulaw
