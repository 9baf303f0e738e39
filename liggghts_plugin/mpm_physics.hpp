#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "contact/contact.hpp"
#include "law/damage_number.hpp"
#include "law/law.hpp"
#include "liggghts_plugin/normal_physics.hpp"

namespace granulaw::plugin {

/// One pair of types under a tabulated law: PairLaw with everything that does not change worked out.
struct MpmContact
{
  const Curve* curve = nullptr;
  double per_lambda = 0;   // 1/(lambda S), lambda of PairMapping
  double lambda = 0;       // lambda S
  double force_scale = 0;  // Hertz force at x = 1 over R*^2 S
  double radiation = 0;    // C S^3 of the dashpot that stands for waves (law/radiation.hpp), s^3/kg; 0: none
  PairLaw law;             // SI, unstretched: for first touches
  double per_stretch = 1;  // 1/S
  DeckUnits units;

  MpmContact() = default;
  /// A stretched contact moves as the real one, S times as far in S times the time, so its forces are 1/S of
  /// the real ones. The waves' C K^2 v must be, too: v is the real one and K is 1/S^2 of it, which leaves C
  /// S^3.
  MpmContact(const PairLaw& pair, double stretch, const DeckUnits& deck_units)
      : curve(pair.curve),
        per_lambda(1.0 / (pair.mapping.length(1.0) * stretch)),
        lambda(pair.mapping.length(1.0) * stretch),
        force_scale(pair.mapping.force(1.0) / (deck_units.pressure() * stretch)),
        radiation(pair.radiation * deck_units.mass * stretch * stretch * stretch),
        law(pair),
        per_stretch(1.0 / stretch),
        units(deck_units)
  {
  }

  /// X of a contact that begins at this approach speed; 0: quasi-static.
  double impact_overlap(double r_eff, double m_eff, double speed) const
  {
    if (!law.curve->axis()) return 0.0;
    return law.impact_overlap(r_eff * units.length, m_eff * units.mass, speed * units.length);
  }
  /// Where the law's velocity axis ends; infinity without one.
  double max_speed(double r_eff, double m_eff) const
  {
    return law.max_speed(r_eff * units.length, m_eff * units.mass) / units.length;
  }
  /// Slowest impact that a rate law knows; 0: any.
  double min_speed(double r_eff, double m_eff) const
  {
    return law.min_speed(r_eff * units.length, m_eff * units.mass) / units.length;
  }
  using Reversal = granulaw::Reversal;
  /// How many values a contact keeps of its last reversal; the first is its overlap, 0 before there is one.
  static constexpr std::size_t reversal_values = sizeof(Reversal) / sizeof(double);
  /// At overlap delta of a contact whose largest overlap so far is delta_max and which latched X. `kept`: its
  /// turn, worked out anew where it is of another overlap.
  double force(double r_eff, double delta, double delta_max, double impact_overlap, double* kept) const
  {
    const double per_length = per_lambda / r_eff;
    const double x = delta * per_length, x_max = delta_max * per_length;
    const double scale = force_scale * r_eff * r_eff;
    if (!curve->unloads(x, x_max)) return scale * curve->force(x, impact_overlap);
    return scale * reversal(x_max, impact_overlap, kept).force(x);
  }
  double loading(double r_eff, double delta, double impact_overlap) const
  {
    return force_scale * r_eff * r_eff * curve->force(delta * (per_lambda / r_eff), impact_overlap);
  }
  double grow(double r_eff, double from, double to, double impact_overlap, double*) const
  {
    const double per_length = per_lambda / r_eff;
    return force_scale * r_eff * r_eff * (r_eff * lambda) *
           (curve->lost(to * per_length, impact_overlap) - curve->lost(from * per_length, impact_overlap));
  }
  /// force(), to the bit, and dF/d(delta) of the branch.
  Response response(double r_eff, double delta, double delta_max, double impact_overlap, double* kept) const
  {
    const double per_length = per_lambda / r_eff;
    const double x = delta * per_length, x_max = delta_max * per_length;
    const double scale = force_scale * r_eff * r_eff;
    if (curve->unloads(x, x_max)) {
      const Reversal back = reversal(x_max, impact_overlap, kept);
      return {scale * back.force(x), scale * per_length * back.stiffness(x)};
    }
    const Curve::Loading now = curve->loading(x, impact_overlap);
    return {scale * now.force, scale * per_length * now.stiffness};
  }
  double contact_radius(double r_eff, double delta, double delta_max, double impact_overlap) const
  {
    return answer(*curve, law.mapping, r_eff, per_stretch * delta, per_stretch * delta_max, impact_overlap)
        .contact_radius;
  }
  double yield_overlap() const { return curve->onset() / per_lambda; }
  double pair_modulus() const { return law.mapping.e_star_pair() / units.pressure(); }
  bool needs_mass() const { return law.curve->axis() != nullptr; }
  double dissipated(double r_eff, double from, double to, double impact_overlap) const
  {
    const double length = r_eff / per_lambda;
    return force_scale * r_eff * r_eff * length *
           (curve->lost(to / length, impact_overlap) - curve->lost(from / length, impact_overlap));
  }
  double stored_energy(double r_eff, double delta, double delta_max, double impact_overlap) const;
  double stiffness(double r_eff, double delta, double impact_overlap) const;
  double planned_stiffness(double r_eff, double delta) const;
  double largest_overlap() const { return curve->end() / per_lambda; }
  double stiffness_range() const { return largest_overlap(); }
  double damage_number_per_speed2() const { return damage_number(law, units.length); }

 private:
  /// The reversal at x_max, out of `kept` where that holds it, and kept there else.
  Reversal reversal(double x_max, double impact_overlap, double* kept) const
  {
    if (kept[0] != x_max) [[unlikely]] {
      const Reversal reversal = curve->reversal(x_max, impact_overlap);
      std::memcpy(kept, &reversal, sizeof reversal);
    }
    std::array<double, reversal_values> values;
    std::copy_n(kept, reversal_values, values.begin());
    return std::bit_cast<Reversal>(values);
  }
};

/// Material name of types that follow plain Hertz with the deck's moduli and need no law.
inline constexpr const char* elastic_name = "elastic";

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
      Keyword{.name = "waves", .words = {"on", "off"}},  // whether composed laws radiate (PairLaw::radiation)
  };
  static constexpr bool latches_impact = true;
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
