#pragma once

#include <algorithm>
#include <cmath>

#include "law/law.hpp"
#include "liggghts_plugin/plastic_model.hpp"

namespace granulaw::plugin {

/// One pair of types under a tabulated law: PairLaw with everything that does not change worked out.
struct MpmContact
{
  const FastCurve* curve = nullptr;
  double per_lambda = 0;   // 1/lambda of PairMapping
  double force_scale = 0;  // Hertz force at x = 1 over R*^2, Pa
  PairLaw law;             // for first touches

  MpmContact() = default;
  MpmContact(const PairLaw& pair, const FastCurve& fast_curve)
      : curve(&fast_curve),
        per_lambda(1.0 / pair.mapping.length(1.0)),
        force_scale(pair.mapping.force(1.0)),
        law(pair)
  {
  }

  /// X of a contact that begins at this approach speed (m/s); 0: quasi-static.
  double impact_overlap(double r_eff, double m_eff, double speed) const
  {
    return law.impact_overlap(r_eff, m_eff, speed);
  }
  /// m/s, where the law's inertia axis ends; infinity without one.
  double max_speed(double r_eff, double m_eff) const { return law.max_speed(r_eff, m_eff); }
  /// N, at overlap delta (m) of a contact whose largest overlap so far is delta_max (m) and which latched X.
  double force(double r_eff, double delta, double delta_max, double impact_overlap) const
  {
    const double per_length = per_lambda / r_eff;
    const double ratio = delta < delta_max ? delta / delta_max : 1.0;
    return force_scale * r_eff * r_eff *
           curve->force(delta * per_length, delta_max * per_length, ratio, impact_overlap);
  }
  /// J, spent on plastic strain while the largest overlap grew from `from` to `to` (m).
  double dissipated(double r_eff, double from, double to, double impact_overlap) const
  {
    const double length = r_eff / per_lambda;
    return force_scale * r_eff * r_eff * length *
           curve->dissipated(from / length, to / length, impact_overlap);
  }
  double largest_overlap() const { return curve->curve().x_end() / per_lambda; }
  double inertia_per_speed2() const
  {
    // the yielding body's share of the approach is V/sqrt(lambda): all on a rigid wall, half in a like pair
    return law.yielding->material.density / law.yielding->material.yield_stress * per_lambda;
  }
};

/// Model `mpm`: laws from a file, one material name for each atom type.
class MpmPhysics
{
 public:
  static constexpr const char* name = "mpm";
  static constexpr bool latches_impact = true;
  using Contact = MpmContact;

  void prepare(LAMMPS_NS::LAMMPS* lmp, PropertyRegistry& registry, const Setup& setup, const Types& types);

  Contact resolve(int i, int j, bool rigid, const std::string& where) const
  {
    const std::string& a = setup_->options.materials[static_cast<std::size_t>(i - 1)];
    const std::string& b = setup_->options.materials[static_cast<std::size_t>(j - 1)];
    const std::string here = fmt::format("{}: types {} ({}) and {} ({}{}), law file {}", where, i, a, j,
                                         rigid ? "rigid wall, " : "", b, setup_->law->path);
    const PairLaw law = resolve_pair(setup_->law->law, a, rigid ? wall_name : b, here);
    return {law, setup_->law->curves.at(law.curve)};
  }

 private:
  const Setup* setup_ = nullptr;
};

}  // namespace granulaw::plugin
