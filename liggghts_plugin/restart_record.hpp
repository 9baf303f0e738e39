#pragma once

#include <map>
#include <string>
#include <vector>

namespace granulaw::plugin {

/// What fix granulaw/stats leaves in a restart file.
struct RestartRecord
{
  std::vector<double> counts;                ///< ContactStatistics::pack
  std::map<std::string, long> combinations;  ///< Session::combinations, by command

  /// As numbers: how many counts, the counts, how many commands; then for each its combination, the length of
  /// its name and the letters.
  std::vector<double> numbers() const;
  /// What numbers() gave. Of a record that is cut short, as much as is whole.
  static RestartRecord from(const std::vector<double>& numbers);
};

}  // namespace granulaw::plugin
