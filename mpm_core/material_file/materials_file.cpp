#include "material_file/materials_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <vector>

#include "base/error.hpp"
#include "law/law.hpp"
#include "material_file/material_range.hpp"
#include "material_file/plausible.hpp"
#include "material_file/shape_reader.hpp"
#include "solver/material/law_table.hpp"
#include "solver/shape/shapes.hpp"
#include "material_file/toml_section.hpp"

namespace granulaw {

namespace {

const char* unit_of(flow::Quantity quantity)
{
  constexpr const char* units[] = {"", "Pa", "1/s", "degrees"};
  return units[static_cast<int>(quantity)];
}

LawMaterial numbers_of(const Material& m)
{
  return {{}, m.density, m.youngs_modulus, m.poisson_ratio, m.yield_stress, m.hardening_modulus};
}

/// {WORD = "NAME", key = value, ...} with the keys that the law has.
FlowLaw read_flow_law(const Section& s, const char* word, const char* kind,
                      const std::vector<FlowLawKeys>& known)
{
  FlowLaw law{s.text(word), {}};
  Words names;
  for (const FlowLawKeys& entry : known) names.push_back(entry.name);
  const auto found = std::find(names.begin(), names.end(), law.name);
  if (found == names.end()) fail_unknown(s.where(s.node(word)), fmt::format("no {}", kind), law.name, names);
  const std::vector<flow::Parameter>& parameters = known[found - names.begin()].parameters;
  Words keys{word};
  for (const flow::Parameter& p : parameters) keys.push_back(p.key);
  s.check_keys(keys);
  for (const flow::Parameter& p : parameters)
    law.values[p.key] =
        p.list ? s.numbers(p.key, unit_of(p.quantity)) : std::vector{s.number(p.key, unit_of(p.quantity))};
  return law;
}

void read_hardening(const Section& h, Material& m)
{
  const FlowLaw law = read_flow_law(h, "law", "hardening law", hardening_laws());
  if (law.name != flow::Linear::name) {
    m.hardening = law;
    validate_flow(m, h.where());
    return;
  }
  m.hardening_modulus = law.values.at("modulus").front();
  check_hardening(numbers_of(m), h.where(h.node("modulus")));
}

void read_rate(const Section& r, Material& m)
{
  m.rate = read_flow_law(r, "law", "rate law", rate_laws());
  validate_flow(m, r.where());
}

void read_yield_surface(const Section& y, Material& m)
{
  m.yield_surface = read_flow_law(y, "kind", "yield surface", yield_surfaces());
  validate_flow(m, y.where());
}

Material read_material(const Section& s)
{
  s.check_keys(
      {"density", "youngs_modulus", "poisson_ratio", "yield_stress", "hardening", "rate", "yield_surface", "surface_energy", "adhesion_range"});
  Material m;
  const auto where = [&](const char* key) { return s.where(s.node(key)); };
  m.density = s.positive("density", "kg/m^3");
  m.youngs_modulus = s.positive("youngs_modulus", "Pa");
  m.poisson_ratio = s.number("poisson_ratio", "");
  check_elastic(numbers_of(m), where);
  if (s.has("yield_stress")) m.yield_stress = s.positive("yield_stress", "Pa");
  check_yield_stress(numbers_of(m), where);
  for (const char* key : {"hardening", "rate", "yield_surface"})
    if (!m.yields() && s.has(key))
      fail(s.where(s.node(key)), fmt::format("'{}' needs a 'yield_stress'", key));
  if (s.has("hardening")) read_hardening(s.table("hardening", "{law = \"linear\", modulus = 1e9}"), m);
  if (s.has("rate"))
    read_rate(s.table("rate", "{law = \"cowper-symonds\", reference_rate = 40, exponent = 5}"), m);
  if (s.has("yield_surface"))
    read_yield_surface(s.table("yield_surface",
                               "{kind = \"drucker-prager\", friction_angle = 30, "
                               "dilatancy_angle = 10}"),
                       m);
  if (s.has("surface_energy")) m.surface_energy = s.positive("surface_energy", "J/m2");
  if (s.has("adhesion_range")) m.adhesion_range = s.positive("adhesion_range", "m");
  return m;
}

/// {points = [[r, z], ...]}: also sets the radius, where the file does not.
void read_outline(const Section& s, const Section& p, Particle& particle)
{
  p.check_keys({"points"});
  std::vector<ProfilePoint> points;
  for (const auto& [r, z] : p.pairs("points", "[[0, 0], [0.5e-3, 0.1e-3], ..., [0, 2e-3]] in m"))
    points.push_back({r, z});
  particle.profile = outline(std::move(points), p.where(p.node("points")));
  const double widest = particle.profile.widest().r;
  if (s.has("radius") && !(std::abs(s.positive("radius", "m") / widest - 1) <= 0.01))
    fail(s.where(s.node("radius")), "'radius' is not the largest r of the points, to 1 %",
         fmt::format("{:g} m", s.number("radius", "m")), fmt::format("{:g} m, or no radius", widest));
  particle.radius = widest;
}

/// The materials of one particle, in the order in which its keys name them.
class Places
{
 public:
  Places(const std::map<std::string, Material>& known, Particle& particle)
      : known_(known), particle_(particle)
  {
  }
  /// The index into Particle::materials of the one that the section's key 'material' names.
  int of(const Section& section)
  {
    const std::string name = section.text("material");
    const auto found = known_.find(name);
    if (found == known_.end())
      fail_unknown(section.where(section.node("material")), "no material", name, names_of(known_));
    const auto [entry, is_new] = places_.emplace(name, static_cast<int>(particle_.materials.size()));
    if (is_new) particle_.materials.push_back(found->second);
    return entry->second;
  }

 private:
  const std::map<std::string, Material>& known_;
  Particle& particle_;
  std::map<std::string, int> places_;
};

/// {kind = "NAME", ...}: the shape, and the radius of the sphere of its volume. Returns the fault of a file that it
/// names, which stops only those who use the particle.
std::string read_shape_of(const Section& s, Particle& particle, const std::string& folder)
{
  if (s.has("profile")) fail(s.where(s.node("shape")), "a particle has a 'shape' or a 'profile', not both");
  const double radius = s.has("radius") ? s.positive("radius", "m") : 0;
  const NamedShape named =
      read_shape(s.table("shape", "{kind = \"ellipsoid\", axes = [1e-3, 1e-3, 1.5e-3]}"), folder, radius);
  if (radius > 0 && !named.kind->takes_radius())
    fail(s.where(s.node("radius")), "'radius' cannot go with this shape, which says its own size");
  try {
    particle.shape = named.kind->shape(named.values);
  } catch (const Error& fault) {
    if (named.values.path.empty()) throw;
    return fault.what();
  }
  particle.radius = std::cbrt(particle.volume() * 3 / (4 * std::numbers::pi));
  return {};
}

/// Radius and profile.
void read_revolved(const Section& s, Particle& particle)
{
  if (!s.has("profile")) {
    particle.radius = s.positive("radius", "m");
    return;
  }
  const Section p = s.table("profile", "{shape = \"ellipsoid\", aspect = 1.5} or {points = [[r, z], ...]}");
  if (p.has("points")) return read_outline(s, p, particle);
  particle.radius = s.positive("radius", "m");
  const NamedShape named = read_profile(p, particle.radius);
  particle.profile = named.kind->profile(named.values);
}

Particle::Inclusion read_inclusion(const Section& i, bool has_shape, Places& places)
{
  if (has_shape)
    i.check_keys({"material", "pore", "radius", "x", "y", "z"});
  else
    i.check_keys({"material", "pore", "radius", "z", "r"});
  if (i.has("pore") == i.has("material"))
    fail(i.where(), "an inclusion needs one of 'material' and 'pore = true'",
         i.has("pore") ? "both" : "none");
  if (i.has("pore")) i.check_true("pore");
  const auto optional = [&](const char* key) { return i.has(key) ? i.number(key, "m") : 0.0; };
  return {optional("r"),
          has_shape ? optional("z") : i.number("z", "m"),
          i.positive("radius", "m"),
          i.has("pore") ? -1 : places.of(i),
          optional("x"),
          optional("y")};
}

void read_particle(const std::string& name, const Section& s, MaterialsFile& file, const std::string& folder)
{
  s.check_keys({"radius", "material", "layers", "inclusions", "profile", "shape", "impact_body_mass", "impact_body_compliance"});
  Particle& particle = file.particles[name];
  Places places(file.materials, particle);
  places.of(s);
  std::string fault;
  if (s.has("shape"))
    fault = read_shape_of(s, particle, folder);
  else
    read_revolved(s, particle);
  if (s.has("layers"))
    for (const Section& layer : s.tables("layers", "[{material = \"shell\", thickness = 20e-6}]")) {
      layer.check_keys({"material", "thickness"});
      particle.layers.push_back({layer.positive("thickness", "m"), places.of(layer)});
    }
  if (s.has("inclusions"))
    for (const Section& i : s.tables("inclusions", "[{material = \"hard\", radius = 1e-4, z = 5e-4}]"))
      particle.inclusions.push_back(read_inclusion(i, s.has("shape"), places));
  if (s.has("impact_body_mass")) particle.impact_body.mass = s.positive("impact_body_mass", "kg");
  if (s.has("impact_body_compliance")) particle.impact_body.compliance = s.positive("impact_body_compliance", "m/N");
  if (!fault.empty()) {
    file.faults[name] = fault;
    return;
  }
  validate(particle, s.where());
  fixed_to(particle, particle.impact_body, s.where());
  check_plausible(s.where(), "radius", "radius", particle.radius);
}

void check_name(const std::string& name, const std::string& where)
{
  constexpr const char* allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  if (name.empty() || name.size() > 100 || name.find_first_not_of(allowed) != std::string::npos ||
      name == wall_name)
    fail(where, "unusable name", fmt::format("'{}'", cut(name)),
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

MaterialsFile read_materials(const std::string& path)
{
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) fail(path, "no such file");
  if (!std::filesystem::is_regular_file(path, ignored) || !std::ifstream(path))
    fail(path, "cannot be read as a file");
  toml::table root;
  try {
    root = toml::parse_file(path);
  } catch (const toml::parse_error& error) {
    fail(fmt::format("{}:{}", path, error.source().begin.line), cut(std::string(error.description()), 200));
  }
  MaterialsFile file;
  file.source = path;
  const std::string folder = std::filesystem::path(path).parent_path().string();
  Section(path, root, "file").check_keys({"material", "particle"});
  each_section(path, root, "material",
               [&](const std::string& name, const Section& s) { file.materials[name] = read_material(s); });
  each_section(path, root, "particle", [&](const std::string& name, const Section& s) {
    read_particle(name, s, file, folder);
  });
  if (file.materials.empty()) fail(path, "the file defines no material, as [material.NAME]");
  return file;
}

}  // namespace granulaw
