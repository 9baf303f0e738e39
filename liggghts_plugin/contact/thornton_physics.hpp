#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/scales.hpp"
#include "contact/thornton.hpp"
#include "liggghts_plugin/contact/normal_physics.hpp"
#include "liggghts_plugin/deck/options.hpp"

namespace granulaw::plugin {

/// p_y over Y: the word behind `yieldPressure`, or the customary factor.
double yield_pressure_of(const Options& options);

/// Model `thornton`: yield stress of each type from `fix property/global yieldStress peratomtype`.
class ThorntonPhysics : public FormulaPhysics
{
 public:
  static constexpr const char* name = "thornton";
  static constexpr int id = 41;
  static constexpr std::array keywords{Keyword{.name = "yieldPressure", .least = 1.0, .most = 3.5}};
  using Contact = Thornton;

  void prepare(LAMMPS_NS::LAMMPS* lmp, PropertyRegistry& registry, const Setup& setup, const Types& types);
  Contact resolve(int i, int j, bool rigid, const std::string& where) const;
  PairInfo describe(const Contact& contact, const PairKey& key) const;

 private:
  std::vector<double> e_star_, yield_stress_;  // the deck's units, by type
  double stretch_ = 1.0, factor_ = customary_yield_pressure;
};

static_assert(NormalPhysics<ThorntonPhysics>);

}  // namespace granulaw::plugin
