#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "liggghts_plugin/contact/normal_physics.hpp"

namespace granulaw::plugin {

/// Hertz's law of one pair of types: F = 4/3 E* sqrt(R*) d^1.5. Of the deck's overlap d the real contact has
/// d/S.
struct PlainHertzContact : FormulaContact
{
  double e_star = 0.0;       // of the pair
  double per_stretch = 1.0;  // 1/S

  double force(double r_eff, double delta, double, double, double*) const
  {
    const double real = per_stretch * delta;
    return per_stretch * 4.0 / 3.0 * e_star * std::sqrt(r_eff * real) * real;
  }
  Response response(double r_eff, double delta, double, double, double*) const
  {
    const double stiffness =
        per_stretch * per_stretch * 2.0 * e_star * std::sqrt(r_eff * per_stretch * delta);
    return {force(r_eff, delta, 0.0, 0.0, nullptr), stiffness};
  }
  double contact_radius(double r_eff, double delta, double, double) const
  {
    return std::sqrt(r_eff * per_stretch * delta);
  }
  double pair_modulus() const { return e_star; }
  static double yield_overlap() { return std::numeric_limits<double>::infinity(); }
  static double dissipated(double, double, double, double) { return 0.0; }
  double stored_energy(double r_eff, double delta, double delta_max, double impact_overlap) const
  {
    return 0.4 * delta * force(r_eff, delta, delta_max, impact_overlap, nullptr);
  }
  double stiffness(double r_eff, double delta, double) const
  {
    return response(r_eff, delta, delta, 0.0, nullptr).stiffness;
  }
};

/// Model `plain_hertz`, with a keyword of its own: `modulusFactor K` multiplies E*.
class PlainHertzPhysics : public FormulaPhysics
{
 public:
  static constexpr const char* name = "plain_hertz";
  static constexpr int id = 44;
  static constexpr std::array keywords{Keyword{.name = "modulusFactor", .least = 0.1, .most = 10.0}};
  using Contact = PlainHertzContact;

  void prepare(LAMMPS_NS::LAMMPS* lmp, PropertyRegistry& registry, const Setup& setup, const Types& types);
  Contact resolve(int i, int j, bool rigid, const std::string& where) const;
  PairInfo describe(const Contact& contact, const PairKey& key) const;

 private:
  std::vector<double> compliance_;  // 1/E*, by type, in the deck's units
  double per_stretch_ = 1.0;
};

static_assert(NormalPhysics<PlainHertzPhysics>);

}  // namespace granulaw::plugin
