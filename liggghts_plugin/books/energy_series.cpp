#include "liggghts_plugin/books/energy_series.hpp"

#include <nlohmann/json.hpp>

#include "liggghts_plugin/books/stats_json.hpp"

namespace granulaw::plugin {

void EnergySeries::add(std::int64_t step, const Row& row)
{
  if (!steps_.empty() && steps_.back() == step) {  // the end of one run is the beginning of the next
    rows_.back() = row;
    return;
  }
  if (rows_.size() == capacity) {
    for (std::size_t k = 1; 2 * k < capacity; ++k) {
      rows_[k] = rows_[2 * k];
      steps_[k] = steps_[2 * k];
    }
    rows_.resize(capacity / 2);
    steps_.resize(capacity / 2);
    spacing_ *= 2;
  }
  rows_.push_back(row);
  steps_.push_back(step);
  next_ = step + spacing_;
}

nlohmann::ordered_json EnergySeries::json(const DeckUnits& units, bool energies) const
{
  constexpr int digits = 6;
  struct Entry
  {
    const char* name;
    int column;
    double unit;
    bool shown;
  };
  const double joule = units.energy();
  std::vector<Entry> entries{{"time_s", time, 1, true},
                             {"particles", particles, 1, true},
                             {"kinetic_J", kinetic, joule, true},
                             {"rotational_J", rotational, joule, true}};
  for (const MechanismText& m : mechanisms)
    entries.push_back({m.key, taken + static_cast<int>(m.which), joule, m.in_statistics});
  entries.insert(entries.end(), {{"elastic_J", elastic, joule, energies},
                                 {"other_work_J", other_work, joule, energies},
                                 {"fastest_particle_m_per_s", fastest, units.length, true}});
  nlohmann::ordered_json series;
  for (const Entry& entry : entries) {
    if (!entry.shown) continue;
    nlohmann::ordered_json& values = series[entry.name] = nlohmann::ordered_json::array();
    for (const Row& row : rows_)
      values.push_back(json_number(row[static_cast<std::size_t>(entry.column)] * entry.unit, digits));
  }
  return series;
}

}  // namespace granulaw::plugin
