#pragma once

#include <limits>

#include "law/thornton.hpp"
#include "liggghts_plugin/plastic_model.hpp"

namespace granulaw::plugin {

/// One pair of types under Thornton's law (1997), closed form.
struct ThorntonContact
{
  ThorntonPair law{};

  double force(double r_eff, double delta, double delta_max, double) const
  {
    return law.evaluate(r_eff, delta, delta_max).force;
  }
  /// J, spent on plastic strain up to the largest overlap delta_max (m).
  double dissipated(double r_eff, double delta_max) const;
  double dissipated(double r_eff, double from, double to, double) const
  {
    return dissipated(r_eff, to) - dissipated(r_eff, from);
  }
  double max_speed(double, double) const { return std::numeric_limits<double>::infinity(); }
  double largest_overlap() const
  {
    return std::numeric_limits<double>::max();
  }                                                  // times R* stays finite or inf
  double inertia_per_speed2() const { return 0.0; }  // the formula states no limit of velocity
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

 private:
  std::vector<double> e_star_, yield_stress_;  // Pa, by type
};

}  // namespace granulaw::plugin
