#include "materials_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <vector>

#include "base/error.hpp"
#include "law/law.hpp"
#include "solver/flow_laws.hpp"

namespace granulaw {

namespace {

using Words = std::vector<std::string>;

template <class Map>
Words names_of(const Map& map)
{
  Words names;
  for (const auto& entry : map) names.push_back(entry.first);
  return names;
}

/// One table of the file, with the words that lead its messages.
class Section
{
 public:
  Section(const std::string& path, const toml::table& table, std::string name)
      : path_(path), table_(table), name_(std::move(name))
  {
  }

  std::string where(const toml::node& node) const
  {
    return fmt::format("{}:{}: [{}]", path_, node.source().begin.line, name_);
  }
  std::string where() const { return where(table_); }

  /// Refuses keys that are not in `known`; those in `later` with a sentence of their own.
  void check_keys(const Words& known, const Words& later, const char* later_sentence) const
  {
    for (const auto& [key, node] : table_) {
      const std::string word(key.str());
      if (std::find(later.begin(), later.end(), word) != later.end())
        fail(where(node), fmt::format("'{}': {}", word, later_sentence));
      if (std::find(known.begin(), known.end(), word) == known.end())
        fail(where(node), fmt::format("unknown key '{}'{}", word, did_you_mean(word, known)), {},
             fmt::format("{}", fmt::join(known, ", ")));
    }
  }
  bool has(const char* key) const { return table_.contains(key); }
  const toml::node& node(const char* key) const
  {
    const toml::node* found = table_.get(key);
    if (!found) fail(where(), fmt::format("the key '{}' is missing", key));
    return *found;
  }
  double number(const char* key, const char* unit) const
  {
    const toml::node& n = node(key);
    if (n.is_floating_point()) return n.as_floating_point()->get();
    if (n.is_integer()) return static_cast<double>(n.as_integer()->get());
    fail(where(n), fmt::format("'{}' must be a number{}", key, *unit ? fmt::format(" in {}", unit) : ""));
  }
  double positive(const char* key, const char* unit) const
  {
    const double value = number(key, unit);
    if (!(value > 0 && std::isfinite(value)))
      fail(where(node(key)), fmt::format("'{}' is out of range", key), fmt::format("{:g} {}", value, unit),
           fmt::format("over 0 {}", unit));
    return value;
  }
  std::string text(const char* key) const
  {
    const toml::node& n = node(key);
    if (!n.is_string()) fail(where(n), fmt::format("'{}' must be a text in quotes", key));
    return n.as_string()->get();
  }
  std::vector<double> numbers(const char* key, const char* unit) const
  {
    const toml::node& n = node(key);
    std::vector<double> values;
    if (const toml::array* list = n.as_array())
      for (const toml::node& entry : *list) {
        const std::optional<double> value = entry.value<double>();
        if (!value || !entry.is_number()) fail(where(entry), fmt::format("'{}' must hold numbers only", key));
        values.push_back(*value);
      }
    if (values.empty())
      fail(where(n),
           fmt::format("'{}' must be a list of numbers{}", key, *unit ? fmt::format(" in {}", unit) : ""));
    return values;
  }
  Section table(const char* key, const char* example) const
  {
    const toml::node& n = node(key);
    if (!n.is_table()) fail(where(n), fmt::format("'{}' must be a table, such as {}", key, example));
    return {path_, *n.as_table(), fmt::format("{}.{}", name_, key)};
  }

 private:
  const std::string& path_;
  const toml::table& table_;
  std::string name_;
};

const char* unit_of(flow::Quantity quantity)
{
  return quantity == flow::Quantity::stress ? "Pa" : quantity == flow::Quantity::rate ? "1/s" : "";
}

/// {law = "NAME", key = value, ...} with the keys that the law has.
FlowLaw read_flow_law(const Section& s, const char* kind, const std::vector<FlowLawKeys>& known)
{
  FlowLaw law{s.text("law"), {}};
  Words names;
  for (const FlowLawKeys& entry : known) names.push_back(entry.name);
  const auto found = std::find(names.begin(), names.end(), law.name);
  if (found == names.end())
    fail(s.where(s.node("law")),
         fmt::format("no {} law '{}'{}", kind, law.name, did_you_mean(law.name, names)), {},
         fmt::format("{}", fmt::join(names, ", ")));
  const std::vector<flow::Parameter>& parameters = known[found - names.begin()].parameters;
  Words keys{"law"};
  for (const flow::Parameter& p : parameters) keys.push_back(p.key);
  s.check_keys(keys, {}, "");
  for (const flow::Parameter& p : parameters)
    law.values[p.key] =
        p.list ? s.numbers(p.key, unit_of(p.quantity)) : std::vector{s.number(p.key, unit_of(p.quantity))};
  return law;
}

Material read_material(const Section& s)
{
  s.check_keys({"density", "youngs_modulus", "poisson_ratio", "yield_stress", "hardening", "rate"}, {}, "");
  Material m;
  m.density = s.positive("density", "kg/m^3");
  m.youngs_modulus = s.positive("youngs_modulus", "Pa");
  m.poisson_ratio = s.number("poisson_ratio", "");
  if (!(m.poisson_ratio >= 0 && m.poisson_ratio < 0.5))
    fail(s.where(s.node("poisson_ratio")), "'poisson_ratio' is out of range",
         fmt::format("{:g}", m.poisson_ratio),
         "0 to below 0.5 (0.5 is incompressible: the solver needs a finite bulk modulus; 0.49 works)");
  if (s.has("yield_stress")) m.yield_stress = s.positive("yield_stress", "Pa");
  if (!m.yields() && (s.has("hardening") || s.has("rate"))) {
    const char* key = s.has("hardening") ? "hardening" : "rate";
    fail(s.where(s.node(key)), fmt::format("'{}' needs a 'yield_stress'", key));
  }
  if (s.has("hardening")) {
    const Section h = s.table("hardening", "{law = \"linear\", modulus = 1e9}");
    const FlowLaw law = read_flow_law(h, "hardening", hardening_laws());
    if (law.name == flow::Linear::name) {
      m.hardening_modulus = law.values.at("modulus").front();
      if (!(m.hardening_modulus >= 0 && std::isfinite(m.hardening_modulus)))
        fail(h.where(h.node("modulus")), "'modulus' is out of range",
             fmt::format("{:g} Pa", m.hardening_modulus), "0 or more");
    } else {
      m.hardening = law;
      validate_flow(m, h.where());
    }
  }
  if (s.has("rate")) {
    const Section r = s.table("rate", "{law = \"cowper-symonds\", reference_rate = 40, exponent = 5}");
    m.rate = read_flow_law(r, "rate", rate_laws());
    validate_flow(m, r.where());
  }
  return m;
}

void check_name(const std::string& name, const std::string& where)
{
  constexpr const char* allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  if (name.empty() || name.size() > 100 || name.find_first_not_of(allowed) != std::string::npos ||
      name == wall_name)
    fail(where, "unusable name", fmt::format("'{}'", name),
         fmt::format("letters, digits, '_' and '-', and not '{}' (the rigid partner in pairs)", wall_name));
}

/// Visits [kind.NAME] tables.
template <class Read>
void each_section(const std::string& path, const toml::table& root, const char* kind, Read read)
{
  const toml::node* group = root.get(kind);
  if (!group) return;
  const auto complain = [&](const toml::node& n) {
    fail(fmt::format("{}:{}", path, n.source().begin.line),
         fmt::format("'{}' must be written as [{}.NAME]", kind, kind));
  };
  if (!group->is_table()) complain(*group);
  for (const auto& [key, node] : *group->as_table()) {
    if (!node.is_table()) complain(node);
    const std::string name(key.str());
    const Section section(path, *node.as_table(), fmt::format("{}.{}", kind, name));
    check_name(name, section.where());
    read(name, section);
  }
}

}  // namespace

const Material& MaterialsFile::material(const std::string& name) const
{
  const auto found = materials.find(name);
  if (found != materials.end()) return found->second;
  const Words names = names_of(materials);
  fail(path, fmt::format("no material '{}'{}", name, did_you_mean(name, names)), {},
       fmt::format("{}", fmt::join(names, ", ")));
}

Sphere MaterialsFile::sphere(const std::string& particle) const
{
  const auto found = particles.find(particle);
  if (found == particles.end()) {
    const Words names = names_of(particles);
    if (names.empty())
      fail(path, fmt::format("no particle '{}': the file defines none, as [particle.NAME]", particle));
    fail(path, fmt::format("no particle '{}'{}", particle, did_you_mean(particle, names)), {},
         fmt::format("{}", fmt::join(names, ", ")));
  }
  return {found->second.radius, material(found->second.material)};
}

MaterialsFile read_materials(const std::string& path)
{
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) fail(path, "no such file");
  if (!std::filesystem::is_regular_file(path, ignored)) fail(path, "cannot be read as a file");
  toml::table root;
  try {
    root = toml::parse_file(path);
  } catch (const toml::parse_error& error) {
    fail(fmt::format("{}:{}", path, error.source().begin.line), std::string(error.description()));
  }
  MaterialsFile file;
  file.path = path;
  Section(path, root, "file").check_keys({"material", "particle"}, {}, "");
  each_section(path, root, "material",
               [&](const std::string& name, const Section& s) { file.materials[name] = read_material(s); });
  each_section(path, root, "particle", [&](const std::string& name, const Section& s) {
    s.check_keys({"radius", "material"}, {"layers", "inclusions", "profile"},
                 "this version does homogeneous spheres only");
    const std::string material = s.text("material");
    const Words names = names_of(file.materials);
    if (!file.materials.contains(material))
      fail(s.where(s.node("material")),
           fmt::format("no material '{}'{}", material, did_you_mean(material, names)), {},
           fmt::format("{}", fmt::join(names, ", ")));
    file.particles[name] = {s.positive("radius", "m"), material};
  });
  if (file.materials.empty()) fail(path, "the file defines no material, as [material.NAME]");
  return file;
}

}  // namespace granulaw
