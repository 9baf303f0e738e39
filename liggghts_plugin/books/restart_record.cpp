#include "liggghts_plugin/books/restart_record.hpp"

#include <cstddef>
#include <string_view>

namespace granulaw::plugin {

namespace {

constexpr std::string_view stretch_of = " stretch";  // behind a command's name, which has no blank

}  // namespace

std::vector<double> RestartRecord::numbers() const
{
  std::vector<double> values{static_cast<double>(counts.size())};
  values.insert(values.end(), counts.begin(), counts.end());
  values.push_back(static_cast<double>(2 * meanings.size()));
  const auto add = [&](const std::string& name, double value) {
    values.insert(values.end(), {value, static_cast<double>(name.size())});
    values.insert(values.end(), name.begin(), name.end());
  };
  for (const auto& [command, meaning] : meanings) {
    add(command, static_cast<double>(meaning.combination));
    add(command + std::string(stretch_of), meaning.stretch);
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
    std::string name;
    for (std::size_t c = 0; c < length; ++c) name += static_cast<char>(numbers[k + 2 + c]);
    if (name.ends_with(stretch_of))
      record.meanings[name.substr(0, name.size() - stretch_of.size())].stretch = numbers[k];
    else
      record.meanings[name] = {static_cast<long>(numbers[k]), 0.0};
    k += 2 + length;
  }
  return record;
}

}  // namespace granulaw::plugin
