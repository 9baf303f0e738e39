#include "liggghts_plugin/books/restart_record.hpp"

#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>
#include <string_view>

#include "base/state_archive.hpp"

namespace granulaw::plugin {

namespace {

constexpr std::string_view stretch_of = " stretch";  // behind a command's name, which does not end so

/// A double that no count of an older record is.
constexpr double mark = -4.7113e300;
constexpr std::size_t header_length = 4;
constexpr double most_numbers = 1 << 27;  // a gigabyte: what a damaged length makes us read ends there

/// As a double, exactly.
double checksum_of(const double* values, std::size_t count)
{
  constexpr int more_than_a_double = 12;  // bits
  const std::string_view bytes(reinterpret_cast<const char*>(values), count * sizeof(double));
  return static_cast<double>(checksum(bytes) >> more_than_a_double);
}

/// Walk through a record's numbers that ends where they do.
class Numbers
{
 public:
  explicit Numbers(std::span<const double> all) : rest_(all) {}
  double next()
  {
    if (rest_.empty()) return fail();
    const double value = rest_.front();
    rest_ = rest_.subspan(1);
    return value;
  }
  std::span<const double> next(double count)
  {
    if (!(count >= 0 && count <= static_cast<double>(rest_.size()))) return fail(), std::span<const double>();
    const auto part = rest_.first(static_cast<std::size_t>(count));
    rest_ = rest_.subspan(part.size());
    return part;
  }
  bool ended() const { return rest_.empty() || failed_; }
  bool failed() const { return failed_; }

 private:
  double fail()
  {
    failed_ = true;
    return 0;
  }
  std::span<const double> rest_;
  bool failed_ = false;
};

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
  const auto count = static_cast<double>(values.size());
  values.insert(values.begin(), {mark, count, -count, checksum_of(values.data(), values.size())});
  return values;
}

std::optional<RestartRecord> RestartRecord::from(const char* bytes)
{
  double header[header_length];
  std::memcpy(header, bytes, sizeof header);
  const double count = header[1];
  if (header[0] != mark || header[2] != -count || !(count >= 0 && count <= most_numbers && count == std::trunc(count)))
    return {};
  std::vector<double> values(static_cast<std::size_t>(count));
  std::memcpy(values.data(), bytes + sizeof header, values.size() * sizeof(double));
  if (checksum_of(values.data(), values.size()) != header[3]) return {};

  RestartRecord record;
  Numbers numbers(values);
  const std::span<const double> counted = numbers.next(numbers.next());
  record.counts.assign(counted.begin(), counted.end());
  numbers.next();  // how many entries
  while (!numbers.ended()) {
    const double value = numbers.next();
    std::string name;
    for (const double letter : numbers.next(numbers.next())) name += static_cast<char>(letter);
    if (name.ends_with(stretch_of))
      record.meanings[name.substr(0, name.size() - stretch_of.size())].stretch = value;
    else
      record.meanings[name].combination = static_cast<long>(value);
  }
  if (numbers.failed()) return {};
  return record;
}

}  // namespace granulaw::plugin
