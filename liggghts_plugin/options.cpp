#include "liggghts_plugin/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.hpp"
#include "liggghts_plugin/keywords.hpp"

namespace granulaw::plugin {

namespace {

using Words = std::vector<std::string>;

bool contains(const auto& words, const std::string& word)
{
  return std::find(words.begin(), words.end(), word) != words.end();
}

double number(const std::string& text, const std::string& where, const std::string& key)
{
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || !std::isfinite(value))
    fail(where, fmt::format("'{}' needs a number", key), fmt::format("'{}'", text));
  return value;
}

bool choice(const std::string& text, const char* yes, const char* no, const std::string& where,
            const std::string& key)
{
  if (text == yes) return true;
  if (text == no) return false;
  fail(where, fmt::format("'{}' has an unknown value", key), fmt::format("'{}'", text),
       fmt::format("{}, {}", yes, no));
}

ElasticDamping elastic_damping(const std::string& text, const std::string& where)
{
  if (text == "off") return {0.0};
  if (text == "restitution") return {0.0, true};
  if (text.find_first_of("0123456789") == std::string::npos)
    fail(where, "'elasticDamping' has an unknown value", fmt::format("'{}'", text),
         "a number from 0 to 1, off, restitution");
  const double ratio = number(text, where, "elasticDamping");
  if (!(ratio >= 0 && ratio <= 1)) fail(where, "'elasticDamping' is out of range", text, "0 to 1");
  return {ratio};
}

}  // namespace

const char* model_name(Model model)
{
  return model == Model::mpm ? "mpm" : "thornton";
}

Words keywords(Model model, bool is_wall)
{
  Words words;
  for (const Keyword& k : keyword_table)
    if ((is_wall ? k.in_wall : k.in_pair_style) && (model == Model::mpm || !k.only_mpm) &&
        k.reader != KeywordReader::surface_model)
      words.emplace_back(k.name);
  return words;
}

void Options::inherit(const Options& pair)
{
  const auto take = [](auto& own, const auto& other) {
    if (!own) own = other;
  };
  if (materials.empty()) materials = pair.materials;
  take(tangential_damping, pair.tangential_damping);
  take(tangential_damping_on, pair.tangential_damping_on);
  take(tangential_computed, pair.tangential_computed);
  take(elastic_damping, pair.elastic_damping);
  take(stretch, pair.stretch);
  take(stop_beyond_range, pair.stop_beyond_range);
  take(heat_by_law, pair.heat_by_law);
}

Options parse_options(Model model, bool is_wall, const std::string& where, const Words& words, Words& rest)
{
  const Words known = keywords(model, is_wall);
  Options options;
  Words seen;
  for (std::size_t i = 0; i < words.size();) {
    const std::string& key = words[i++];
    if (contains(model_kinds, key))
      fail(where, fmt::format("'{}' is out of order: the order is {}, then the model's keywords{}", key,
                              fmt::join(model_kinds, ", "), is_wall ? ", after all of the wall's own" : ""));
    if (is_wall && contains(wall_words, key))
      fail(where,
           fmt::format("'{}' must stand before the model's keywords ({})", key, fmt::join(known, ", ")));
    if (!contains(known, key))
      fail(where, fmt::format("unknown keyword '{}'{}", key, did_you_mean(key, known)), {},
           fmt::format("{}", fmt::join(known, ", ")));
    if (contains(seen, key)) fail(where, fmt::format("'{}' is given twice", key));
    seen.push_back(key);
    if (i >= words.size()) fail(where, fmt::format("'{}' needs a value", key));

    if (key == "materials") {
      while (i < words.size() && !is_reserved(words[i], is_wall)) options.materials.push_back(words[i++]);
      if (options.materials.empty()) fail(where, "'materials' needs one name for each atom type");
      continue;
    }
    const std::string& value = words[i++];
    if (key == "law")
      options.law_path = value;
    else if (key == "stats")
      options.stats_path = value;
    else if (key == "energy")
      options.energy = choice(value, "on", "off", where, key);
    else if (key == "computeDissipatedEnergy")
      options.dissipated_energy = choice(value, "on", "off", where, key);
    else if (key == "contactMap")
      options.contact_map = choice(value, "on", "off", where, key);
    else if (key == "wall")
      options.deformable_wall = choice(value, "deformable", "rigid", where, key);
    else if (key == "beyondRange")
      options.stop_beyond_range = choice(value, "stop", "continue", where, key);
    else if (key == "heatArea")
      options.heat_by_law = choice(value, "law", "overlap", where, key);
    else if (key == "tangentialDampingRatio") {
      options.tangential_damping = number(value, where, key);
      if (!(*options.tangential_damping >= 0 && *options.tangential_damping <= 1))
        fail(where, "'tangentialDampingRatio' is out of range", value, "0 to 1");
    } else if (key == "tangentialStiffness")
      options.tangential_computed = choice(value, "computed", "mindlin", where, key);
    else if (key == "stretch") {
      options.stretch = number(value, where, key);
      if (!(*options.stretch >= 1 && *options.stretch <= 1000))
        fail(where, "'stretch' is out of range", value, "1 to 1000");
    } else if (key == "elasticDamping")
      options.elastic_damping = elastic_damping(value, where);
    else {
      if (key == "tangential_damping") options.tangential_damping_on = value != "off";
      rest.push_back(key);
      rest.push_back(value);
    }
  }
  return options;
}

}  // namespace granulaw::plugin
