#include "deck/commands/data_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <unordered_map>

#include "base/error.hpp"
#include "deck/commands/reading.hpp"

namespace granulaw::deck {

namespace {

/// Reads a data file line by line.
class DataFile
{
 public:
  explicit DataFile(std::string path) : path_(std::move(path)) {}

  void read(std::istream& in);

  Box domain;                     ///< as far as the file says it
  int types = 0;                  ///< 0: the file does not say it
  double atoms = 0;               ///< that its header announces
  std::map<int, Source> sources;  ///< by atom type

 private:
  enum class Section { atoms, velocities, elsewhere };
  using Line = std::vector<std::string>;

  std::string path_;
  int line_number_ = 0;
  Section section_ = Section::elsewhere;
  std::unordered_map<double, Source*> source_of_;  // by atom ID: the velocities come after the atoms

  std::string where() const { return fmt::format("{}:{}", path_, line_number_); }
  void header_line(const Line& line);
  void atom(const Line& line);
  void velocity(const Line& line);
  template <std::size_t n>
  std::array<double, n> numbers(const Line& line, const char* section, const char* columns) const;
};

void DataFile::read(std::istream& in)
{
  std::string text;
  std::getline(in, text);  // a title
  for (line_number_ = 2; std::getline(in, text); ++line_number_) {
    const Line line = Script::split(text.substr(0, text.find('#')));
    if (line.empty()) continue;
    if (!number(line[0]))
      section_ = line[0] == "Atoms"        ? Section::atoms
                 : line[0] == "Velocities" ? Section::velocities
                                           : Section::elsewhere;
    else if (section_ == Section::atoms)
      atom(line);
    else if (section_ == Section::velocities)
      velocity(line);
    else
      header_line(line);
  }
}

template <std::size_t n>
std::array<double, n> DataFile::numbers(const Line& line, const char* section, const char* columns) const
{
  if (line.size() < n)
    fail(where(), fmt::format("found {} words in a line of {}", line.size(), section), "", columns);
  std::array<double, n> result{};
  for (std::size_t k = 0; k < n; ++k) {
    const auto value = number(line[k]);
    if (!value) fail(where(), "is no number", "'" + line[k] + "'");
    result[k] = *value;
  }
  return result;
}

void DataFile::header_line(const Line& line)
{
  if (line.size() == 2 && line[1] == "atoms") atoms = *number(line[0]);
  if (line.size() == 3 && line[1] == "atom" && line[2] == "types")
    types = static_cast<int>(std::clamp(*number(line[0]), 0.0, 1e4));
  static constexpr std::array<std::string_view, 3> sides{"xlo", "ylo", "zlo"};
  for (std::size_t k = 0; k < 3; ++k)
    if (line.size() == 4 && line[2] == sides[k]) {
      const auto low = number(line[0]), high = number(line[1]);
      if (!low || !high) continue;
      domain.low[k] = *low;
      domain.high[k] = *high;
    }
}

void DataFile::atom(const Line& line)
{
  const auto [id, type, diameter, density, x, y, z] =
      numbers<7>(line, "Atoms", "id type diameter density x y z");
  Source& s = sources[static_cast<int>(std::clamp(type, 0.0, 1e6))];
  const double radius = 0.5 * diameter;
  const bool is_first = s.count == 0;
  const bool all_together = static_cast<double>(s.together.size()) == s.count;
  if (is_first || (all_together && radius == s.radius_max && density == s.density))
    s.together.push_back({x, y, z});
  else
    s.together.clear();
  s.radius_min = is_first ? radius : std::min(s.radius_min, radius);
  s.radius_max = std::max(s.radius_max, radius);
  s.density = std::max(s.density, density);
  s.centres.include(Vec3{x, y, z});
  s.count += 1;
  source_of_[id] = &s;
}

void DataFile::velocity(const Line& line)
{
  // the angular velocity that follows moves no centre
  const auto [id, vx, vy, vz] = numbers<4>(line, "Velocities", "id vx vy vz");
  const auto found = source_of_.find(id);
  if (found == source_of_.end()) fail(where(), "Velocities of an atom that Atoms lacks", line[0]);
  Source& s = *found->second;
  s.speed = std::max(s.speed, norm(Vec3{vx, vy, vz}));
  if (s.speed > 0) s.together.clear();
}

}  // namespace

void follow_read_data(Reading& reading, Words w)
{
  const std::string path = w.path();
  std::error_code ignored;
  std::ifstream in(path);
  if (!in || !std::filesystem::is_regular_file(path, ignored))
    fail(w.where(), "the file of read_data cannot be read", "'" + path + "'");
  DataFile file(path);
  file.read(in);
  if (file.atoms > 0 && file.sources.empty())
    reading.note(w.where(), fmt::format("'{}' holds no section Atoms", path));
  if (file.types > 0) reading.scene.types = file.types;
  for (std::size_t k = 0; k < 3; ++k)
    if (file.domain.low[k] <= file.domain.high[k]) {
      reading.scene.domain.low[k] = file.domain.low[k];
      reading.scene.domain.high[k] = file.domain.high[k];
    }
  for (auto& [type, source] : file.sources) {
    source.type = type;
    source.where = path;
    reading.scene.sources.push_back(source);
  }
}

void follow_read_restart(Reading& reading, Words w)
{
  const std::string what = fmt::format("{}: read_restart: its particles are not read", w.where());
  reading.scene.unknown_particles.push_back(what);
  reading.scene.unknown_heights.push_back(what);  // --drop-height stands for their kinetic energy as well
}

}  // namespace granulaw::deck
