#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "contact/ledger.hpp"
#include "liggghts_plugin/engine/deck_units.hpp"

namespace granulaw::plugin {

/// Energies of a run over time, evenly spaced in steps. When it is full, every second row is dropped and the
/// spacing doubled: a run of any length leaves between capacity/2 and capacity rows.
class EnergySeries
{
 public:
  static constexpr std::size_t capacity = 400;

  /// Deck's units. Sums over particles, then over contacts since the counts began.
  enum Column : int {
    time,
    particles,
    kinetic,                                               ///< translation: sum of m v^2/2, as `thermo`'s ke
    rotational,                                            ///< spheres: sum of (2/5) m R^2 omega^2/2
    taken,                                                 ///< by each Mechanism, in turn
    elastic = taken + static_cast<int>(Mechanism::count),  ///< held by normal contacts now; energy on, else 0
    other_work,  ///< taken by the other contact forces; energy on, else 0
    fastest,     ///< largest speed of a particle
    columns
  };
  using Row = std::array<double, columns>;

  bool due(std::int64_t step) const { return step >= next_; }
  void add(std::int64_t step, const Row& row);
  /// The array of each column in SI, by name; `energies`: with elastic and other_work.
  nlohmann::ordered_json json(const DeckUnits& units, bool energies) const;

 private:
  std::vector<Row> rows_;
  std::vector<std::int64_t> steps_;
  std::int64_t spacing_ = 1, next_ = 0;
};

}  // namespace granulaw::plugin
