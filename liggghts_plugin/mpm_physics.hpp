#pragma once

#include <algorithm>
#include <cmath>

#include "law/law.hpp"
#include "liggghts_plugin/plastic_model.hpp"

namespace granulaw::plugin {

/// One pair of types under a tabulated law.
struct MpmContact
{
  PairLaw law;
  const DissipationTable* dissipation = nullptr;

  ContactForce evaluate(double r_eff, double delta, double delta_max) const
  {
    return law.evaluate(r_eff, delta, delta_max);
  }
  /// J, of a contact whose largest overlap is delta_max.
  double dissipated(double r_eff, double delta_max) const
  {
    const double length = law.mapping.length(r_eff), x = delta_max / length;
    return x <= law.curve->onset() ? 0.0 : law.mapping.force(r_eff) * length * (*dissipation)(x);
  }
  double largest_overlap() const { return law.max_overlap(1.0); }
  /// The yielding body's share of the approach is V/sqrt(lambda): all of it on a rigid wall, half in a like pair.
  double inertia_per_speed2() const
  {
    const double lambda = law.mapping.length(1.0);
    return law.yielding->material.density / (law.yielding->material.yield_stress * lambda);
  }
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
    const std::string here =
        fmt::format("{}: types {} ({}) and {} ({}{}), law file {}", where, i, a, j, rigid ? "rigid wall, " : "", b,
                    setup_->law->path);
    const PairLaw law = resolve_pair(setup_->law->law, a, rigid ? wall_name : b, here);
    return {law, &setup_->law->dissipation.at(law.yielding->material.name)};
  }

 private:
  const Setup* setup_ = nullptr;
};

}  // namespace granulaw::plugin
