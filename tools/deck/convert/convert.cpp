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
#include "deck/convert/model_words.hpp"
#include "deck/convert/time_steps.hpp"

namespace granulaw::deck {

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

std::string join(const Words& words) { return fmt::format("{}", fmt::join(words, " ")); }

bool is_property(const Words& words, const char* name) { return is_fix(words, "property/global") && words.size() > 5 && words[4] == name; }

/// Place of `gran` in a pair_style; 0: none.
std::size_t gran_of(const Words& words)
{
  if (words.empty() || words[0] != "pair_style") return 0;
  const auto at = std::find(words.begin() + 1, words.end(), "gran");
  return at == words.end() ? 0 : static_cast<std::size_t>(at - words.begin());
}

class Converter
{
 public:
  Converter(const Scene& scene, const Conversion& conversion) : scene_(scene), conversion_(conversion), deck_(scene), time_(deck_, scene, conversion) {}

  ConvertedDeck convert()
  {
    find_places();
    time_.change_steps();
    const bool followed = time_.is_followed(), more_follows = time_.more_than_counts_follow();
    deck_.each_command([&](const At& at) { convert_line(at); });
    add_missing_moduli();
    allow_hard_particles();
    place_walls();
    ConvertedDeck done = deck_.result();
    done.followed = followed, done.more_follows = more_follows;
    return done;
  }

 private:
  void find_places()
  {
    deck_.each_command([&](const At& at) {
      const Words words = deck_.words_of(at);
      if (gran_of(words) > 0) keep_first(first_pair_, at);
      if (words[0] == "create_box" || words[0] == "read_restart" || words[0] == "read_data") keep_first(box_, at);
      if (words[0] == "units") keep_first(units_, at);
      if (is_fix(words, "wall/gran")) keep_first(first_wall_, at);
      for (const char* name : {"youngsModulus", "YoungsModulus"}) has_young_ |= is_property(words, name);
      has_poisson_ |= is_property(words, "poissonsRatio");
      has_clumps_ |= is_fix(words, "multisphere");
    });
  }

  void keep_first(std::optional<At>& first, const At& at) const
  {
    if (!first || deck_.order(at) < deck_.order(*first)) first = at;
  }

  void convert_line(const At& at)
  {
    const Words words = deck_.words_of(at);
    const std::string& command = words[0];
    replace_paths(at);
    if (command == "if") return look_into_branch(at);
    if (command == "pair_style") return convert_pair(at, words);
    if (is_fix(words, "wall/gran")) return convert_wall(at, words);
    if (is_fix(words, "property/global")) return convert_property(at, words);
    if (is_fix(words, "multicontact/halfspace")) return remove_fix(at, words, "it belongs to the surface model multicontact, which mpm does not take");
    if (command == "unfix" && words.size() > 1 && removed_.contains(words[1])) return deck_.remove(at, "its fix was removed");
    if (command == "hard_particles" && words.size() > 1) return say_hard_particles(at, words);
    if (command == "newton" && words.size() > 1 && words[1] == "on") return deck_.replace(at, "newton off", "a contact with memory needs it");
    if (command == "neighbor" && words.size() > 2 && words[2] == "multi")
      return deck_.replace(at, fmt::format("neighbor {} bin", words[1]), "'multi' lets spheres of unlike size pass through each other");
    if (command == "run_style" && words.size() > 1 && words[1].starts_with("respa"))
      return deck_.replace(at, "run_style verlet", "LIGGGHTS does not call walls under respa");
    if (command == "jump") return convert_jump(at, words);
    if (is_fix(words, "nve/limit") && conversion_.step_factor != 1) deck_.leave(at, "'fix nve/limit' limits the way in one time step, which is shorter now");
    time_.convert_counts(at, words);
    time_.warn_of_step(at);
  }

  // ---------------------------------------------------------------- models

  /// Behind those that the command keeps.
  std::string own_words(const Words& kept) const
  {
    const bool says_compliance = std::find(kept.begin(), kept.end(), "bodyCompliance") != kept.end();
    const bool says_range = std::find(kept.begin(), kept.end(), "beyondRange") != kept.end();
    return fmt::format(" law {} materials {}{}{}{}", conversion_.law, fmt::join(conversion_.materials, " "),
        conversion_.stretch > 1 ? fmt::format(" stretch {:g}", conversion_.stretch) : "", has_clumps_ && !says_compliance ? " bodyCompliance on" : "",
        says_range ? "" : " beyondRange crush");
  }

  std::string normal_model(const Words& words) const
  {
    const auto at = std::find(words.begin(), words.end(), "model");
    return at == words.end() || at + 1 == words.end() ? "" : *(at + 1);
  }

  std::string reason(const ModelWords& model, const std::string& of, bool says_own) const
  {
    std::string why = fmt::format("model {} becomes mpm", of.empty() ? "?" : of);
    if (says_own && has_clumps_) why += "; bodyCompliance: what a clump of 'fix multisphere' yields behind its sphere";
    for (const std::string& text : model.dropped) why += "; " + text;
    return why;
  }

  void leave_dropped(const At& at, const ModelWords& model)
  {
    for (const std::string& text : model.dropped)
      if (text.find("became") != std::string::npos || text.find("cohesion") != std::string::npos || text.find("rolling_friction") != std::string::npos ||
          text.find("surface") != std::string::npos)
        deck_.leave(at, text);
  }

  void convert_pair(const At& at, const Words& words)
  {
    const std::size_t gran = gran_of(words);
    if (gran == 0) {
      if (words.size() > 1 && words[1] != "none") deck_.leave(at, fmt::format("pair_style {} is no contact model", words[1]));
      return;
    }
    // of hybrid: its words end where another style begins
    std::size_t end = words.size();
    if (gran > 1)
      for (std::size_t k = gran + 1; k < words.size() && end == words.size(); ++k)
        if (words[k].starts_with("lubricate") || words[k].starts_with("sph") || words[k] == "gran" || words[k].starts_with("lj/") || words[k].starts_with("bubble"))
          end = k;
    const Words own(words.begin() + static_cast<std::ptrdiff_t>(gran) + 1, words.begin() + static_cast<std::ptrdiff_t>(end));
    const ModelWords model = model_words(own, false);
    const Words before(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(gran) + 1), behind(words.begin() + static_cast<std::ptrdiff_t>(end), words.end());
    leave_dropped(at, model);
    deck_.replace(at, fmt::format("{} {}{}{}{}", join(before), join(model.words), own_words(model.words), behind.empty() ? "" : " ", join(behind)),
        reason(model, normal_model(own), true));
  }

  void convert_wall(const At& at, const Words& words)
  {
    const Words own(words.begin() + 4, words.end());
    const ModelWords model = model_words(own, true);
    leave_dropped(at, model);
    const bool alone = !first_pair_;
    deck_.replace(
        at, fmt::format("fix {} {} wall/gran {}{}", words[1], words[2], join(model.words), alone ? own_words(model.words) : ""), reason(model, normal_model(own), alone));
  }

  /// Walls, and heat conduction, go behind the pair_style that they take words from.
  void place_walls()
  {
    if (!first_pair_) return;
    std::vector<At> early;
    deck_.each_command([&](const At& at) {
      const Words words = deck_.words_of(at);
      const bool needs = is_fix(words, "wall/gran") || (words.size() > 3 && words[0] == "fix" && words[3].starts_with("heat/gran"));
      if (needs && !at.file->is_removed(at.index) && deck_.order(at) < deck_.order(*first_pair_)) early.push_back(at);
    });
    for (const At& at : early) {
      if (at.file == first_pair_->file && at.index < first_pair_->index) {
        deck_.note(at, at.line().text(), at.line().text(), fmt::format("moved behind its pair_style ({})", first_pair_->where()));
        at.file->move_behind(at.index, first_pair_->index);
      } else if (is_fix(deck_.words_of(at), "wall/gran")) {
        deck_.replace(at, at.line().text() + own_words(deck_.words_of(at)), "it stands before its pair_style");
      }
    }
  }

  // ---------------------------------------------------------------- materials

  double unit_of_pressure() const { return scene_.units == "cgs" ? 0.1 : 1.0; }

  void convert_property(const At& at, const Words& words)
  {
    if (is_property(words, "coefficientRestitution")) return remove_fix(at, words, "restitution follows from the material and the speed");
    if (is_property(words, "youngsModulus") || is_property(words, "YoungsModulus"))
      return set_values(at, words, conversion_.youngs_modulus, 1 / unit_of_pressure(), "the real modulus of the material, as the law has it");
    if (is_property(words, "poissonsRatio")) return set_values(at, words, conversion_.poisson_ratio, 1, "Poisson's ratio of the material, as the law has it");
    if (is_property(words, "cohesionEnergyDensity") && conversion_.stretch > 1) return divide_cohesion(at, words);
  }

  void set_values(const At& at, const Words& words, const std::map<int, double>& values, double unit, const std::string& why)
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
    if (differs) deck_.replace(at, join(now), why);
  }

  void divide_cohesion(const At& at, const Words& words)
  {
    Words now = words;
    const double s2 = conversion_.stretch * conversion_.stretch;
    for (std::size_t k = 7; k < now.size(); ++k)
      if (const auto value = number_in(now[k])) now[k] = fmt::format("{:.10g}", *value / s2);
    deck_.replace(at, join(now), fmt::format("divided by the square of the stretch {:g}", conversion_.stretch));
  }

  void remove_fix(const At& at, const Words& words, const std::string& why)
  {
    removed_.insert(words[1]);
    deck_.remove(at, why);
  }

  /// Models like hooke/stiffness need none.
  void add_missing_moduli()
  {
    if (has_young_ && has_poisson_) return;
    const At place = box_ && first_pair_ && deck_.order(*box_) > deck_.order(*first_pair_) ? *box_ : first_pair_ ? *first_pair_ : *first_wall_;
    const bool behind = box_ && place.file == box_->file && place.index == box_->index;
    const auto add = [&](const char* name, const std::map<int, double>& values, double unit) {
      std::string text = fmt::format("fix granulaw_{} all property/global {} peratomtype", name, name);
      for (int t = 1; t <= scene_.types; ++t) {
        const auto found = values.find(t);
        text += fmt::format(" {:.10g}", (found == values.end() ? fallback(values) : found->second) * unit);
      }
      deck_.note(place, "", text, "the normal model that was replaced needs no moduli; model mpm does");
      if (behind)
        place.file->insert_behind(place.index, text);
      else
        place.file->insert_before(place.index, text);
    };
    if (!has_young_) add("youngsModulus", conversion_.youngs_modulus, 1 / unit_of_pressure());
    if (!has_poisson_) add("poissonsRatio", conversion_.poisson_ratio, 1);
  }

  static double fallback(const std::map<int, double>& values) { return values.empty() ? 0.3 : values.begin()->second; }

  bool needs_hard_particles() const
  {
    return std::any_of(conversion_.youngs_modulus.begin(), conversion_.youngs_modulus.end(), [](const auto& entry) { return entry.second > 1e9; });
  }

  void say_hard_particles(const At& at, const Words& words)
  {
    says_hard_ = true;
    if (words[1] != "yes" && needs_hard_particles()) deck_.replace(at, "hard_particles yes", "LIGGGHTS demands it of moduli above 1e9 Pa");
  }

  void allow_hard_particles()
  {
    if (says_hard_ || !needs_hard_particles()) return;
    const At place = units_ ? *units_ : deck_.first_line();
    deck_.note(place, "", "hard_particles yes", "LIGGGHTS demands it of moduli above 1e9 Pa");
    if (units_)
      place.file->insert_behind(place.index, "hard_particles yes");
    else
      place.file->insert_before(place.index, "hard_particles yes");
  }

  void look_into_branch(const At& at)
  {
    for (const Word& w : at.line().words) {
      const Words inner = raw_words(parse_line(w.unquoted()));
      if (inner.size() < 2) continue;
      const std::string& command = inner[0];
      if (command == "pair_style" || time_.is_left_in_branch(inner) || is_fix(inner, "wall/gran") || is_fix(inner, "property/global"))
        deck_.leave(at, fmt::format("'{}' in a branch: change it by hand", join(inner)));
    }
    time_.warn_of_step(at);
  }

  void replace_paths(const At& at)
  {
    for (std::size_t k = 1; k < at.line().words.size(); ++k) {
      const std::string path = at.line().words[k].unquoted();
      if (!path.starts_with("..") || path.find_first_of(" \t\n") != std::string::npos) continue;
      if (const std::string within = path_within(scene_, path); within != path) deck_.replace_word(at, k, within, "the converted deck stands in another folder");
    }
  }

  /// The converted deck may stand in another folder than the one whose name it jumps to.
  void convert_jump(const At& at, const Words& words)
  {
    if (words.size() < 2 || at.line().words.size() < 2 || words[1] == "SELF") return;
    if (words[1] == at.file->path()) deck_.replace_word(at, 1, "SELF", "this file, wherever it stands");
  }

  const Scene& scene_;
  const Conversion& conversion_;
  EditedDeck deck_;
  TimeSteps time_;
  std::set<std::string> removed_;
  std::optional<At> first_pair_, first_wall_, box_, units_;
  bool has_young_ = false, has_poisson_ = false, has_clumps_ = false, says_hard_ = false;
};

}  // namespace

fs::path path_of(const Scene& scene, const std::string& path) { return fs::path(scene.folder) / path; }

std::string path_within(const Scene& scene, const std::string& path)
{
  std::string within = path;
  while (within.starts_with("../") || within.starts_with("./../")) within = within.substr(within.find("../") + 3);
  std::error_code ignored;
  const std::string own = fs::absolute(scene.deck, ignored).lexically_normal().parent_path().filename().string() + "/";
  if (within != path && within.starts_with(own)) within = within.substr(own.size());
  return within;
}

std::string main_file(const Scene& scene) { return scene.folder.empty() ? scene.deck : fs::path(scene.deck).filename().string(); }

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

void require_contact_model(const Scene& scene)
{
  std::string other = scene.deck;
  for (const DeckCommand& c : scene.commands) {
    if (gran_of(c.words) > 0 || is_fix(c.words, "wall/gran")) return;
    if (c.words[0] == "pair_style") other = fmt::format("{}:{}: 'pair_style {}'", c.file, c.line, c.words.size() > 1 ? c.words[1] : "");
  }
  fail(other, "the deck has neither pair_style gran nor fix wall/gran: there is no contact model to convert");
}

ConvertedDeck convert(const Scene& scene, const Conversion& conversion)
{
  require_contact_model(scene);
  return Converter(scene, conversion).convert();
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
    return has("washino/capillary/viscous") || has("easo/capillary/viscous") || (c.words.size() > 3 && c.words[0] == "fix" && c.words[3].starts_with("heat/gran"));
  });
}

}  // namespace granulaw::deck
