#include "deck/convert/convert.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include "base/error.hpp"
#include "deck/convert/deck_text.hpp"
#include "deck/convert/model_words.hpp"
#include "deck/convert/step_counts.hpp"

namespace granulaw::deck {

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

std::string join(const Words& words)
{
  return fmt::format("{}", fmt::join(words, " "));
}

/// A whole number, as LIGGGHTS writes and reads one.
std::optional<double> count_in(const std::string& text)
{
  if (text.empty() || text.find_first_not_of("0123456789") != std::string::npos || text.size() > 15) return {};
  return std::stod(text);
}

std::optional<double> number_in(const std::string& text)
{
  std::size_t end = 0;
  try {
    const double value = std::stod(text, &end);
    if (end == text.size() && std::isfinite(value)) return value;
  } catch (const std::exception&) {
  }
  return {};
}

/// The variable that a word is, "${name}" or "$n"; empty: it is none.
std::string variable_of(const std::string& word)
{
  if (word.size() > 3 && word.starts_with("${") && word.find('}') == word.size() - 1) return word.substr(2, word.size() - 3);
  return word.size() == 2 && word[0] == '$' ? word.substr(1) : std::string();
}

Words raw_words(const DeckLine& line)
{
  Words words;
  for (const Word& w : line.words) words.push_back(w.unquoted());
  return words;
}

bool is_fix(const Words& words, const char* style)
{
  return words.size() > 3 && words[0] == "fix" && words[3] == style;
}

bool is_property(const Words& words, const char* name)
{
  return is_fix(words, "property/global") && words.size() > 5 && words[4] == name;
}

/// Place of `gran` in a pair_style; 0: none.
std::size_t gran_of(const Words& words)
{
  if (words.empty() || words[0] != "pair_style") return 0;
  const auto at = std::find(words.begin() + 1, words.end(), "gran");
  return at == words.end() ? 0 : static_cast<std::size_t>(at - words.begin());
}

/// LIGGGHTS's words of the commands, by file and line.
class Executed
{
 public:
  explicit Executed(const Scene& scene)
  {
    for (std::size_t k = 0; k < scene.commands.size(); ++k) {
      const DeckCommand& c = scene.commands[k];
      by_place_[{c.file, c.line}].push_back(&c);
      order_.try_emplace({c.file, c.line}, k);
    }
  }
  /// Each with other words; empty: it was not executed.
  const std::vector<const DeckCommand*>& at(const std::string& file, int line) const
  {
    static const std::vector<const DeckCommand*> none;
    const auto found = by_place_.find({file, line});
    return found == by_place_.end() ? none : found->second;
  }
  std::size_t order(const std::string& file, int line) const
  {
    const auto found = order_.find({file, line});
    return found == order_.end() ? std::numeric_limits<std::size_t>::max() : found->second;
  }

 private:
  std::map<std::pair<std::string, int>, std::vector<const DeckCommand*>> by_place_;
  std::map<std::pair<std::string, int>, std::size_t> order_;
};

/// One place of a deck.
struct At
{
  DeckText* file = nullptr;
  std::size_t index = 0;
  DeckLine& line() const { return file->lines()[index]; }
  std::string where() const { return fmt::format("{}:{}", file->path(), line().first); }
};

class Converter
{
 public:
  Converter(const Scene& scene, const Conversion& conversion, const Scene* probe)
      : scene_(scene), conversion_(conversion), executed_(scene)
  {
    if (probe) probe_.emplace(*probe);
    for (const auto& [path, text] : command_files(scene)) texts_.emplace_back(path, text);
  }

  /// The definitions of variables that are time steps, alone. False: there are none.
  bool change_time_step_variables()
  {
    bool found = false;
    each_line([&](const At& at) { found = change_time_step(at, true) || found; });
    return found;
  }

  ConvertedDeck convert()
  {
    find_places();
    each_line([&](const At& at) { convert_line(at); });
    add_missing_moduli();
    allow_hard_particles();
    place_walls();
    return result();
  }

  ConvertedDeck result()
  {
    ConvertedDeck done;
    for (DeckText& text : texts_) done.files[text.path()] = text.text();
    done.changes = std::move(changes_);
    done.left = std::move(left_);
    return done;
  }

 private:
  template <class Visit>
  void each_line(Visit&& visit)
  {
    for (DeckText& text : texts_)
      for (std::size_t k = 0; k < text.lines().size(); ++k)
        if (!text.lines()[k].words.empty()) visit(At{&text, k});
  }

  /// As LIGGGHTS executed it; where it did not, or in a line that holds other commands, as it stands.
  Words words_of(const At& at) const
  {
    Words raw = raw_words(at.line());
    const auto& done = executed_.at(at.file->path(), at.line().first);
    if (done.empty() || raw[0] == "if" || done[0]->words[0] != raw[0]) return raw;
    return done[0]->words;
  }

  void note(const At& at, const std::string& before, const std::string& after, const std::string& why)
  {
    changes_.push_back({at.where(), before, after, why});
  }
  void leave(const At& at, const std::string& what) { left_.push_back(at.where() + ": " + what); }

  void replace(const At& at, const std::string& text, const std::string& why)
  {
    DeckLine& line = at.line();
    const std::string before = line.text();
    DeckLine now = parse_line(text);
    if (!now.words.empty()) now.words[0].blanks = line.words[0].blanks;
    now.comment = line.comment;
    now.first = line.first, now.last = line.last;
    line = now;
    note(at, before, line.text(), why);
  }
  void replace_word(const At& at, std::size_t word, const std::string& text, const std::string& why)
  {
    const std::string before = at.line().text();
    at.line().words[word].text = text;
    note(at, before, at.line().text(), why);
  }
  void remove(const At& at, const std::string& why)
  {
    note(at, at.line().text(), "", why);
    at.file->remove(at.index);
  }

  void find_places()
  {
    each_line([&](const At& at) {
      const Words words = words_of(at);
      if (gran_of(words) > 0) keep_first(first_pair_, at);
      if (words[0] == "create_box" || words[0] == "read_restart" || words[0] == "read_data") keep_first(box_, at);
      if (words[0] == "units") keep_first(units_, at);
      if (is_fix(words, "wall/gran")) keep_first(first_wall_, at);
      for (const char* name : {"youngsModulus", "YoungsModulus"}) has_young_ |= is_property(words, name);
      has_poisson_ |= is_property(words, "poissonsRatio");
      has_friction_ |= is_property(words, "coefficientFriction");
    });
  }

  void keep_first(std::optional<At>& first, const At& at) const
  {
    if (!first || executed(at) < executed(*first)) first = at;
  }

  void convert_line(const At& at)
  {
    const Words words = words_of(at);
    const std::string& command = words[0];
    replace_paths(at);
    if (command == "if") return look_into_branch(at);
    if (command == "pair_style") return convert_pair(at, words);
    if (is_fix(words, "wall/gran")) return convert_wall(at, words);
    if (is_fix(words, "property/global")) return convert_property(at, words);
    if (is_fix(words, "multicontact/halfspace"))
      return remove_fix(at, words, "it belongs to the surface model multicontact, which mpm does not take");
    if (command == "unfix" && words.size() > 1 && removed_.contains(words[1]))
      return remove(at, "its fix was removed");
    if (command == "hard_particles" && words.size() > 1) return say_hard_particles(at, words);
    if (command == "newton" && words.size() > 1 && words[1] == "on")
      return replace(at, "newton off", "a contact with memory needs it");
    if (command == "neighbor" && words.size() > 2 && words[2] == "multi")
      return replace(at, fmt::format("neighbor {} bin", words[1]),
                     "'multi' lets spheres of unlike size pass through each other");
    if (command == "run_style" && words.size() > 1 && words[1].starts_with("respa"))
      return replace(at, "run_style verlet", "LIGGGHTS does not call walls under respa");
    if (command == "jump") return convert_jump(at, words);
    if (command == "timestep") {
      change_time_step(at, false);
      return;
    }
    if (is_fix(words, "nve/limit") && conversion_.step_factor != 1)
      leave(at, "'fix nve/limit' limits the way in one time step, which is shorter now");
    if (conversion_.step_factor != 1) {
      convert_counts(at, words);
      warn_of_step(at, words);
    }
  }

  // ---------------------------------------------------------------- models

  std::string own_words() const
  {
    return fmt::format(" law {} materials {}{}", conversion_.law, fmt::join(conversion_.materials, " "),
                       conversion_.stretch > 1 ? fmt::format(" stretch {:g}", conversion_.stretch) : "");
  }

  std::string normal_model(const Words& words) const
  {
    const auto at = std::find(words.begin(), words.end(), "model");
    return at == words.end() || at + 1 == words.end() ? "" : *(at + 1);
  }

  static std::string reason(const ModelWords& model, const std::string& of)
  {
    std::string why = fmt::format("model {} becomes mpm", of.empty() ? "?" : of);
    for (const std::string& text : model.dropped) why += "; " + text;
    return why;
  }

  void leave_dropped(const At& at, const ModelWords& model)
  {
    for (const std::string& text : model.dropped)
      if (text.find("became") != std::string::npos || text.find("cohesion") != std::string::npos ||
          text.find("rolling_friction") != std::string::npos || text.find("surface") != std::string::npos)
        leave(at, text);
  }

  void convert_pair(const At& at, const Words& words)
  {
    const std::size_t gran = gran_of(words);
    if (gran == 0) {
      if (words.size() > 1 && words[1] != "none") leave(at, fmt::format("pair_style {} is no contact model", words[1]));
      return;
    }
    // of hybrid: its words end where another style begins
    std::size_t end = words.size();
    if (gran > 1)
      for (std::size_t k = gran + 1; k < words.size() && end == words.size(); ++k)
        if (words[k].starts_with("lubricate") || words[k].starts_with("sph") || words[k] == "gran" || words[k].starts_with("lj/") ||
            words[k].starts_with("bubble"))
          end = k;
    const Words own(words.begin() + static_cast<std::ptrdiff_t>(gran) + 1, words.begin() + static_cast<std::ptrdiff_t>(end));
    const ModelWords model = model_words(own, false);
    const Words before(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(gran) + 1),
        behind(words.begin() + static_cast<std::ptrdiff_t>(end), words.end());
    leave_dropped(at, model);
    replace(at,
            fmt::format("{} {}{}{}{}", join(before), join(model.words), own_words(), behind.empty() ? "" : " ", join(behind)),
            reason(model, normal_model(own)));
  }

  void convert_wall(const At& at, const Words& words)
  {
    const Words own(words.begin() + 4, words.end());
    const ModelWords model = model_words(own, true);
    leave_dropped(at, model);
    const bool alone = !first_pair_;
    replace(at, fmt::format("fix {} {} wall/gran {}{}", words[1], words[2], join(model.words), alone ? own_words() : ""),
            reason(model, normal_model(own)));
  }

  /// Walls, and heat conduction, go behind the pair_style that they take words from.
  void place_walls()
  {
    if (!first_pair_) return;
    std::vector<At> early;
    each_line([&](const At& at) {
      const Words words = words_of(at);
      const bool needs = is_fix(words, "wall/gran") || (words.size() > 3 && words[0] == "fix" && words[3].starts_with("heat/gran"));
      if (needs && !at.file->is_removed(at.index) && executed(at) < executed(*first_pair_)) early.push_back(at);
    });
    for (const At& at : early) {
      if (at.file == first_pair_->file && at.index < first_pair_->index) {
        note(at, at.line().text(), at.line().text(), fmt::format("moved behind its pair_style ({})", first_pair_->where()));
        at.file->move_behind(at.index, first_pair_->index);
      } else if (is_fix(words_of(at), "wall/gran")) {
        replace(at, at.line().text() + own_words(), "it stands before its pair_style");
      }
    }
  }

  std::size_t executed(const At& at) const { return executed_.order(at.file->path(), at.line().first); }

  // ---------------------------------------------------------------- materials

  double unit_of_pressure() const { return scene_.units == "cgs" ? 0.1 : 1.0; }

  void convert_property(const At& at, const Words& words)
  {
    if (is_property(words, "coefficientRestitution"))
      return remove_fix(at, words, "restitution follows from the material and the speed");
    if (is_property(words, "youngsModulus") || is_property(words, "YoungsModulus"))
      return set_values(at, words, conversion_.youngs_modulus, 1 / unit_of_pressure(),
                        "the real modulus of the material, as the law has it");
    if (is_property(words, "poissonsRatio"))
      return set_values(at, words, conversion_.poisson_ratio, 1, "Poisson's ratio of the material, as the law has it");
    if (is_property(words, "cohesionEnergyDensity") && conversion_.stretch > 1) return divide_cohesion(at, words);
  }

  void set_values(const At& at, const Words& words, const std::map<int, double>& values, double unit,
                  const std::string& why)
  {
    Words now = words;
    bool differs = false;
    for (const auto& [type, value] : values) {
      const std::size_t k = 5 + static_cast<std::size_t>(type);
      if (k >= now.size()) continue;
      const auto old = number_in(now[k]);
      const std::string text = fmt::format("{:.10g}", value * unit);
      if (old && std::abs(*old - value * unit) <= 1e-9 * std::abs(value * unit)) continue;
      now[k] = text;
      differs = true;
    }
    if (differs) replace(at, join(now), why);
  }

  void divide_cohesion(const At& at, const Words& words)
  {
    Words now = words;
    const double s2 = conversion_.stretch * conversion_.stretch;
    for (std::size_t k = 7; k < now.size(); ++k)
      if (const auto value = number_in(now[k])) now[k] = fmt::format("{:.10g}", *value / s2);
    replace(at, join(now), fmt::format("divided by the square of the stretch {:g}", conversion_.stretch));
  }

  void remove_fix(const At& at, const Words& words, const std::string& why)
  {
    removed_.insert(words[1]);
    remove(at, why);
  }

  /// Models like hooke/stiffness need none.
  void add_missing_moduli()
  {
    if (has_young_ && has_poisson_) return;
    const At place = box_ && first_pair_ && executed(*box_) > executed(*first_pair_) ? *box_
                     : first_pair_                                                  ? *first_pair_
                                                                                     : *first_wall_;
    const bool behind = box_ && place.file == box_->file && place.index == box_->index;
    const auto add = [&](const char* name, const std::map<int, double>& values, double unit) {
      std::string text = fmt::format("fix granulaw_{} all property/global {} peratomtype", name, name);
      for (int t = 1; t <= scene_.types; ++t) {
        const auto found = values.find(t);
        text += fmt::format(" {:.10g}", (found == values.end() ? fallback(values) : found->second) * unit);
      }
      note(place, "", text, "the normal model that was replaced needs no moduli; model mpm does");
      if (behind)
        place.file->insert_behind(place.index, text);
      else
        place.file->insert_before(place.index, text);
    };
    if (!has_young_) add("youngsModulus", conversion_.youngs_modulus, 1 / unit_of_pressure());
    if (!has_poisson_) add("poissonsRatio", conversion_.poisson_ratio, 1);
  }

  static double fallback(const std::map<int, double>& values)
  {
    return values.empty() ? 0.3 : values.begin()->second;
  }

  bool needs_hard_particles() const
  {
    return std::any_of(conversion_.youngs_modulus.begin(), conversion_.youngs_modulus.end(),
                       [](const auto& entry) { return entry.second > 1e9; });
  }

  void say_hard_particles(const At& at, const Words& words)
  {
    says_hard_ = true;
    if (words[1] != "yes" && needs_hard_particles())
      replace(at, "hard_particles yes", "LIGGGHTS demands it of moduli above 1e9 Pa");
  }

  void allow_hard_particles()
  {
    if (says_hard_ || !needs_hard_particles()) return;
    const At place = units_ ? *units_ : first_line();
    note(place, "", "hard_particles yes", "LIGGGHTS demands it of moduli above 1e9 Pa");
    if (units_)
      place.file->insert_behind(place.index, "hard_particles yes");
    else
      place.file->insert_before(place.index, "hard_particles yes");
  }

  At first_line()
  {
    for (DeckText& text : texts_)
      if (text.path() == main_file(scene_)) return {&text, 0};
    return {&texts_.front(), 0};
  }

  // ---------------------------------------------------------------- time

  std::string time_reason() const
  {
    return fmt::format("the time step of the real contacts: {:g} times shorter", conversion_.step_factor);
  }

  /// `variables_only`: where a variable is the step, its definition.
  bool change_time_step(const At& at, bool variables_only)
  {
    const double f = conversion_.step_factor;
    DeckLine& line = at.line();
    if (f == 1 || line.words.size() < 2 || line.words[0].text != "timestep") return false;
    const std::string raw = line.words[1].unquoted();
    if (const std::string name = variable_of(raw); !name.empty() && change_definition(name)) return true;
    if (variables_only) return false;
    const Words words = words_of(at);
    const auto value = number_in(words.size() > 1 ? words[1] : raw);
    if (value && executed_.at(at.file->path(), line.first).size() <= 1)
      replace_word(at, 1, fmt::format("{:.10g}", *value / f), time_reason());
    else if (line.words[1].has_variable()) {
      const std::string own = fmt::format("granulaw_step_{}", ++variables_);
      at.file->insert_before(at.index, fmt::format("variable {} equal ({})/{:g}", own, raw, f));
      replace_word(at, 1, fmt::format("${{{}}}", own), time_reason());
    } else
      leave(at, "its time step is no number");
    return true;
  }

  /// "variable NAME equal VALUE", each that the deck has. False: none can be changed.
  bool change_definition(const std::string& name)
  {
    if (changed_variables_.contains(name)) return true;
    const double f = conversion_.step_factor;
    bool changed = false;
    each_line([&](const At& at) {
      DeckLine& line = at.line();
      if (line.words.size() < 4 || line.words[0].text != "variable" || line.words[1].text != name) return;
      const std::string style = line.words[2].text, old = line.words[3].unquoted();
      const auto value = number_in(old);
      if (style == "equal")
        replace_word(at, 3, value ? fmt::format("{:.10g}", *value / f) : fmt::format("\"({})/{:g}\"", old, f), time_reason());
      else if ((style == "index" || style == "string") && value && line.words.size() == 4)
        replace_word(at, 3, fmt::format("{:.10g}", *value / f), time_reason());
      else
        return;
      changed = true;
    });
    if (changed) changed_variables_.insert(name);
    return changed;
  }

  /// The count that stands at this place now, after what the time step's variables changed.
  std::optional<double> count_now(const At& at, std::size_t k, const std::string& old) const
  {
    if (!probe_) return count_in(old);
    const auto& done = probe_->at(at.file->path(), at.line().first);
    if (done.empty() || k >= done[0]->words.size()) return count_in(old);
    return count_in(done[0]->words[k]);
  }

  void convert_counts(const At& at, const Words& words)
  {
    const double f = conversion_.step_factor;
    const auto& done = executed_.at(at.file->path(), at.line().first);
    const bool one_to_one = words.size() == at.line().words.size();
    std::map<std::size_t, double> ratio;  // by place
    for (const std::size_t k : step_counts(words)) {
      const auto old = count_in(words[k]);
      if (!old || *old == 0 || (words[0] == "run" && k == 1 && *old <= 1)) continue;
      const double want = wanted_count(words, k, *old, ratio);
      const auto now = count_now(at, k, words[k]);
      if (now && std::abs(*now / want - 1) < 0.01 + 1 / want) continue;
      if (!one_to_one) {
        leave(at, fmt::format("its count of steps {} should be {:.0f}", words[k], want));
        continue;
      }
      const bool varies = std::any_of(done.begin(), done.end(), [&](const DeckCommand* c) {
        return k < c->words.size() && c->words[k] != words[k];
      });
      ratio[k] = want / *old;
      const std::string why = fmt::format("{:g} times as many steps, the same time", f);
      if (varies) {
        const std::string own = fmt::format("granulaw_steps_{}", ++variables_);
        at.file->insert_before(at.index, fmt::format("variable {} equal round({:g}*{})", own, now ? want / *now : f,
                                                     at.line().words[k].unquoted()));
        replace_word(at, k, fmt::format("${{{}}}", own), why);
      } else
        replace_word(at, k, fmt::format("{:.0f}", want), why);
    }
  }

  /// Averages: their period is a multiple of their stride.
  double wanted_count(const Words& words, std::size_t k, double old, const std::map<std::size_t, double>& ratio) const
  {
    constexpr double most = 2147483647;
    double factor = conversion_.step_factor;
    if (k == 6 && words[0] == "fix" && words[3].starts_with("ave/"))
      if (const auto stride = ratio.find(4); stride != ratio.end()) factor = stride->second;
    return std::min(most, std::max(1.0, std::round(old * factor)));
  }

  void look_into_branch(const At& at)
  {
    for (const Word& w : at.line().words) {
      const Words inner = raw_words(parse_line(w.unquoted()));
      if (inner.size() < 2) continue;
      const std::string& command = inner[0];
      const bool counts = conversion_.step_factor != 1 && !step_counts(inner).empty();
      if (command == "pair_style" || (command == "timestep" && conversion_.step_factor != 1) || counts ||
          is_fix(inner, "wall/gran") || is_fix(inner, "property/global"))
        leave(at, fmt::format("'{}' in a branch: change it by hand", join(inner)));
    }
    warn_of_step(at, raw_words(at.line()));
  }

  void warn_of_step(const At& at, const Words& words)
  {
    if (conversion_.step_factor == 1 || (words[0] != "if" && words[0] != "variable")) return;
    static const std::set<std::string> ends{"", "(", ")", "+", "-", "*", "/", "<", ">", "=", " ", "{", "}", ",", "\"", "'"};
    const std::string text = at.line().text();
    for (auto at_step = text.find("step"); at_step != std::string::npos; at_step = text.find("step", at_step + 1)) {
      const std::string before = at_step > 0 ? text.substr(at_step - 1, 1) : "", behind = text.substr(at_step + 4, 1);
      if (ends.contains(before) && ends.contains(behind)) {
        if (text.find("*dt") == std::string::npos && text.find("dt*") == std::string::npos)
          leave(at, fmt::format("it depends on the number of the step, and there are {:g} times as many now",
                                conversion_.step_factor));
        return;
      }
    }
  }

  void replace_paths(const At& at)
  {
    for (std::size_t k = 1; k < at.line().words.size(); ++k) {
      const std::string path = at.line().words[k].unquoted();
      if (!path.starts_with("..") || path.find_first_of(" \t\n") != std::string::npos) continue;
      if (const std::string within = path_within(scene_, path); within != path)
        replace_word(at, k, within, "the converted deck stands in another folder");
    }
  }

  /// The converted deck may stand in another folder than the one whose name it jumps to.
  void convert_jump(const At& at, const Words& words)
  {
    if (words.size() < 2 || at.line().words.size() < 2 || words[1] == "SELF") return;
    if (words[1] == at.file->path()) replace_word(at, 1, "SELF", "this file, wherever it stands");
  }

  const Scene& scene_;
  const Conversion& conversion_;
  Executed executed_;
  std::optional<Executed> probe_;
  std::vector<DeckText> texts_;
  std::vector<Change> changes_;
  std::vector<std::string> left_;
  std::set<std::string> removed_, changed_variables_;
  std::optional<At> first_pair_, first_wall_, box_, units_;
  bool has_young_ = false, has_poisson_ = false, has_friction_ = false, says_hard_ = false;
  int variables_ = 0;
};

}  // namespace

fs::path path_of(const Scene& scene, const std::string& path)
{
  return fs::path(scene.folder) / path;
}

std::string path_within(const Scene& scene, const std::string& path)
{
  std::string within = path;
  while (within.starts_with("../") || within.starts_with("./../")) within = within.substr(within.find("../") + 3);
  std::error_code ignored;
  const std::string own = fs::absolute(scene.deck, ignored).lexically_normal().parent_path().filename().string() + "/";
  if (within != path && within.starts_with(own)) within = within.substr(own.size());
  return within;
}

std::string main_file(const Scene& scene)
{
  return scene.folder.empty() ? scene.deck : fs::path(scene.deck).filename().string();
}

std::map<std::string, std::string> command_files(const Scene& scene)
{
  std::set<std::string> paths;
  for (const DeckCommand& c : scene.commands) paths.insert(c.file);
  if (paths.empty()) fail(scene.deck, "it has no command");
  std::map<std::string, std::string> texts;
  for (const std::string& path : paths) {
    const fs::path at = path_of(scene, path);
    std::ifstream in(at);
    std::ostringstream text;
    if (!(in && text << in.rdbuf())) fail(at.string(), "cannot be read");
    texts[path] = text.str();
  }
  return texts;
}

std::map<std::string, std::string> probe_deck(const Scene& scene, const Conversion& conversion)
{
  Converter converter(scene, conversion, nullptr);
  if (conversion.step_factor == 1 || !converter.change_time_step_variables()) return {};
  return converter.result().files;
}

void require_contact_model(const Scene& scene)
{
  std::string other = scene.deck;
  for (const DeckCommand& c : scene.commands) {
    if (gran_of(c.words) > 0 || is_fix(c.words, "wall/gran")) return;
    if (c.words[0] == "pair_style") other = fmt::format("{}:{}: 'pair_style {}'", c.file, c.line, c.words.size() > 1 ? c.words[1] : "");
  }
  fail(other, "the deck has neither pair_style gran nor fix wall/gran: there is no contact model to convert");
}

ConvertedDeck convert(const Scene& scene, const Conversion& conversion, const Scene* probe)
{
  require_contact_model(scene);
  return Converter(scene, conversion, probe).convert();
}

double largest_time_step(const Scene& scene)
{
  double largest = 0;
  for (const Run& r : scene.runs)
    if (r.integrates && r.steps > 0) largest = std::max(largest, r.time_step);
  return largest;
}

bool may_be_stretched(const Scene& scene)
{
  return std::none_of(scene.commands.begin(), scene.commands.end(), [](const DeckCommand& c) {
    const auto has = [&](const char* word) { return std::find(c.words.begin(), c.words.end(), word) != c.words.end(); };
    return has("washino/capillary/viscous") || has("easo/capillary/viscous") ||
           (c.words.size() > 3 && c.words[0] == "fix" && c.words[3].starts_with("heat/gran"));
  });
}

}  // namespace granulaw::deck
