#pragma once

#include <concepts>
#include <limits>
#include <string>

#include "liggghts_plugin/contact_statistics.hpp"
#include "liggghts_plugin/model_info.hpp"
#include "liggghts_plugin/particle_sizes.hpp"
#include "liggghts_plugin/size_choice.hpp"
#include "liggghts_plugin/types.hpp"

// What a normal model is: NAME_physics.hpp, NAME_physics.cpp and a line in models.list.
// docs/guide/new-contact-model.md shows one. PlasticModel adds history, damping, tangential stiffness and
// statistics, and LIGGGHTS's loops call it.
//
// Nothing here needs LIGGGHTS's headers, so that a model's keywords and formulas can be tested without it.
namespace granulaw::plugin {

// It would break each requirement into three lines.
// clang-format off

/// The law of one pair of atom types: a small value that the contact loop calls in each step.
///
/// All quantities are in the deck's units, of SI or cgs (DeckUnits), and stretched where the deck says
/// `stretch S`: the force at overlap d is F(d/S)/S of the real contact's F. Arguments:
///
///   r_eff           m, > 0: R* = R_i R_j/(R_i + R_j); at a wall the sphere's R
///   m_eff           kg, > 0: m* = m_i m_j/(m_i + m_j); at a wall the sphere's m
///   delta           m, > 0: overlap now, R_i + R_j less the distance of the centres
///   delta_max       m, >= 0: largest overlap since first touch, before this step; 0 in the first step
///   speed           m/s, of approach along the normal; positive: the surfaces come nearer
///   impact_overlap  X: what impact_overlap() gave at first touch; 0 where the physics latches nothing
template <class Law>
concept ContactLaw =
    std::default_initializable<Law> && std::copyable<Law> &&
    requires(const Law law, double r_eff, double m_eff, double delta, double delta_max, double speed,
             double impact_overlap, double* kept) {
  /// N, >= 0, pushes the bodies apart. `kept` holds reversal_values numbers of this contact for the law's own use.
  /// They are 0 in a new contact, and the first may be set to 0 at any time: the law must then find what it
  /// wrote there again from the other arguments.
  { law.force(r_eff, delta, delta_max, impact_overlap, kept) } -> std::same_as<double>;
  { Law::reversal_values } -> std::convertible_to<std::size_t>;
  /// m, >= 0: radius of the circle of contact, of the real, unstretched contact.
  { law.contact_radius(r_eff, delta, delta_max, impact_overlap) } -> std::same_as<double>;
  /// Overlap/R* of first yield; infinity: never. Contacts that came no deeper are damped (`elasticDamping`).
  { law.yield_overlap() } -> std::same_as<double>;
  /// Overlap/R* up to which the law answers; the largest double: everywhere.
  { law.largest_overlap() } -> std::same_as<double>;
  /// Pa, E* of the pair: 1/E* = (1 - nu_i^2)/E_i + (1 - nu_j^2)/E_j.
  { law.pair_modulus() } -> std::same_as<double>;

  /// J, >= 0, spent on plastic strain while the largest overlap grew from `delta` to `delta_max`.
  { law.dissipated(r_eff, delta, delta_max, impact_overlap) } -> std::same_as<double>;
  /// J, >= 0, what the contact gives back on complete unloading.
  { law.stored_energy(r_eff, delta, delta_max, impact_overlap) } -> std::same_as<double>;
  /// N/m, > 0: the stiffest that a contact is which has just reached `delta`, on the way in or back out.
  { law.stiffness(r_eff, delta, impact_overlap) } -> std::same_as<double>;
  /// Overlap/R*, finite: up to there the start-up table says what the time step is short enough for.
  { law.stiffness_range() } -> std::same_as<double>;

  /// m/s, largest and least approach speed that the law knows; infinity and 0 without limits.
  { law.max_speed(r_eff, m_eff) } -> std::same_as<double>;
  { law.min_speed(r_eff, m_eff) } -> std::same_as<double>;
  /// s^2/m^2: rho V^2/Y of the yielding body over the square of the approach speed; 0: not stated.
  { law.damage_number_per_speed2() } -> std::same_as<double>;
  /// Whether the law depends on the mass of the bodies.
  { law.needs_mass() } -> std::same_as<bool>;
};

/// A law whose contacts keep a number X that follows from the approach speed at first touch.
template <class Law>
concept LatchesImpact = requires(const Law law, double r_eff, double m_eff, double speed) {
  /// X, >= 0, in a unit of the law's own.
  { law.impact_overlap(r_eff, m_eff, speed) } -> std::same_as<double>;
};

/// What a contact answers with.
struct Response
{
  double force = 0, stiffness = 0;  ///< N, N/m
};

/// A law with a shorter way for a contact that goes deeper than it ever was (delta >= delta_max).
template <class Law>
concept HasLoading = requires(const Law law, double r_eff, double delta, double from, double impact_overlap, double* kept) {
  /// force(), to the bit.
  { law.loading(r_eff, delta, impact_overlap) } -> std::same_as<double>;
  /// dissipated() but for rounding. `kept` is as after force() at `from`, and may be left as it helps force() below `delta`.
  { law.grow(r_eff, from, delta, impact_overlap, kept) } -> std::same_as<double>;
};

/// A law that lets waves take a part: they act as a dashpot F_waves = C K^2 v, v the approach speed, K the law's own
/// stiffness (law/radiation.hpp).
template <class Law>
concept Radiates = requires(const Law law, double r_eff, double delta, double delta_max, double impact_overlap,
                            double* kept) {
  /// C, s^3/kg, stretched; 0: none. Where no pair of types has one, K is not asked for.
  { law.radiation } -> std::convertible_to<double>;
  /// force() and K, N/m: dF/d(delta) of the branch that it follows.
  { law.response(r_eff, delta, delta_max, impact_overlap, kept) } -> std::same_as<Response>;
};

/// A model with several laws for one pair of types, by the ratio of the particles' radii.
template <class Physics>
concept HasLawsBySize = requires(const Physics& prepared, const std::string& where, int i, int j, bool rigid,
                                 double radius_i, double radius_j) {
  /// Where the laws stand.
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
    std::default_initializable<Physics> && ContactLaw<typename Physics::Contact> &&
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
  /// Whether contacts keep X.
  { Physics::latches_impact } -> std::convertible_to<bool>;
  requires(!Physics::latches_impact || LatchesImpact<typename Physics::Contact>);

  /// When the command was read: checks the model's own keywords, reads the files that they name. Collective.
  { Physics::read_keywords(lmp, setup) } -> std::same_as<void>;
  /// When a run begins: checks the deck against the law, and keeps what resolve() needs. Collective.
  { physics.prepare(lmp, registry, setup, types) } -> std::same_as<void>;
  /// The law of a pair of types; `rigid`: j is a wall that does not deform. Throws Error where there is none.
  { prepared.resolve(i, j, rigid, where) } -> std::same_as<typename Physics::Contact>;
  /// Throws Error if the law of types i and j does not hold for particles of these sizes.
  { prepared.check_sizes(i, j, is_wall, contact, sizes) } -> std::same_as<void>;
  /// What the start-up table and the statistics say of the law; PairTable adds the rest of PairInfo.
  { prepared.describe(contact, key) } -> std::same_as<PairInfo>;
};

// clang-format on

template <NormalPhysics Physics>
inline constexpr ModelInfo model_info{Physics::name, Physics::id, Physics::keywords};

/// For a ContactLaw that is a closed formula, to derive from: it knows neither a limit of speed nor of
/// overlap, and its contacts keep delta_max alone.
struct FormulaContact
{
  static constexpr std::size_t reversal_values = 0;
  static double max_speed(double, double) { return std::numeric_limits<double>::infinity(); }
  static double min_speed(double, double) { return 0.0; }
  static double damage_number_per_speed2() { return 0.0; }
  static bool needs_mass() { return false; }
  /// Everywhere; times R* it stays finite or becomes infinity.
  static double largest_overlap() { return std::numeric_limits<double>::max(); }
  /// Grains hardly collide deeper.
  static double stiffness_range() { return 0.1; }
};

/// For a NormalPhysics whose law is a closed formula, to derive from: no keywords, no files, no limit of
/// size.
struct FormulaPhysics
{
  static constexpr std::array<Keyword, 0> keywords{};
  static constexpr bool latches_impact = false;
  static void read_keywords(LAMMPS_NS::LAMMPS*, Setup&) {}
  template <class Contact>
  void check_sizes(int, int, bool, const Contact&, const ParticleSizes&) const
  {
  }
};

}  // namespace granulaw::plugin
