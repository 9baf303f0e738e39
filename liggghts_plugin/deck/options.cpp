#include "liggghts_plugin/deck/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/number_in.hpp"

namespace granulaw::plugin {

namespace {

using Words = std::vector<std::string>;

template <class List>
bool contains(const List& list, std::string_view word)
{
  return std::find(list.begin(), list.end(), word) != list.end();
}

bool is_among(std::span<const Keyword> keywords, std::string_view name)
{
  return std::any_of(keywords.begin(), keywords.end(), [&](const Keyword& k) { return k.name == name; });
}

/// The keywords that a command may say.
class KnownKeywords
{
 public:
  KnownKeywords(const ModelInfo& model, bool is_wall) : is_wall_(is_wall)
  {
    add(shared_keywords);
    add(model.keywords);
    add(liggghts_keywords);
  }

  const Keyword* find(std::string_view name) const
  {
    const auto is_it = [&](const Keyword* k) { return k->name == name; };
    const auto found = std::find_if(keywords_.begin(), keywords_.end(), is_it);
    return found == keywords_.end() ? nullptr : *found;
  }

  Words names() const
  {
    Words names;
    for (const Keyword* k : keywords_) names.emplace_back(k->name);
    return names;
  }

  /// True if a list of names ends before this word.
  bool ends_list(const std::string& word) const
  {
    return find(word) || is_among(surface_keywords, word) || contains(model_kinds, word) ||
           (is_wall_ && contains(wall_words, word));
  }

  /// Throws Error unless `key` is one of them.
  const Keyword& demand(const std::string& key, const std::string& where) const
  {
    if (contains(model_kinds, key))
      fail(where, fmt::format("'{}' is out of order: the order is {}, then the model's keywords{}", key,
                              fmt::join(model_kinds, ", "), is_wall_ ? ", after all of the wall's own" : ""));
    if (is_wall_ && contains(wall_words, key))
      fail(where,
           fmt::format("'{}' must stand before the model's keywords ({})", key, fmt::join(names(), ", ")));
    if (const Keyword* keyword = find(key)) return *keyword;
    fail(where, fmt::format("unknown keyword '{}'{}", key, did_you_mean(key, names())), {},
         fmt::format("{}", fmt::join(names(), ", ")));
  }

 private:
  void add(std::span<const Keyword> keywords)
  {
    for (const Keyword& k : keywords)
      if (k.stands_in(is_wall_)) keywords_.push_back(&k);
  }

  bool is_wall_;
  std::vector<const Keyword*> keywords_;
};

/// Throws Error unless `value` may follow the keyword.
void check_value(const Keyword& keyword, const std::string& value, const std::string& where)
{
  const auto end = std::find(keyword.words.begin(), keyword.words.end(), std::string_view());
  const std::span words(keyword.words.begin(), end);
  if (contains(words, value) || (!keyword.takes_words() && !keyword.takes_number())) return;
  const std::string range = fmt::format("{:g} to {:g}", keyword.least, keyword.most);
  const bool has_digits = value.find_first_of("0123456789") != std::string::npos;
  if (keyword.takes_words() && !(keyword.takes_number() && has_digits))
    fail(where, fmt::format("'{}' has an unknown value", keyword.name), fmt::format("'{}'", value),
         fmt::format("{}{}", keyword.takes_number() ? fmt::format("a number from {}, ", range) : "",
                     fmt::join(words, ", ")));
  const std::optional<double> found = number_in(value);
  if (!found || !std::isfinite(*found)) fail(where, fmt::format("'{}' needs a number", keyword.name), fmt::format("'{}'", value));
  if (!(*found >= keyword.least && *found <= keyword.most))
    fail(where, fmt::format("'{}' is out of range", keyword.name), value, range);
}

/// Words of a command: each keyword with the words behind it.
using Said = std::map<std::string, Words>;

/// Throws Error on an unknown or misplaced keyword, a missing or bad value. Keywords of LIGGGHTS go to
/// `rest`, too.
Said read_words(const KnownKeywords& known, const std::string& where, const Words& words, Words& rest)
{
  Said said;
  for (std::size_t i = 0; i < words.size();) {
    const std::string& key = words[i++];
    const Keyword& keyword = known.demand(key, where);
    if (said.contains(key)) fail(where, fmt::format("'{}' is given twice", key));
    Words& values = said[key];
    if (keyword.list.empty()) {
      if (i >= words.size()) fail(where, fmt::format("'{}' needs a value", key));
      values.push_back(words[i++]);
      check_value(keyword, values[0], where);
    } else {
      while (i < words.size() && !known.ends_list(words[i])) values.push_back(words[i++]);
      if (values.empty()) fail(where, fmt::format("'{}' needs {}", key, keyword.list));
    }
    if (is_among(liggghts_keywords, key)) rest.insert(rest.end(), {key, values[0]});
  }
  return said;
}

ElasticDamping elastic_damping(const std::string& value)
{
  if (value == "off") return {0.0};
  if (value == "restitution") return {0.0, true};
  return {*number_in(value)};
}

/// Options of the keywords of all models.
Options shared_options(const Said& said)
{
  const auto value = [&](const char* key) -> const std::string* {
    const auto found = said.find(key);
    return found == said.end() ? nullptr : &found->second[0];
  };
  const auto is = [&](const char* key, const char* word) { return value(key) && *value(key) == word; };
  const auto choice = [&](const char* key, const char* yes) -> std::optional<bool> {
    if (!value(key)) return {};
    return *value(key) == yes;
  };
  const auto quantity = [&](const char* key) -> std::optional<double> {
    if (!value(key)) return {};
    return number_in(*value(key));
  };
  Options options;
  options.deformable_wall = is("wall", "deformable");
  options.tangential_damping = quantity("tangentialDampingRatio");
  if (const std::string* text = value("tangential_damping")) options.tangential_damping_on = *text != "off";
  options.tangential_computed = choice("tangentialStiffness", "computed");
  if (const std::string* text = value("elasticDamping")) options.elastic_damping = elastic_damping(*text);
  options.body_compliance = choice("bodyCompliance", "on");
  options.stretch = quantity("stretch");
  if (const std::string* text = value("stats")) options.stats_path = *text;
  options.energy = is("energy", "on");
  options.dissipated_energy = is("computeDissipatedEnergy", "on");
  options.contact_map = is("contactMap", "on");
  if (const std::string* text = value("beyondRange"))
    options.beyond_range = *text == "stop" ? BeyondRange::stop : *text == "crush" ? BeyondRange::crush : BeyondRange::proceed;
  options.heat_by_law = choice("heatArea", "law");
  return options;
}

}  // namespace

Words keyword_names(const ModelInfo& model, bool is_wall)
{
  return KnownKeywords(model, is_wall).names();
}

const Words& Options::own_words(const std::string& key) const
{
  static const Words none;
  const auto found = own.find(key);
  return found == own.end() ? none : found->second;
}

void Options::inherit(const Options& pair)
{
  const auto take = [](auto& mine, const auto& other) {
    if (!mine) mine = other;
  };
  take(tangential_damping, pair.tangential_damping);
  take(tangential_damping_on, pair.tangential_damping_on);
  take(tangential_computed, pair.tangential_computed);
  take(elastic_damping, pair.elastic_damping);
  take(body_compliance, pair.body_compliance);
  take(stretch, pair.stretch);
  take(beyond_range, pair.beyond_range);
  take(heat_by_law, pair.heat_by_law);
  own.insert(pair.own.begin(), pair.own.end());
}

Options parse_options(const ModelInfo& model, bool is_wall, const std::string& where, const Words& words,
                      Words& rest)
{
  const Said said = read_words(KnownKeywords(model, is_wall), where, words, rest);
  Options options = shared_options(said);
  for (const Keyword& keyword : model.keywords)
    if (const auto found = said.find(std::string(keyword.name)); found != said.end())
      options.own.insert(*found);
  return options;
}

}  // namespace granulaw::plugin
