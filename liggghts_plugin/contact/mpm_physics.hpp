#pragma once

#include <array>
#include <string>
#include <vector>

#include "contact/tabulated.hpp"
#include "law/law.hpp"
#include "liggghts_plugin/contact/normal_physics.hpp"

namespace granulaw::plugin {

/// One pair of types under a tabulated law, in the deck's units, stretched; and the body whose law it is.
struct MpmContact : Tabulated
{
  const BodyLaw* yielding = nullptr;

  MpmContact() = default;
  MpmContact(const PairLaw& pair, double stretch, const DeckUnits& units)
      : Tabulated(pair, pair.measure(), {units.length, units.mass, stretch}), yielding(pair.yielding)
  {
  }
  /// SI, unstretched.
  PairLaw law() const { return {{curve, mapping}, yielding}; }
};

/// Model `mpm`: laws from a file, one material name for each atom type.
class MpmPhysics
{
 public:
  static constexpr const char* name = "mpm";
  static constexpr int id = 40;
  static constexpr std::array keywords{
      Keyword{.name = "law"},  // FILE; a wall that does not say it takes the pair style's
      Keyword{.name = "materials", .list = "one name for each atom type"},  // type 1 first
      beyond_range,
      Keyword{.name = "confinement", .in_wall = false, .words = {"on", "off", "auto"}},  // all contacts of a particle at once
      Keyword{.name = "waves", .words = {"on", "off"}},  // whether composed laws radiate (PairLaw::radiation)
  };
  using Contact = MpmContact;

  static void read_keywords(LAMMPS_NS::LAMMPS* lmp, Setup& setup);
  void prepare(LAMMPS_NS::LAMMPS* lmp, PropertyRegistry& registry, const Setup& setup, const Types& types);

  /// The law for particles of these radii, over any length; infinity: a wall. Without them: of like size.
  Contact resolve(int i, int j, bool rigid, const std::string& where, double radius_i = 1.0,
                  double radius_j = 1.0) const;
  SizeChoice laws_by_size(int i, int j) const;
  /// A rate-dependent body has one radius: the rate is the speed over it.
  void check_sizes(int i, int j, bool is_wall, const Contact& contact, const ParticleSizes& sizes) const;
  PairInfo describe(const Contact& contact, const PairKey& key) const;
  /// Throws Error where `tangential plastic` has no flow stress.
  void check_flow_stress(const Contact& contact) const;

 private:
  /// The deck's name of the material of type t.
  const std::string& material(int t) const;
  /// The law's body of type t; null: the type is `elastic`, or the law has no such material.
  const BodyLaw* body(int t) const;

  const Setup* setup_ = nullptr;
  std::vector<double> e_star_;  // Pa, by type
  DeckUnits units_;
};

static_assert(NormalPhysics<MpmPhysics>);

}  // namespace granulaw::plugin
