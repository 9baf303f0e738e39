#pragma once

#include <limits>

#include "law/thornton.hpp"
#include "liggghts_plugin/plastic_model.hpp"

namespace granulaw::plugin {

/// One pair of types under Thornton's law (1997), closed form.
struct ThorntonContact
{
  ThorntonPair law{};  // in the deck's units, unstretched
  double per_stretch = 1.0;

  static constexpr std::size_t reversal_values = 0;  // a closed form keeps nothing
  double force(double r_eff, double delta, double delta_max, double, double*) const
  {
    return per_stretch * law.evaluate(r_eff, per_stretch * delta, per_stretch * delta_max).force;
  }
  /// Of the real, unstretched contact.
  double contact_radius(double r_eff, double delta, double delta_max, double) const
  {
    return law.evaluate(r_eff, per_stretch * delta, per_stretch * delta_max).contact_radius;
  }
  /// Over R*, stretched.
  double yield_overlap() const { return law.yield_overlap(1.0) / per_stretch; }
  /// E* of the pair.
  double pair_modulus() const { return law.e_star; }
  static bool needs_mass() { return false; }
  /// Spent on plastic strain while the largest overlap grew from `from` to `to`.
  double dissipated(double r_eff, double from, double to, double) const
  {
    return law.dissipated(r_eff, per_stretch * to) - law.dissipated(r_eff, per_stretch * from);
  }
  double max_speed(double, double) const { return std::numeric_limits<double>::infinity(); }
  static double min_speed(double, double) { return 0.0; }
  double largest_overlap() const
  {
    return std::numeric_limits<double>::max();
  }                                                        // times R* stays finite or inf
  double damage_number_per_speed2() const { return 0.0; }  // the formula states no limit of velocity
};

/// Model `thornton`: yield stress of each type from `fix property/global yieldStress peratomtype`.
class ThorntonPhysics
{
 public:
  static constexpr const char* name = "thornton";
  static constexpr bool latches_impact = false;
  using Contact = ThorntonContact;

  void prepare(LAMMPS_NS::LAMMPS* lmp, PropertyRegistry& registry, const Setup& setup, const Types& types);
  Contact resolve(int i, int j, bool rigid, const std::string& where) const;
  void check_sizes(int, int, bool, const Contact&, const ParticleSizes&) const {}  // none is left out

 private:
  std::vector<double> e_star_, yield_stress_;  // the deck's units, by type
  double per_stretch_ = 1.0;
};

}  // namespace granulaw::plugin
