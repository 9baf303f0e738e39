#pragma once

#include <concepts>
#include <string>

#include "contact/normal.hpp"
#include "law/size_choice.hpp"
#include "liggghts_plugin/books/contact_statistics.hpp"
#include "liggghts_plugin/deck/model_info.hpp"
#include "liggghts_plugin/deck/particle_sizes.hpp"
#include "liggghts_plugin/deck/types.hpp"

// Parts of a normal model: NAME_physics.hpp, NAME_physics.cpp and a line in models.list.
// docs/guide/new-contact-model.md shows one. ElementHost adds history, damping, tangential stiffness and
// statistics, and LIGGGHTS's loops call it.
//
// Nothing here needs LIGGGHTS's headers, so that a model's keywords and formulas can be tested without it.
namespace granulaw::plugin {

// It would break each requirement into three lines.
// clang-format off

/// A model with several laws for one pair of types, by the ratio of the particles' radii.
template <class Physics>
concept HasLawsBySize = requires(const Physics& prepared, const std::string& where, int i, int j, bool rigid,
                                 double radius_i, double radius_j) {
  /// Position of the laws.
  { prepared.laws_by_size(i, j) } -> std::same_as<SizeChoice>;
  /// resolve() for particles of these radii, over any length; infinity: a wall.
  { prepared.resolve(i, j, rigid, where, radius_i, radius_j) } -> std::same_as<typename Physics::Contact>;
};

/// A normal model: how the deck's materials give the law of each pair of types. The pair style has an object of
/// it, and each wall another.
///
/// i and j are atom types; at a wall j is the wall's. Where something cannot be served, call fail() of
/// base/error.hpp: it ends the run with one sentence.
template <class Physics>
concept NormalPhysics =
    std::default_initializable<Physics> && NormalLaw<typename Physics::Contact> &&
    requires(Physics physics, const Physics& prepared, const typename Physics::Contact& contact,
             LAMMPS_NS::LAMMPS* lmp, PropertyRegistry& registry, Setup& setup, const Types& types,
             const ParticleSizes& sizes, const PairKey& key, const std::string& where, int i, int j, bool rigid,
             bool is_wall) {
  /// Behind `model` in a deck.
  { Physics::name } -> std::convertible_to<const char*>;
  /// Number of the model in LIGGGHTS's hash codes and in restart files: never change one, never use one twice. Six
  /// bits; LIGGGHTS's own end at 12. Taken: 40 mpm, 41 thornton, 42 and 43 benchmarks, 44 tests.
  { Physics::id } -> std::convertible_to<int>;
  requires(Physics::id > 12 && Physics::id < 64);
  /// The model's own keywords, an array of Keyword. Options::own_words gives what a deck says behind them.
  { std::span<const Keyword>(Physics::keywords) };
  /// When the command was read: checks the model's own keywords, reads the files that they name. Collective.
  { Physics::read_keywords(lmp, setup) } -> std::same_as<void>;
  /// When a run begins: checks the deck against the law, and keeps what resolve() needs. Collective.
  { physics.prepare(lmp, registry, setup, types) } -> std::same_as<void>;
  /// The law of a pair of types; `rigid`: j is a wall that does not deform. Throws Error where there is none.
  { prepared.resolve(i, j, rigid, where) } -> std::same_as<typename Physics::Contact>;
  /// Throws Error if the law of types i and j does not hold for particles of these sizes.
  { prepared.check_sizes(i, j, is_wall, contact, sizes) } -> std::same_as<void>;
  /// Description of the law for the start-up table and the statistics; PairTable adds the rest of PairInfo.
  { prepared.describe(contact, key) } -> std::same_as<PairInfo>;
};

// clang-format on

template <NormalPhysics Physics>
inline constexpr ModelInfo model_info{Physics::name, Physics::id, Physics::keywords};

/// For a NormalPhysics whose law is a closed formula, to derive from: no keywords, no files, no limit of
/// size.
struct FormulaPhysics
{
  static constexpr std::array<Keyword, 0> keywords{};
  static void read_keywords(LAMMPS_NS::LAMMPS*, Setup&) {}
  template <class Contact>
  void check_sizes(int, int, bool, const Contact&, const ParticleSizes&) const
  {
  }
};

}  // namespace granulaw::plugin
