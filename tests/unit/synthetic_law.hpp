#pragma once

#include "contact/synthetic_tables.hpp"
#include "law/law.hpp"

namespace granulaw::tests {

/// No closed cycle gains energy: the work lost never falls, without an impact and at every level of the axis.
inline bool loses_no_less_further_on(const Curve& curve)
{
  std::vector<double> latched = curve.examined_levels();
  latched.push_back(0);
  for (const double at : latched) {
    double before = 0;
    for (double x = 0.9 * curve.onset(); x < 1.05 * curve.end(); x *= 1.003) {
      const double lost = curve.lost(x, at);
      if (!(lost >= before - 1e-12 * curve.work(x))) return false;  // rounding
      before = lost;
    }
  }
  return true;
}

/// Laws of these tables. Their axis ends at 17 m/s of law()'s powder on a wall, and moves e by over 1 % at 12 m/s.
struct SyntheticLaw : SyntheticTables
{
  SyntheticLaw() { speed_end = 0.066, impact_loss = 0.15; }

  /// law() with a velocity axis for the powder.
  Law law_with_axis() const
  {
    Law result = law();
    BodyLaw& powder = result.bodies.at("powder");
    powder.curve = curve_with_axis();
    powder.certificate.damage_number_max = 0.06;
    powder.certificate.axis_cost_force = 0.031;
    powder.certificate.axis_cost_restitution = 0.08;
    return result;
  }

  /// All that a file may hold: law_with_axis() and a law of its own for powder:glass, with a rate axis.
  Law whole_law(int levels = 8, int nodes = 25) const
  {
    Law result = law_with_axis();
    BodyLaw& powder = result.bodies.at("powder");
    powder.curve = Curve(table(), axis(levels, nodes));
    TwoBodyLaw& own = result.pair_laws["powder:glass"].emplace_back();
    own.law = powder;
    own.law.curve = Curve(table(), rate_axis(1e-3, levels, nodes));
    own.radius_ratio = 2;
    return result;
  }

  /// A law file's worth: one plastic material "powder" and an elastic one "glass", every pair.
  Law law() const
  {
    Law law;
    BodyLaw powder;
    powder.material = {"powder", 1500.0, 9.1e9, 0.3, 1e8, 0.0};
    powder.curve = curve();
    powder.certificate.damage_number_max = 0.002;
    powder.state();
    law.bodies["powder"] = powder;
    BodyLaw glass;
    glass.material = {"glass", 2500.0, 70e9, 0.2, std::numeric_limits<double>::infinity(), 0.0};
    glass.curve = elastic();
    law.bodies["glass"] = glass;
    law.pairs = {
        {"powder", "powder"}, {"powder", "glass"}, {"glass", "glass"}, {"powder", "wall"}, {"glass", "wall"}};
    law.provenance = {{"version", "0.1.0"}, {"git_hash", "abc"}, {"command", "mpm table x.toml"}};
    return law;
  }
};

}  // namespace granulaw::tests
