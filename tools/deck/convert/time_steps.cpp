#include "deck/convert/time_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "deck/convert/step_counts.hpp"

namespace granulaw::deck {

namespace {

using Words = std::vector<std::string>;

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

bool is_rounded(const std::string& formula)
{
  return formula.starts_with("round(") || formula.starts_with("ceil(") || formula.starts_with("floor(");
}

bool is_average(const Words& words)
{
  return words.size() > 6 && words[0] == "fix" && words[3].starts_with("ave/");
}

bool is_definition(const DeckLine& line, const std::string& name)
{
  return line.words.size() >= 4 && line.words[0].text == "variable" && line.words[1].text == name;
}

}  // namespace

TimeSteps::TimeSteps(EditedDeck& deck, const Scene& scene, const Conversion& conversion, const Scene* probe)
    : deck_(deck), scene_(scene), conversion_(conversion)
{
  if (probe) probe_.emplace(*probe);
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
      const bool was_whole = std::all_of(done.begin(), done.end(), [&](const DeckCommand* c) {
        return c->words.size() == raw.size() && c->words[0] == raw[0] && whole_number_in(c->words[k]);
      });
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

/// The count that stands at this place once the steps are changed.
std::optional<double> TimeSteps::count_now(const At& at, std::size_t k, const std::string& old) const
{
  if (!probe_) return whole_number_in(old);
  const auto& done = probe_->at(at.file->path(), at.line().first);
  if (done.empty() || k >= done[0]->words.size()) return whole_number_in(old);
  return whole_number_in(done[0]->words[k]);
}

double TimeSteps::scaled(double count) const
{
  constexpr double most = 2147483647;
  return std::min(most, std::max(1.0, std::round(count * conversion_.step_factor)));
}

/// The stride of an average: its period is a multiple of it, and holds all repetitions.
double TimeSteps::wanted_stride(const At& at, const Words& words, double old) const
{
  const bool period_follows = at.line().words.size() == words.size() && follows(at.line().words[6].text);
  const double period_now = count_now(at, 6, words[6]).value_or(0), repetitions = count_now(at, 5, words[5]).value_or(1);
  const double most = scaled(old), period = period_follows ? period_now : scaled(whole_number_in(words[6]).value_or(0));
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
    if (words[k].starts_with("v_")) deck_.leave(at, fmt::format("its count of steps comes from variable {}, and there are {:g} times as many now", words[k].substr(2), f));
    const auto old = whole_number_in(words[k]);
    if (!old || *old == 0 || (words[0] == "run" && k == 1 && *old <= 1)) continue;
    const bool is_stride = is_average(words) && k == 4, is_period = is_average(words) && k == 6;
    const double want = is_stride ? wanted_stride(at, words, *old) : is_period ? stride * std::floor(scaled(*old) / stride) : scaled(*old);
    const auto now = count_now(at, k, words[k]);
    const bool stays = now && std::abs(*now / want - 1) < 0.01 + 1 / want;
    if (is_stride) stride = stays ? *now : want;
    if (stays) continue;
    if (words.size() != raw.size()) {
      deck_.leave(at, fmt::format("its count of steps {} should be {:.0f}", words[k], want));
      continue;
    }
    const bool varies = std::any_of(done.begin(), done.end(), [&](const DeckCommand* c) {
      return c->words[0] == words[0] && k < c->words.size() && c->words[k] != words[k];
    });
    const std::string why = fmt::format("{:g} times as many steps, the same time", f);
    const std::string formula = fmt::format("{:g}*{}", now ? scaled(*old) / *now : f, raw[k]);
    if (!varies)
      deck_.replace_word(at, k, fmt::format("{:.0f}", want), why);
    else
      deck_.replace_word(at, k, new_variable(at, is_period ? fmt::format("{0}*floor({1}/{0})", at.line().words[4].text, formula) : fmt::format("round({})", formula), "steps"), why);
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
    if (!follows(text))
      deck_.leave(at, fmt::format("it depends on the number of the step, and there are {:g} times as many now", conversion_.step_factor));
    return;
  }
}

bool only_counts_follow(const Scene& scene, const Scene& probe)
{
  static const std::set<std::string> not_compared{"variable", "timestep", "print", "if", "next", "label", "jump"};
  const Executed after(probe);
  return std::all_of(scene.commands.begin(), scene.commands.end(), [&](const DeckCommand& c) {
    const auto& now = after.at(c.file, c.line);
    if (not_compared.contains(c.words[0]) || is_fix(c.words, "print")) return true;
    const std::vector<std::size_t> counts = step_counts(c.words);
    return std::any_of(now.begin(), now.end(), [&](const DeckCommand* d) {
      if (d->words.size() != c.words.size()) return false;
      for (std::size_t k = 0; k < c.words.size(); ++k) {
        const auto was = number_in(c.words[k]), is = number_in(d->words[k]);
        const bool same = c.words[k] == d->words[k] || (was && is && std::abs(*is - *was) <= 0.01 * std::abs(*was));
        if (!same && std::find(counts.begin(), counts.end(), k) == counts.end()) return false;
      }
      return true;
    });
  });
}

}  // namespace granulaw::deck
