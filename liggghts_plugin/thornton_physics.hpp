#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "contact/thornton.hpp"
#include "liggghts_plugin/normal_physics.hpp"

namespace granulaw::plugin {

/// One pair of types under Thornton's law (1997), closed form. F(d/S)/S does the same work to S times the
/// overlap, and is softer by S^2.
///
/// The force is ThorntonPair's but for rounding, with all that does not change worked out. At the largest
/// overlap d_m beyond d_y it is F_m; below, F_m p^1.5 with p = 1 - (d_m - d)/(d_m - d_p). A contact keeps
/// 1/(d_m - d_p), the one number of this that takes a root and a division.
struct ThorntonContact : FormulaContact
{
  static constexpr std::size_t reversal_values = 2;  // R* d_m and 1/(d_m - d_p)

  ThorntonPair law{};  // in the deck's units, unstretched
  double per_stretch = 1.0;
  // Stretched. Over powers of R*: F = hertz sqrt(R* d) d, d_y, F_y, dF/dd beyond.
  double hertz = 0.0, onset = 0.0, onset_force = 0.0, plastic_slope = 0.0;
  double per_area = 0.0;  // (2 F_m + F_y) per_area: A of ThorntonPair, times (4/3 E* S^-2)^2

  ThorntonContact() = default;
  ThorntonContact(const ThorntonPair& pair, double stretch)
      : law(pair),
        per_stretch(1.0 / stretch),
        hertz(4.0 / 3.0 * pair.e_star * std::pow(per_stretch, 2.5)),
        onset(pair.yield_overlap(1.0) * stretch),
        onset_force(hertz * std::sqrt(onset) * onset),
        plastic_slope(M_PI * pair.yield_pressure * per_stretch * per_stretch)
  {
    const double softened = 4.0 / 3.0 * pair.e_star * per_stretch * per_stretch;
    per_area = softened * softened / (2.0 * M_PI * pair.yield_pressure * per_stretch);
  }

  double force(double r_eff, double delta, double delta_max, double, double* kept) const
  {
    if (delta_max <= onset * r_eff || delta >= delta_max) return loading(r_eff, delta, 0.0);
    const double top = force_at_top(r_eff, delta_max), key = r_eff * delta_max;
    if (kept[0] != key) [[unlikely]] {
      kept[0] = key;
      kept[1] = per_elastic(r_eff, top);
    }
    const double part = std::max(1.0 - (delta_max - delta) * kept[1], 0.0);
    return top * part * std::sqrt(part);
  }
  double loading(double r_eff, double delta, double) const
  {
    return delta <= onset * r_eff ? hertz * std::sqrt(r_eff * delta) * delta : force_at_top(r_eff, delta);
  }
  double grow(double r_eff, double from, double to, double impact_overlap, double* kept) const
  {
    if (to <= onset * r_eff) return 0.0;
    const double after = force_at_top(r_eff, to), per_after = per_elastic(r_eff, after);
    double spent = 0.0;
    if (from <= onset * r_eff) [[unlikely]]
      spent = dissipated(r_eff, from, to, impact_overlap);
    else {
      const double before = force_at_top(r_eff, from);
      const double per_before = kept[0] == r_eff * from ? kept[1] : per_elastic(r_eff, before);
      // what loads a contact beyond its yield is linear, what it gives back is 2/5 F_m (d_m - d_p)
      spent = 0.5 * (before + after) * (to - from) - 0.4 * (after / per_after - before / per_before);
    }
    kept[0] = r_eff * to;
    kept[1] = per_after;
    return spent;
  }
  double contact_radius(double r_eff, double delta, double delta_max, double) const
  {
    return law.evaluate(r_eff, per_stretch * delta, per_stretch * delta_max).contact_radius;
  }
  double yield_overlap() const { return law.yield_overlap(1.0) / per_stretch; }
  double pair_modulus() const { return law.e_star; }
  double dissipated(double r_eff, double from, double to, double) const
  {
    return law.dissipated(r_eff, per_stretch * to) - law.dissipated(r_eff, per_stretch * from);
  }
  double stored_energy(double r_eff, double delta, double delta_max, double impact_overlap) const;
  double stiffness(double r_eff, double delta, double impact_overlap) const;
  double stiffness_range() const { return FormulaContact::stiffness_range() / per_stretch; }

 private:
  /// N, at a largest overlap beyond first yield.
  double force_at_top(double r_eff, double delta_max) const
  {
    return onset_force * (r_eff * r_eff) + plastic_slope * r_eff * (delta_max - onset * r_eff);
  }
  /// 1/m: 1/(d_m - d_p) of a contact whose force at the largest overlap is `top`.
  double per_elastic(double r_eff, double top) const
  {
    return std::sqrt((2.0 * top + onset_force * (r_eff * r_eff)) * per_area) / top;
  }
};

/// Model `thornton`: yield stress of each type from `fix property/global yieldStress peratomtype`.
class ThorntonPhysics : public FormulaPhysics
{
 public:
  static constexpr const char* name = "thornton";
  static constexpr int id = 41;
  using Contact = ThorntonContact;

  void prepare(LAMMPS_NS::LAMMPS* lmp, PropertyRegistry& registry, const Setup& setup, const Types& types);
  Contact resolve(int i, int j, bool rigid, const std::string& where) const;
  PairInfo describe(const Contact& contact, const PairKey& key) const;

 private:
  std::vector<double> e_star_, yield_stress_;  // the deck's units, by type
  double stretch_ = 1.0;
};

static_assert(NormalPhysics<ThorntonPhysics>);

}  // namespace granulaw::plugin
