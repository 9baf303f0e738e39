#pragma once

#include <string>
#include <vector>

#include "law/thornton.hpp"
#include "liggghts_plugin/normal_physics.hpp"

namespace granulaw::plugin {

/// One pair of types under Thornton's law (1997), closed form. F(d/S)/S does the same work to S times the
/// overlap, and is softer by S^2.
struct ThorntonContact : FormulaContact
{
  ThorntonPair law{};  // in the deck's units, unstretched
  double per_stretch = 1.0;

  double force(double r_eff, double delta, double delta_max, double, double*) const
  {
    return per_stretch * law.evaluate(r_eff, per_stretch * delta, per_stretch * delta_max).force;
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
  double per_stretch_ = 1.0;
};

static_assert(NormalPhysics<ThorntonPhysics>);

}  // namespace granulaw::plugin
