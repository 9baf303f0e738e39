#include "deck/commands/materials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "deck/commands/reading.hpp"

namespace granulaw::deck {

namespace {

void require_positive(const std::string& name, double value)
{
  if (!(value > 0)) misread(fmt::format("{} must be positive", name));
}

void set_youngs_modulus(TypeMaterial& m, double value)
{
  require_positive("youngsModulus", value);
  m.youngs_modulus = value;
}

void set_poisson_ratio(TypeMaterial& m, double value)
{
  if (!(value > -1 && value <= 0.5)) misread(fmt::format("{:g} is no Poisson's ratio", value));
  m.poisson_ratio = value;
}

void set_yield_stress(TypeMaterial& m, double value)
{
  require_positive("yieldStress", value);
  m.yield_stress = value;
}

struct Property
{
  std::string_view name;
  void (*set)(TypeMaterial& material, double value);
};

/// The properties of atom types that a plan uses: a new one is a line here and a function above.
constexpr std::array properties{
    Property{"YoungsModulus", set_youngs_modulus}, Property{"poissonsRatio", set_poisson_ratio},
    Property{"yieldStress", set_yield_stress}, Property{"youngsModulus", set_youngs_modulus}};

/// `coefficientRestitution peratomtypepair N E...`: the smallest.
void follow_restitution(Scene& scene, const std::string& kind, Words& w)
{
  if (kind != "peratomtypepair" || w.count() == 0) return;
  while (w.more()) scene.restitution = std::min(w.value(), scene.restitution.value_or(1.0));
}

}  // namespace

void follow_property(Reading& reading, const Fix&, Words w)
{
  const std::string name = w.word(), kind = w.word();
  if (name == "coefficientRestitution") return follow_restitution(reading.scene, kind, w);
  for (const Property& property : properties) {
    if (property.name != name) continue;
    if (kind != "peratomtype") misread(fmt::format("{} must be peratomtype", name));
    for (int type = 1; w.more(); ++type) {
      const double value = w.value();
      property.set(reading.scene.materials[type], value);
    }
  }
  // every other property has no bearing on a plan
}

}  // namespace granulaw::deck
