#pragma once

#include <array>
#include <list>
#include <map>

#include "calibrate/measurement.hpp"
#include "calibrate/parameters.hpp"
#include "atlas/composed_law.hpp"

namespace granulaw {

/// A measurement of two bodies, of which one is known and the other is fitted: an indenter on a specimen, a
/// sphere on a deformable wall that gives way. Its law is composed of those that the atlas has of both
/// (docs/theory/pairs.md). A composed law takes 10 to 30 ms. So it is made at the materials of a lattice, E,
/// Y and Y + 2 H whole powers of a factor, and interpolated, linear in the logarithms: e is within 0.001.
class ComposedModel
{
 public:
  /// Throws Error if the atlas does not hold the counterpart's material. `atlas` and the measurement outlive
  /// this. Parameters that are not in `varied` are always the same.
  ComposedModel(const Atlas& atlas, const Measurement& measurement, std::vector<Parameter> varied);

  /// Slow law of an indenter on a specimen.
  struct IndenterLaw
  {
    LawMaterial specimen;
    Curve curve;
    double length = 0, force = 0;  ///< m, N: units of overlap and force
  };
  /// Valid until the next call.
  const IndenterLaw& law(const LawMaterial& specimen) const;
  /// Drops: e on this wall less e on the rigid one, by the data.
  std::vector<double> change(const LawMaterial& fitted) const;
  /// Sd of a composed law's errors, of F, relative, and of e.
  ComposedError error(const LawMaterial& fitted) const;

  /// The modulus of the lattice next to this one: there one composed law serves, elsewhere it takes two.
  static double nearest(double modulus);

 private:
  using Steps = std::array<int, 3>;  // along E, Y and hardening
  /// At a lattice material.
  struct Node
  {
    LawShape shape;  // of an indenter
    double log_onset = 0, log_end = 0;
    std::vector<double> change;  // of drops
  };
  /// Calls use(weight, node) for the nodes around a material.
  template <class Use>
  void around(const LawMaterial& wanted, Use use) const;
  Node compute(const LawMaterial& fitted) const;
  LawMaterial counterpart_on(const LawMaterial& fitted) const;
  IndenterLaw make(const LawMaterial& specimen) const;
  std::vector<double> changes(const PairBody& own, const PairBody& other) const;

  const Atlas* atlas_;
  const Measurement* measured_;
  std::array<bool, 3> varies_{};
  mutable std::map<Steps, Node> nodes_;
  mutable std::list<IndenterLaw> laws_;  // the last ones first
};

}  // namespace granulaw
