#include "deck/convert/model_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "liggghts_plugin/deck/keywords.hpp"

namespace granulaw::deck {

namespace {

using Words = std::vector<std::string>;

template <class List>
bool contains(const List& list, const std::string& word)
{
  return std::find(list.begin(), list.end(), word) != list.end();
}

/// Words of LIGGGHTS's models that model mpm does not take, each followed by on or off.
constexpr std::array<std::string_view, 14> dropped_switches{"absolute_damping", "viscous", "ktToKnUser", "heating_normal_hertz", "heating_normal_hooke",
    "heating_tangential_no_history", "computeElasticPotential", "computeDissipatedEnergy", "disableNormalWhenBonded", "disableTangentialWhenBonded", "fixKc",
    "limitLiquidContent", "modifyLbVolume", "torsion"};
/// Words of model mpm that the conversion says anew.
constexpr std::array<std::string_view, 4> own_words{"law", "materials", "stretch", "stats"};

class Reader
{
 public:
  Reader(const Words& words, bool is_wall) : words_(words), is_wall_(is_wall) {}

  ModelWords read()
  {
    while (at_ < words_.size()) step();
    return std::move(result_);
  }

 private:
  void step()
  {
    const std::string key = words_[at_];
    const std::string value = at_ + 1 < words_.size() ? words_[at_ + 1] : "";
    if (is_wall_ && contains(plugin::wall_words, key)) return keep_wall_word(key, value);
    if (contains(plugin::model_kinds, key)) return choose(key, value);
    if (contains(dropped_switches, key)) return drop_switch(key, value);
    if (contains(own_words, key)) return skip_own();
    keep(1);
  }

  void keep(std::size_t count)
  {
    for (; count > 0 && at_ < words_.size(); --count) result_.words.push_back(words_[at_++]);
  }

  /// Names of meshes may be words of a model.
  void keep_wall_word(const std::string& key, const std::string& value)
  {
    if (key == "n_meshes") meshes_ = static_cast<std::size_t>(std::max(0, std::atoi(value.c_str())));
    keep(key == "mesh" ? 1 : key == "meshes" ? 1 + meshes_ : 2);
  }

  void drop(const std::string& key, const std::string& value, const std::string& why)
  {
    result_.dropped.push_back(fmt::format("'{} {}' left out: {}", key, value, why));
    at_ += 2;
  }

  template <class List>
  void choose_among(const std::string& key, const std::string& value, const List& known, const char* instead)
  {
    if (contains(known, value)) return keep(2);
    if (!instead) return drop(key, value, fmt::format("model mpm takes {}", fmt::join(known, ", ")));
    result_.words.insert(result_.words.end(), {key, instead});
    result_.dropped.push_back(fmt::format("'{} {}' became '{}': model mpm takes {}", key, value, instead, fmt::join(known, ", ")));
    at_ += 2;
  }

  void choose(const std::string& key, const std::string& value)
  {
    if (key == "model") {
      result_.words.insert(result_.words.end(), {"model", "mpm"});
      at_ += 2;
    } else if (key == "tangential")
      value == plugin::own_tangential_model ? keep(2) : choose_among(key, value, plugin::tangential_models, "history");
    else if (key == "rolling_friction")
      choose_among(key, value, plugin::rolling_models, nullptr);
    else if (key == "cohesion")
      choose_among(key, value, plugin::cohesion_models, nullptr);
    else
      choose_among(key, value, plugin::surface_models, nullptr);
  }

  void drop_switch(const std::string& key, const std::string& value)
  {
    if (key == "computeDissipatedEnergy" && !is_wall_) return keep(2);
    const bool is_off = value == "off";
    drop(key, value,
        key == "computeDissipatedEnergy"   ? "energies of walls are counted with the pair style's"
        : key == "computeElasticPotential" ? (is_off ? "it is off" : "'energy on' and f_granulaw give this energy")
                                           : "it belongs to the normal model that was replaced");
  }

  void skip_own()
  {
    const bool is_list = words_[at_] == "materials";
    ++at_;
    if (!is_list) {
      ++at_;
      return;
    }
    const auto ends = [&](const std::string& word) {
      const auto named = [&](const auto& list) { return std::any_of(list.begin(), list.end(), [&](const plugin::Keyword& k) { return k.name == word; }); };
      return named(plugin::shared_keywords) || named(plugin::liggghts_keywords) || contains(own_words, word) || word == "beyondRange" || word == "waves" ||
             contains(plugin::wall_words, word);
    };
    while (at_ < words_.size() && !ends(words_[at_])) ++at_;
  }

  const Words& words_;
  bool is_wall_;
  std::size_t at_ = 0, meshes_ = 0;
  ModelWords result_;
};

}  // namespace

ModelWords model_words(const std::vector<std::string>& words, bool is_wall) { return Reader(words, is_wall).read(); }

}  // namespace granulaw::deck
