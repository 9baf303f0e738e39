#include "liggghts_plugin/restart_record.hpp"

#include <cstddef>

namespace granulaw::plugin {

std::vector<double> RestartRecord::numbers() const
{
  std::vector<double> values{static_cast<double>(counts.size())};
  values.insert(values.end(), counts.begin(), counts.end());
  values.push_back(static_cast<double>(combinations.size()));
  for (const auto& [command, combination] : combinations) {
    values.insert(values.end(), {static_cast<double>(combination), static_cast<double>(command.size())});
    values.insert(values.end(), command.begin(), command.end());
  }
  return values;
}

RestartRecord RestartRecord::from(const std::vector<double>& numbers)
{
  RestartRecord record;
  if (numbers.empty()) return record;
  const auto begin = numbers.begin();
  const auto counts = static_cast<std::size_t>(numbers[0]);
  if (counts >= numbers.size()) return record;
  record.counts.assign(begin + 1, begin + 1 + static_cast<std::ptrdiff_t>(counts));
  for (std::size_t k = counts + 2; k + 1 < numbers.size();) {
    const auto length = static_cast<std::size_t>(numbers[k + 1]);
    if (k + 2 + length > numbers.size()) break;
    std::string command;
    for (std::size_t c = 0; c < length; ++c) command += static_cast<char>(numbers[k + 2 + c]);
    record.combinations[command] = static_cast<long>(numbers[k]);
    k += 2 + length;
  }
  return record;
}

}  // namespace granulaw::plugin
