#pragma once

#include <algorithm>
#include <cmath>

#include "law/law.hpp"
#include "liggghts_plugin/plastic_model.hpp"

namespace granulaw::plugin {

/// One pair of types under a tabulated law: PairLaw with everything that does not change worked out.
struct MpmContact
{
  const HotTable* table = nullptr;
  double per_lambda = 0;   // lambda of PairMapping
  double force_scale = 0;  // Hertz force at x = 1 over R*^2, Pa
  double inertia = 0;      // I over (relative speed)^2, s^2/m^2

  MpmContact() = default;
  MpmContact(const PairLaw& law, const HotTable& hot_table)
      : table(&hot_table),
        per_lambda(1.0 / law.mapping.length(1.0)),
        force_scale(law.mapping.force(1.0)),
        // the yielding body's share of the approach is V/sqrt(lambda): all on a rigid wall, half in a like
        // pair
        inertia(law.yielding->material.density / law.yielding->material.yield_stress * per_lambda)
  {
  }

  /// N, at overlap delta (m) of a contact whose largest overlap so far is delta_max (m).
  double force(double r_eff, double delta, double delta_max) const
  {
    const double per_length = per_lambda / r_eff;
    const double ratio = delta < delta_max ? delta / delta_max : 1.0;
    return force_scale * r_eff * r_eff * table->force(delta * per_length, delta_max * per_length, ratio);
  }
  /// J, of a contact whose largest overlap is delta_max.
  double dissipated(double r_eff, double delta_max) const
  {
    const double length = r_eff / per_lambda;
    return force_scale * r_eff * r_eff * length * table->dissipated(delta_max / length);
  }
  double largest_overlap() const { return table->curve().x_end() / per_lambda; }
  double inertia_per_speed2() const { return inertia; }
};

/// Model `mpm`: laws from a file, one material name for each atom type.
class MpmPhysics
{
 public:
  static constexpr const char* name = "mpm";
  using Contact = MpmContact;

  void prepare(LAMMPS_NS::LAMMPS* lmp, PropertyRegistry& registry, const Setup& setup, const Types& types);

  Contact resolve(int i, int j, bool rigid, const std::string& where) const
  {
    const std::string& a = setup_->options.materials[static_cast<std::size_t>(i - 1)];
    const std::string& b = setup_->options.materials[static_cast<std::size_t>(j - 1)];
    const std::string here = fmt::format("{}: types {} ({}) and {} ({}{}), law file {}", where, i, a, j,
                                         rigid ? "rigid wall, " : "", b, setup_->law->path);
    const PairLaw law = resolve_pair(setup_->law->law, a, rigid ? wall_name : b, here);
    return {law, setup_->law->tables.at(law.yielding->material.name)};
  }

 private:
  const Setup* setup_ = nullptr;
};

}  // namespace granulaw::plugin
