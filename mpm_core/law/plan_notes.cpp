#include "law/plan_notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "law/range.hpp"

namespace granulaw {

namespace {

std::string note_of(const Law& law, const std::string& name)
{
  const auto found = law.provenance.find(name);
  return found == law.provenance.end() ? std::string() : found->second;
}

std::string planned_note(const std::string& a, const std::string& b)
{
  return fmt::format("planned.{}:{}", std::min(a, b), std::max(a, b));
}

struct Planned
{
  double overlap = 0, speed = 0;  // over R*; m/s; 0: nothing was
};
Planned planned_of(const Law& law, const std::string& a, const std::string& b)
{
  Planned planned;
  std::istringstream(note_of(law, planned_note(a, b))) >> planned.overlap >> planned.speed;
  return planned;
}

/// A fifth more, in two digits: the next simulation differs.
double next_depth(double overlap)
{
  const double depth = 1.2 * std::max(overlap, 1e-3), unit = std::pow(10.0, std::floor(std::log10(depth)) - 1);
  return std::clamp(std::ceil(depth / unit) * unit, shallowest_table, deepest_law);
}

/// The command that made the law, to another depth.
std::string table_line(const Law& law, double depth)
{
  std::istringstream words(note_of(law, command_note));
  std::string line, word;
  for (int place = 0; words >> word; ++place) {
    if (place == 1 && word != "table") break;
    if (word == "--depth") {
      words >> word;
      continue;
    }
    if (!word.starts_with("--depth=")) line += (place == 0 ? "mpm" : word) + std::string(" ");
  }
  if (!line.starts_with("mpm table ")) {
    line = "mpm table MATERIALS.toml ";
    for (const LawPair& pair : law.pairs) line += fmt::format("--pair {}:{} ", pair.a, pair.b);
    line += "-o law.h5 ";
  }
  return fmt::format("{}--depth {:g}", line, depth);
}

}  // namespace

void note_planned(Law& law, const std::string& a, const std::string& b, double overlap, double speed)
{
  std::string& note = law.provenance[planned_note(a, b)];
  if (note.empty() || overlap > std::atof(note.c_str())) note = fmt::format("{:.3g} {:.3g}", overlap, speed);
}

std::string planned_text(const Law& law, const std::string& a, const std::string& b, double stretch)
{
  const Planned planned = planned_of(law, a, b);
  if (!(planned.overlap > 0)) return {};
  return fmt::format("planned for {}: d/R* {:.3g} at {:.3g} m/s", note_of(law, deck_note), planned.overlap * stretch, planned.speed);
}

std::string remedy_beyond(const Law& law, const std::string& a, const std::string& b, double overlap, double end, double table_end)
{
  const double per_overlap = table_end / end;
  if (overlap * per_overlap > deepest_law)
    return fmt::format(
        "no law goes beyond {:g} of the radius: the material is too soft for these speeds or loads; where "
        "youngs_modulus is lowered for the time step, give the real one",
        deepest_law);
  if (table_end < 0.99 * std::atof(note_of(law, depth_note).c_str()))
    return "no law of this pair goes deeper: its contact is nearly as wide as the smaller body";
  const double largest = std::max(overlap, planned_of(law, a, b).overlap);
  return fmt::format("build a deeper law by '{}'", table_line(law, next_depth(largest * per_overlap)));
}

}  // namespace granulaw
