#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace granulaw::plugin {

/// Meaning of the numbers of a contact's history: the models, and every keyword that changes
/// what they stand for. A restart into another meaning is refused. Law files and the other keywords may
/// change: they say how a contact goes on, not what it was.
struct HistoryMeaning
{
  /// LIGGGHTS's number of the five models, six bits each, and a bit for each keyword.
  long combination = 0;
  static constexpr long energy = 1l << 32,  ///< `energy on`: values of its own
      contact_map = 1l << 33,               ///< `contactMap on`: a value of its own
      deformable_wall = 1l << 34,           ///< `wall deformable`: X is over lambda R*, lambda of the pair
      body_compliance = 1l << 36,           ///< `bodyCompliance on`: a value of its own
      crush = 1l << 37,                     ///< `beyondRange crush`: a value of its own
      confinement = 1l << 38,           ///< `confinement on`: contacts stand with their particles
      computed_stiffness = 1l << 35;        ///< `tangentialStiffness computed`: of the spring in the history
  /// `stretch S`: overlaps are S times the real ones.
  double stretch = 1.0;

  bool operator==(const HistoryMeaning&) const = default;
};

/// Name of the pair style's entry in RestartRecord::meanings.
inline constexpr const char* pairs_record = "pair";

/// Record of fix granulaw/stats in a restart file.
struct RestartRecord
{
  std::vector<double> counts;                      ///< ContactStatistics::pack
  std::map<std::string, HistoryMeaning> meanings;  ///< Session::meanings, by command

  /// As numbers: a mark, the length of the rest, its negative and its checksum; how many counts, the counts, how many
  /// entries; then for each a number, the length of its name and the letters. A command has two: its combination
  /// under its name, its stretch behind it.
  std::vector<double> numbers() const;
  /// Record from the result of numbers(), whose length LIGGGHTS does not hand over. Null: it is damaged, or from
  /// another version.
  static std::optional<RestartRecord> from(const char* bytes);
};

}  // namespace granulaw::plugin
