#include "deck/convert/page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "base/error.hpp"
#include "deck/tangential_need.hpp"
#include "liggghts_plugin/deck/keywords.hpp"

namespace granulaw::deck {

namespace {

std::string state_line(const ShortRun& run)
{
  if (!run.ended) return "stopped: " + complaint(run.said);
  return fmt::format("{:.0f} steps, {:.4g} s, {:.0f} particles, kinetic energy {:.4g}", run.steps, run.time, run.particles, run.kinetic_energy);
}

std::string as_code(const std::string& text)
{
  std::string code;
  for (const char ch : printable(text)) code += ch == '|' ? std::string("\\|") : std::string(1, ch);
  return code.empty() ? "" : "`" + code + "`";
}

}  // namespace

std::vector<std::string> check_lines(const Checked& checked)
{
  std::vector<std::string> lines{"check, original: " + state_line(checked.before), "check, converted: " + state_line(checked.after)};
  if (!checked.files_missing.empty()) lines.push_back(fmt::format("check: only the original wrote {}", fmt::join(checked.files_missing, ", ")));
  if (!checked.files_new.empty()) lines.push_back(fmt::format("check: only the converted deck wrote {}", fmt::join(checked.files_new, ", ")));
  return lines;
}

std::string time_step_line(const Converted& c)
{
  if (!(c.step.deck_step > 0)) return "nothing moves: the time step stays";
  const double now = c.step.deck_step / c.conversion.step_factor;
  std::string text = fmt::format("{:.4g} s", c.step.deck_step);
  if (c.conversion.step_factor > 1)
    text += fmt::format(" becomes {:.4g} s, every count of steps {:g} times as large", now, c.conversion.step_factor);
  else
    text += " stays";
  if (c.conversion.stretch > 1) text += fmt::format("; stretch {:g}", c.conversion.stretch);
  if (c.conversion.step_factor > 1 && !c.step.bound.empty()) text += fmt::format(" (no more by the {})", c.step.bound);
  return text;
}

std::string tangential_line(const Converted& c)
{
  for (const DeckCommand& command : c.planned.scene.commands)
    if (std::find(command.words.begin(), command.words.end(), plugin::own_tangential_model) != command.words.end()) return "";
  const TangentialNeed need = tangential_need(c.planned.scene, c.planned.plan);
  return need.pair ? fmt::format("`tangential plastic` suits this deck: {}. It costs time (docs/guide/tangential.md)", need.reason) : "";
}

std::string run_line(const Converted& c)
{
  std::string line = fmt::format("cd {} && liggghts-mpm", c.folder.string());
  for (const std::string& word : words_of(c.deck.filename().string(), c.planned.scene.presets)) line += " " + word;
  return line;
}

std::string page(const Converted& c, const std::string& command)
{
  const PlannedDeck& d = c.planned;
  std::string text =
      fmt::format("# {}, converted to model mpm\n\n{}\n\nMade by `{}`. Run it:\n\n    {}\n\n", d.scene.deck, original_line(d.scene, c.folder), command, run_line(c));
  text += "| | |\n|---|---|\n";
  for (int t = 1; t <= d.scene.types; ++t) {
    const std::string& name = c.conversion.materials[static_cast<std::size_t>(t) - 1];
    const auto young = c.conversion.youngs_modulus.find(t);
    text += fmt::format("| atom type {} | {}{}{} |\n", t, name, d.options.materials.contains(t) ? "" : ", rigid",
        young == c.conversion.youngs_modulus.end() ? "" : fmt::format(", E {:.4g} Pa", young->second));
  }
  text += fmt::format("| {} | {} |\n", c.conversion.law, c.law_pairs.empty() ? "none: no particle has a law" : fmt::format("{}", fmt::join(c.law_pairs, ", ")));
  text += fmt::format("| time step | {} |\n", time_step_line(c));
  if (const std::string line = tangential_line(c); !line.empty()) text += fmt::format("| tangential law | {} |\n", line);
  for (const PairPlan& p : d.plan.pairs)
    text += fmt::format("| {} {}:{} | up to {:.3g} m/s, overlap {:.3g} R*, I {:.3g}; time step {} |\n", types_text(p.meeting), p.meeting.name_a, p.meeting.name_b,
        p.speed, p.overlap * c.conversion.stretch, p.damage_number,
        std::isfinite(p.time_step) && p.time_step > 0 ? fmt::format("{:.3g} s, times the stretch", p.time_step) : "any");
  for (const std::string& answer : c.accepted) text += fmt::format("| taken from the deck | {} |\n", answer);
  if (c.checked) {
    text += "\n## Check\n\n";
    for (const std::string& line : check_lines(*c.checked)) text += fmt::format("- {}\n", printable(line));
  }
  text += "\n## Changed lines\n\n| line of the original | before | after | reason |\n|---|---|---|---|\n";
  for (const Change& change : c.result.changes)
    text += fmt::format("| {} | {} | {} | {} |\n", change.where, change.before.empty() ? "(added)" : as_code(change.before),
        change.after.empty() ? "(removed)" : as_code(change.after), printable(change.why));
  text += "\n## Not converted\n\n";
  for (const std::string& left : c.result.left) text += fmt::format("- {}\n", printable(left));
  for (const std::string& note : d.scene.notes) text += fmt::format("- not followed by the plan: {}\n", printable(note));
  for (const std::string& path : c.restarts)
    text += fmt::format(
        "- {}: a restart file of the original. Its contacts are of another model: convert and run the deck that writes it, and put the new file here\n", path);
  if (c.result.left.empty() && d.scene.notes.empty() && c.restarts.empty()) text += "Nothing is left.\n";
  return text;
}

namespace {

namespace fs = std::filesystem;

/// Names without the number of the step.
std::set<std::string> without_numbers(const std::vector<std::string>& files)
{
  std::set<std::string> names;
  for (const std::string& file : files) {
    std::string name;
    for (const char ch : file) {
      const bool digit = ch >= '0' && ch <= '9';
      if (!digit)
        name += ch;
      else if (name.empty() || name.back() != '*')
        name += '*';
    }
    names.insert(name);
  }
  return names;
}

/// Those of `a` that are not in `b`.
std::vector<std::string> alone(const std::vector<std::string>& a, const std::vector<std::string>& b)
{
  const std::set<std::string> in_a = without_numbers(a), in_b = without_numbers(b);
  std::vector<std::string> result;
  std::set_difference(in_a.begin(), in_a.end(), in_b.begin(), in_b.end(), std::back_inserter(result));
  return result;
}

}  // namespace

Checked check(const Scene& scene, const fs::path& folder, double step_factor)
{
  constexpr long long steps = 300;
  const std::string name = fs::path(scene.deck).filename().string();
  const ShortRun before = short_run(scene.folder, words_of(scene.folder.empty() ? scene.deck : name, scene.presets), steps);
  const double done = before.ended ? before.steps : static_cast<double>(steps);
  const ShortRun after = short_run(folder.string(), words_of(name, scene.presets), static_cast<long long>(std::ceil(done * step_factor)));
  return {before, after, alone(before.files, after.files), alone(after.files, before.files)};
}

}  // namespace granulaw::deck
