#include "deck/convert/time_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>

namespace granulaw::deck {

namespace {

using Words = std::vector<std::string>;

/// Places of the counts in `fix ID GROUP STYLE ...`, and words behind which one stands.
struct FixCounts
{
  std::vector<std::size_t> places;
  std::vector<std::string> keywords;
};

FixCounts counts_of_fix(const std::string& style)
{
  static const std::map<std::string, FixCounts> known{
      {"ave/time", {{4, 6}, {}}},
      {"ave/spatial", {{4, 6}, {}}},
      {"ave/atom", {{4, 6}, {}}},
      {"ave/histo", {{4, 6}, {}}},
      {"ave/correlate", {{4, 6}, {}}},
      {"ave/euler", {{}, {"nevery"}}},
      {"ave/euler/region", {{}, {"nevery"}}},
      {"print", {{4}, {}}},
      {"adapt", {{4}, {}}},
      {"check/timestep/gran", {{4}, {}}},
      {"check/timestep/sph", {{4}, {}}},
      {"momentum", {{4}, {}}},
      {"store/state", {{4}, {}}},
      {"deform", {{4}, {}}},
      {"couple/cfd", {{}, {"couple_every", "every"}}},
      {"massflow/mesh/sieve", {{}, {}}},
  };
  if (style.starts_with("insert/")) return {{}, {"insert_every", "start"}};
  const auto found = known.find(style);
  return found == known.end() ? FixCounts{} : found->second;
}

/// Places of the words of a command that are numbers of time steps.
std::vector<std::size_t> step_counts(const Words& words)
{
  std::vector<std::size_t> places;
  if (words.size() < 2) return places;
  const std::string& command = words[0];
  const auto behind = [&](const std::vector<std::string>& keywords, std::size_t from) {
    for (std::size_t k = from; k + 1 < words.size(); ++k)
      if (std::find(keywords.begin(), keywords.end(), words[k]) != keywords.end()) places.push_back(k + 1);
  };
  if (command == "run") {
    places.push_back(1);
    behind({"start", "stop", "every"}, 2);
  } else if (command == "thermo" || command == "restart" || command == "reset_timestep") {
    places.push_back(1);
  } else if (command == "dump" && words.size() > 4) {
    places.push_back(4);
  } else if (command == "dump_modify") {
    behind({"every"}, 2);
  } else if (command == "fix" && words.size() > 3) {
    const FixCounts counts = counts_of_fix(words[3]);
    for (const std::size_t k : counts.places)
      if (k < words.size()) places.push_back(k);
    behind(counts.keywords, 4);
  }
  return places;
}

/// The variable that a word is, "${name}" or "$n"; empty: it is none.
std::string variable_of(const std::string& word)
{
  if (word.size() > 3 && word.starts_with("${") && word.find('}') == word.size() - 1) return word.substr(2, word.size() - 3);
  return word.size() == 2 && word[0] == '$' && word[1] != '(' ? word.substr(1) : std::string();
}

/// The formula of "$(formula)"; empty: the word is none.
std::string formula_of(const std::string& word)
{
  return word.size() > 3 && word.starts_with("$(") && word.back() == ')' ? word.substr(2, word.size() - 3) : std::string();
}

/// The word with another text between its quotes.
std::string with_text(const Word& word, const std::string& text)
{
  const bool is_quoted = word.unquoted().size() < word.text.size();
  return is_quoted ? word.text[0] + text + word.text[0] : text;
}

bool is_rounded(const std::string& formula) { return formula.starts_with("round(") || formula.starts_with("ceil(") || formula.starts_with("floor("); }

bool is_average(const Words& words) { return words.size() > 6 && words[0] == "fix" && words[3].starts_with("ave/"); }

bool is_definition(const DeckLine& line, const std::string& name) { return line.words.size() >= 4 && line.words[0].text == "variable" && line.words[1].text == name; }

}  // namespace

TimeSteps::TimeSteps(EditedDeck& deck, const Scene& scene, const Conversion& conversion) : deck_(deck), scene_(scene), conversion_(conversion)
{
  deck_.each_command([&](const At& at) {
    const Words words = raw_words(at.line());
    if (words[0] == "variable")
      for (std::size_t k = 3; k < words.size(); ++k) variables_.define(words[1], words[k]);
  });
}

void TimeSteps::change_steps()
{
  if (!is_changed()) return;
  deck_.each_command([&](const At& at) { change_step(at); });
  keep_whole_numbers();
}

std::string TimeSteps::new_variable(const At& at, const std::string& formula, const std::string& kind)
{
  const std::string name = fmt::format("granulaw_{}_{}", kind, ++made_);
  at.file->insert_before(at.index, fmt::format("variable {} equal {}", name, formula));
  return fmt::format("${{{}}}", name);
}

/// Its variable's definition, or its own word.
void TimeSteps::change_step(const At& at)
{
  DeckLine& line = at.line();
  if (line.words.size() < 2 || line.words[0].text != "timestep") return;
  const double f = conversion_.step_factor;
  const std::string why = fmt::format("the time step of the real contacts: {:g} times shorter", f);
  const std::string raw = line.words[1].unquoted();
  if (conversion_.variables_follow && change_definition(variable_of(raw))) return;
  const Words words = deck_.words_of(at);
  const auto value = number_in(words.size() > 1 ? words[1] : raw);
  if (value && deck_.executed(at).size() <= 1)
    deck_.replace_word(at, 1, fmt::format("{:.10g}", *value / f), why);
  else if (line.words[1].has_variable())
    deck_.replace_word(at, 1, new_variable(at, fmt::format("({})/{:g}", raw, f), "step"), why);
  else
    deck_.leave(at, "its time step is no number");
}

/// "variable NAME equal VALUE", each that the deck has. False: none can be changed.
bool TimeSteps::change_definition(const std::string& name)
{
  if (step_variables_.contains(name)) return true;
  const double f = conversion_.step_factor;
  const std::string why = fmt::format("the time step of the real contacts: {:g} times shorter", f);
  bool changed = false;
  if (std::any_of(scene_.presets.begin(), scene_.presets.end(), [&](const auto& p) { return p.first == name; })) return false;
  deck_.each_command([&](const At& at) {
    if (!is_definition(at.line(), name)) return;
    const std::string style = at.line().words[2].text;
    const Word& word = at.line().words[3];
    const auto value = number_in(word.unquoted());
    if (style == "equal")
      deck_.replace_word(at, 3, with_text(word, value ? fmt::format("{:.10g}", *value / f) : fmt::format("({})/{:g}", word.unquoted(), f)), why);
    else if ((style == "index" || style == "string") && value && at.line().words.size() == 4)
      deck_.replace_word(at, 3, with_text(word, fmt::format("{:.10g}", *value / f)), why);
    else
      return;
    changed = true;
  });
  if (changed) step_variables_.insert(name);
  return changed;
}

/// LIGGGHTS takes no count with a fraction.
void TimeSteps::keep_whole_numbers()
{
  std::set<std::string> whole;
  deck_.each_command([&](const At& at) {
    const auto done = deck_.executed(at);
    const Words raw = raw_words(at.line());
    if (done.empty() || raw[0] == "if") return;
    for (std::size_t k = 1; k < raw.size(); ++k) {
      const bool was_whole = std::all_of(
          done.begin(), done.end(), [&](const DeckCommand* c) { return c->words.size() == raw.size() && c->words[0] == raw[0] && whole_number_in(c->words[k]); });
      if (!was_whole || !follows(raw[k])) continue;
      if (const std::string name = variable_of(raw[k]); !name.empty()) whole.insert(name);
      if (const std::string formula = formula_of(raw[k]); !formula.empty() && !is_rounded(formula))
        deck_.replace_word(at, k, fmt::format("$(round({}))", formula), "a whole number stays one under the new time step");
    }
  });
  for (const std::string& name : whole) keep_whole(name);
}

void TimeSteps::keep_whole(const std::string& name)
{
  if (step_variables_.contains(name)) return;
  deck_.each_command([&](const At& at) {
    if (!is_definition(at.line(), name) || at.line().words[2].text != "equal") return;
    const Word& word = at.line().words[3];
    if (const std::string formula = word.unquoted(); !is_rounded(formula) && follows(formula))
      deck_.replace_word(at, 3, with_text(word, fmt::format("round({})", formula)), "a whole number stays one under the new time step");
  });
}

/// The count that a word gives once the steps are changed: one that follows them grows as they shrink.
double TimeSteps::count_now(const At& at, std::size_t k, double old) const
{
  const Words raw = raw_words(at.line());
  return k < raw.size() && follows(raw[k]) ? scaled(old) : old;
}

double TimeSteps::scaled(double count) const
{
  constexpr double most = 2147483647;
  return std::min(most, std::max(1.0, std::round(count * conversion_.step_factor)));
}

/// The stride of an average: its period is a multiple of it, and holds all repetitions.
double TimeSteps::wanted_stride(const At& at, const Words& words, double old) const
{
  const double most = scaled(old), period = scaled(whole_number_in(words[6]).value_or(0)), repetitions = count_now(at, 5, whole_number_in(words[5]).value_or(1));
  const bool period_follows = at.line().words.size() == words.size() && follows(at.line().words[6].text);
  const double least = period_follows ? 1 : std::max(1.0, std::floor(most / 2));
  for (double stride = most; stride >= least; --stride)
    if (stride * repetitions <= period && std::fmod(period, stride) == 0) return stride;
  return std::max(1.0, std::min(most, std::floor(period / repetitions)));
}

void TimeSteps::convert_counts(const At& at, const Words& words)
{
  if (!is_changed()) return;
  const double f = conversion_.step_factor;
  const auto done = deck_.executed(at);
  const Words raw = raw_words(at.line());
  double stride = 1;  // of an average
  for (const std::size_t k : step_counts(words)) {
    if (words[k].starts_with("v_"))
      deck_.leave(at, fmt::format("its count of steps comes from variable {}, and there are {:g} times as many now", words[k].substr(2), f));
    const auto old = whole_number_in(words[k]);
    if (!old || *old == 0 || (words[0] == "run" && k == 1 && *old <= 1)) continue;
    const bool is_stride = is_average(words) && k == 4, is_period = is_average(words) && k == 6;
    const double want = is_stride ? wanted_stride(at, words, *old) : is_period ? stride * std::floor(scaled(*old) / stride) : scaled(*old);
    const double now = count_now(at, k, *old);
    const bool stays = std::abs(now / want - 1) < 0.01 + 1 / want && !(is_average(words) && now != *old);
    if (is_stride) stride = stays ? now : want;
    if (stays) continue;
    if (words.size() != raw.size()) {
      deck_.leave(at, fmt::format("its count of steps {} should be {:.0f}", words[k], want));
      continue;
    }
    const bool varies =
        std::any_of(done.begin(), done.end(), [&](const DeckCommand* c) { return c->words[0] == words[0] && k < c->words.size() && c->words[k] != words[k]; });
    const std::string why = fmt::format("{:g} times as many steps, the same time", f);
    const std::string formula = fmt::format("{:g}*{}", scaled(*old) / now, raw[k]);
    if (!varies)
      deck_.replace_word(at, k, fmt::format("{:.0f}", want), why);
    else
      deck_.replace_word(
          at, k, new_variable(at, is_period ? fmt::format("{0}*floor({1}/{0})", at.line().words[4].text, formula) : fmt::format("round({})", formula), "steps"), why);
  }
}

bool TimeSteps::is_left_in_branch(const Words& words) const
{
  if (!is_changed()) return false;
  std::vector<std::size_t> counts = step_counts(words);
  if (words[0] == "timestep") counts.push_back(1);
  return std::any_of(counts.begin(), counts.end(), [&](std::size_t k) { return !follows(words[k]); });
}

void TimeSteps::warn_of_step(const At& at)
{
  const std::string command = at.line().words[0].text;
  if (!is_changed() || (command != "if" && command != "variable")) return;
  static const std::set<std::string> ends{"", "(", ")", "+", "-", "*", "/", "<", ">", "=", " ", "{", "}", ",", "\"", "'"};
  const std::string text = at.line().text();
  for (auto at_step = text.find("step"); at_step != std::string::npos; at_step = text.find("step", at_step + 1)) {
    const std::string before = at_step > 0 ? text.substr(at_step - 1, 1) : "", behind = text.substr(at_step + 4, 1);
    if (!ends.contains(before) || !ends.contains(behind)) continue;
    if (!follows(text)) deck_.leave(at, fmt::format("it depends on the number of the step, and there are {:g} times as many now", conversion_.step_factor));
    return;
  }
}

bool TimeSteps::more_than_counts_follow() const
{
  static const std::set<std::string> not_compared{"variable", "timestep", "print", "if", "next", "label", "jump"};
  bool more = false;
  deck_.each_command([&](const At& at) {
    const Words raw = raw_words(at.line()), words = deck_.words_of(at);
    if (!is_changed() || not_compared.contains(words[0]) || is_fix(words, "print") || words.size() != raw.size()) return;
    const std::vector<std::size_t> counts = step_counts(words);
    for (std::size_t k = 1; k < raw.size(); ++k)
      more |= raw[k].find('$') != std::string::npos && follows(raw[k]) && std::find(counts.begin(), counts.end(), k) == counts.end();
  });
  return more;
}

bool DeckVariables::follows(const std::string& text, const std::set<std::string>& roots) const
{
  std::set<std::string> seen;
  return follows(text, roots, seen);
}

bool DeckVariables::any_follows(const std::set<std::string>& roots) const
{
  return std::any_of(formulas_.begin(), formulas_.end(),
      [&](const auto& entry) { return std::any_of(entry.second.begin(), entry.second.end(), [&](const std::string& f) { return follows(f, roots); }); });
}

bool DeckVariables::follows(const std::string& text, const std::set<std::string>& roots, std::set<std::string>& seen) const
{
  static const std::regex names(R"(\$\{(\w+)\}|\$(\w)|\bv_(\w+)|\b(dt)\b)");
  for (std::sregex_iterator at(text.begin(), text.end(), names), end; at != end; ++at) {
    if ((*at)[4].matched) return true;
    const std::string name = (*at)[1].str() + (*at)[2].str() + (*at)[3].str();
    if (roots.contains(name)) return true;
    const auto found = formulas_.find(name);
    if (found == formulas_.end() || !seen.insert(name).second) continue;
    if (std::any_of(found->second.begin(), found->second.end(), [&](const std::string& f) { return follows(f, roots, seen); })) return true;
  }
  return false;
}

}  // namespace granulaw::deck
