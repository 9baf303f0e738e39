#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "contact/ledger.hpp"
#include "law/contact_step.hpp"
#include "law/pair_statement.hpp"
#include "liggghts_plugin/books/log_histogram.hpp"
#include "liggghts_plugin/engine/deck_units.hpp"

namespace granulaw::plugin {

/// Which contacts share one line of the contact statistics: those of a pair of atom types, or of a type with
/// a wall's.
struct PairKey
{
  enum Kind : int { particles, rigid_wall, deformable_wall };
  int kind = particles;
  int i = 0, j = 0;  ///< atom types; i <= j between particles, j the wall's at walls

  auto operator<=>(const PairKey&) const = default;
};

/// Rows of a table of `types` atom types: first pairs i <= j of particles (1 1, 1 2, ..., 2 2, ...), then
/// each particle type with each wall type (1 1, 1 2, ..., 2 1, ...). From 0; both kinds of walls share a row.
constexpr int rows_of_types(int types)
{
  return types * (types + 1) / 2 + types * types;
}
constexpr int row_of_types(const PairKey& key, int types)
{
  if (key.kind == PairKey::particles)
    return (key.i - 1) * types - (key.i - 1) * (key.i - 2) / 2 + key.j - key.i;
  return types * (types + 1) / 2 + (key.i - 1) * types + key.j - 1;
}

/// Law of a pair of types when a run begins. Not counted, not reduced: alike on all ranks.
struct PairInfo
{
  bool needed = false;             ///< particles (or templates) and walls of these types exist
  std::string a, b, law;           ///< material names, "mpm" or "thornton" and the law file
  std::string kind;                ///< of the law: name_of(LawKind), "Hertz", "closed form"
  std::string note;                ///< about the law, where it is no tabulated one
  PairStatement stated{};          ///< of a tabulated law, the worst over the sizes that can meet
  double stiffness_ratio = 0;      ///< E*/Y of the yielding body; 0: it does not yield
  double overlap_limit = 0;        ///< overlap/R* where the table ends; infinity: nowhere
  double damage_number_limit = 0;  ///< I up to which the error bound holds; 0: not stated
  double onset_speed = 0;          ///< m/s, of first yield between the smallest particles; infinity: never
  double dt_limit = 0;  ///< s, largest_step (law/contact_step.hpp) to the end of the law; 0: no limit known
  double dt_overlap = 0;  ///< overlap/R* up to which the time step in use is short enough; 0: not known
  /// Overlap/R* at which the yielding body is flattened by a tenth of its radius: beyond, its contacts act on
  /// each other and no law of one contact holds. Infinity: not counted.
  double deep_overlap = std::numeric_limits<double>::infinity();

  /// Takes in the law that other sizes of the same pair of types follow.
  void include(const PairInfo& other);
};

/// Part of the table's overlap range from which a contact counts as near its edge.
inline constexpr double near_edge = 0.9;

/// Rule by which the numbers of pairs of types, and of ranks, make the number of all contacts.
enum class Combine { sum, largest, least };

/// Counts of the contacts of this rank since the pair style was set. Filled by the contact loops.
///
/// A pair of a local particle and a ghost is computed on both ranks (or twice on one, across a periodic
/// boundary): it counts with `weight` 1/2 each time, so that sums over ranks are right.
struct ContactStatistics
{
  struct Pair
  {
    Ledger taken;            ///< J: by the normal law, its own work functions; by waves (law/radiation.hpp)
    double other_work = 0;   ///< J, taken by all that `taken` has not; energy on only
    double touches = 0;      ///< contacts that began
    double ended = 0;        ///< contacts that ended; known once the open ones are out (count_ended)
    double near = 0;         ///< contacts that came deeper than near_edge of the table
    double past = 0;         ///< contacts that went beyond the table
    double beyond = 0;       ///< contact-steps beyond the law's table
    double crushed = 0;      ///< J, taken beyond the table under `beyondRange crush`; part of `taken`
    double too_fast = 0;     ///< contacts that began faster than the law's velocity axis goes
    double too_slow = 0;     ///< contacts that began slower than the slowest impact of a rate law
    double sudden = 0;       ///< contacts that began deeper than one step's motion can bring them
    double brought = 0;      ///< J, elastic energy that those held when they began
    double speed_max = 0;    ///< m/s, largest approach speed at first touch
    double overlap_max = 0;  ///< largest overlap/R*
    double damage_number_max = 0;  ///< largest I = rho V^2/Y at first touch (V: the yielding body's share)
    double frequency2 = 0;         ///< 1/s^2, largest stiffness over effective mass
    double speed_min = std::numeric_limits<double>::infinity();    ///< m/s, slowest first touch
    double overlap_min = std::numeric_limits<double>::infinity();  ///< lower edge of the lowest bin of
                                                                   ///< `overlap` that holds an ended one
    LogHistogram speed{1e-6};                                      ///< approach speed at first touch, m/s
    /// Largest overlap/R* so far of each contact, ended or open: LIGGGHTS does not always report the end of
    /// one. The open ones are taken out when the contact statistics are read (take_out_open), which leaves
    /// those that ended.
    LogHistogram overlap{1e-10};
    /// Each contact by both, at [bin of speed * bins + bin of overlap]; empty: `contactMap off`.
    std::vector<double> map;
    double hardest = 0;  ///< R* delta/m*^2 of the contact that run_frequency2 is of (this rank's)
    double run_frequency2 = 0;  ///< frequency2 of this run alone (this rank's; not kept in restarts)
    PairInfo info;

    /// Counts a contact in its bin of overlap, with `contactMap on` (touch_speed >= 0) in the map; a negative
    /// weight takes it out. A pair that two ranks see counts half on each, and may have begun on one of them
    /// alone: only the sum over ranks need not be negative.
    void count(std::size_t overlap_bin, double touch_speed, double weight)
    {
      overlap.count[overlap_bin] += weight;
      if (touch_speed < 0.0) return;
      if (map.empty()) open_map();
      map[speed.bin(touch_speed) * LogHistogram::bins + overlap_bin] += weight;
    }
    /// Counts derived from the histogram, summed over ranks, once the open contacts are out.
    void count_ended();
    /// Fills bins of this that hold less than none out of `other`'s: open contacts that began there, before
    /// `set type` made them this pair's, and were taken out here.
    void take_back_from(Pair& other);
    /// Contacts, ended and open, that came deeper than PairInfo::deep_overlap, by the bins of the histogram
    /// (open ones included) that lie beyond it: at least so many.
    double deep() const;
    void open_map() { map.resize(std::size_t{LogHistogram::bins} * LogHistogram::bins); }
    /// The same in SI; the contact loops count in the deck's units.
    Pair in_si(const DeckUnits& units) const;
    /// Adds `other`: sums, largest and least values, histograms.
    void merge(const Pair& other);
    /// s, largest_step of the stiffest contact so far; infinity: none yet.
    double dt_allowed() const { return largest_step(1.0, frequency2); }
  };

  std::map<PairKey, Pair> pairs;  ///< nodes stay where they are: contact models keep pointers

  /// Pair::count_ended of each pair.
  void count_ended();
  /// Least damage number of the pairs of types that can meet up to which the error bound holds; 0: not
  /// stated.
  double damage_number_limit() const;
  /// All contacts between particles, all with walls.
  Pair total(bool walls) const;
  Pair total() const;

  /// Everything that counts as plain numbers, for restart files, and back. Restoring replaces what is there,
  /// but keeps each side's info; `sums` false: only largest and least values (all ranks but one). A side is
  /// a key, its numbers and histograms; a map follows as a record of its own, of the bins that hold
  /// something. The first number gives the layout: unpack() of another one changes nothing and is false.
  std::vector<double> pack() const;
  bool unpack(const double* values, std::size_t count, bool sums);
};

/// A number that is counted for each pair of types. The list of all is the one place that says how it adds up
/// over types and ranks, its unit, and where it is printed.
struct Quantity
{
  /// A number of a pair: a member, or what a mechanism took.
  struct Value
  {
    double ContactStatistics::Pair::*member = nullptr;
    Mechanism mechanism = Mechanism::count;

    constexpr Value() = default;
    constexpr Value(double ContactStatistics::Pair::*number) : member(number) {}
    constexpr Value(Mechanism m) : mechanism(m) {}
    template <class Pair>
    auto& of(Pair& pair) const
    {
      return member ? pair.*member : pair.taken.taken[static_cast<std::size_t>(mechanism)];
    }
  };

  Value value;
  Combine combine = Combine::sum;
  enum Unit { plain, energy, speed } unit = plain;
  const char* key = nullptr;  ///< in the JSON; null: not there
  int vector = -1;  ///< place in fix granulaw/stats' vector, from 0; -1: not there
  bool split = false;  ///< the vector has it of particles, and in the next place of walls
  int column = -1;     ///< of the fix's array; -1: not there
};

/// Restart files hold the numbers in this order.
inline constexpr auto quantities = [] {
  using Pair = ContactStatistics::Pair;
  using enum Combine;
  const auto energy = [](Quantity::Value value, const char* key, int vector, int column, bool split = false) {
    return Quantity{value, sum, Quantity::energy, key, vector, split, column};
  };
  const std::array counts{
      Quantity{&Pair::touches, sum, Quantity::plain, "contacts_begun", 2, true, 0},
      Quantity{&Pair::ended, sum, Quantity::plain, "contacts_ended", -1, false, 1},
      Quantity{&Pair::near, sum, Quantity::plain, "contacts_near_table_edge", 11},
      Quantity{&Pair::past, sum, Quantity::plain, "contacts_past_table"},
      Quantity{&Pair::beyond, sum, Quantity::plain, "contact_steps_beyond_table", 8},
      Quantity{&Pair::crushed, sum, Quantity::energy, "crush_dissipation_J", 20},
      Quantity{&Pair::too_fast, sum, Quantity::plain, "contacts_beyond_speed_axis", 10},
      Quantity{&Pair::too_slow, sum, Quantity::plain, "contacts_below_speed_axis", 15},
      Quantity{&Pair::sudden, sum, Quantity::plain, "contacts_begun_overlapping", 16, false, 6},
      Quantity{&Pair::brought, sum, Quantity::energy, "energy_of_overlapping_starts_J", 17},
      Quantity{&Pair::speed_max, largest, Quantity::speed, "impact_speed_max_m_per_s", 4, true, 4},
      Quantity{&Pair::overlap_max, largest, Quantity::plain, "overlap_over_radius_max", 6, true, 5},
      Quantity{&Pair::damage_number_max, largest, Quantity::plain, "damage_number_max", 9},
      Quantity{&Pair::frequency2, largest, Quantity::plain, nullptr, 12},  // printed as a time step
      Quantity{&Pair::speed_min, least, Quantity::speed, "impact_speed_min_m_per_s"},
      Quantity{&Pair::overlap_min, least, Quantity::plain, "overlap_over_radius_min"},
  };
  constexpr auto further = static_cast<std::size_t>(
      std::ranges::count_if(mechanisms.begin() + 1, mechanisms.end(), &MechanismText::in_statistics));
  std::array<Quantity, 2 + further + counts.size()> all{
      energy(Mechanism::plastic, mechanisms[0].key, 0, 2, true),
      energy(&Pair::other_work, "other_work_J", 14, 3),
  };
  auto next = all.begin() + 2;
  constexpr int crush = 20;      // that place is crush_dissipation_J's
  int vector = 18, column = 7;  // places that further mechanisms take from here on
  for (const MechanismText& m : mechanisms)
    if (m.in_statistics && m.which != Mechanism::plastic)
      *next++ = energy(m.which, m.key, vector == crush ? ++vector : vector, column++), ++vector;
  std::ranges::copy(counts, next);
  return all;
}();

/// Numbers of the fix's vector and array: up to the last place that a quantity has.
constexpr int places(int Quantity::*place)
{
  int last = 0;
  for (const Quantity& q : quantities) last = std::max(last, q.*place);
  return last + 1;
}

}  // namespace granulaw::plugin
