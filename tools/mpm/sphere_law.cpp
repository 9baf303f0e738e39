#include "sphere_law.hpp"

#include <fmt/format.h>

#include "atlas/law_from_atlas.hpp"
#include "base/error.hpp"
#include "characterise/body/characterised_body.hpp"
#include "characterise/body/law_material.hpp"
#include "law/law_file.hpp"
#include "own_files.hpp"

namespace granulaw {

namespace {

/// The name of the particle's material, by which law files call it.
std::string material_name(const MaterialsFile& file, const Material& material)
{
  for (const auto& [name, one] : file.materials)
    if (description_of(one) == description_of(material)) return name;
  return "material";
}

Law law_of_atlas(const std::string& materials, const LawMaterial& material, const Material& whole, const std::string& command, const std::string& instead)
{
  const auto atlas = own_atlas();
  if (!atlas) fail(command, fmt::format("the atlas that came with the program is missing: give --law, or {}", instead));
  std::string why = atlas->why_not(MaterialRatios::of(material));
  if (why.empty() && !(whole.hardening.name.empty() && whole.rate.name.empty() && whole.yield_surface.name.empty()))
    why = "has a hardening law or a rate that the atlas does not hold";
  if (!why.empty()) fail(materials, fmt::format("'{}' {}: make its law by mpm table and give it as --law, or say {}", material.name, why, instead));
  LawRange range;
  range.depth = Atlas::depth, range.fastest = 0.3;
  Law law;
  law.bodies[material.name] = law_from(*atlas, material, range);
  law.pairs.push_back({material.name, wall_name});
  return law;
}

}  // namespace

SphereLaw sphere_law(const std::string& materials, const std::string& particle, const std::string& law, const std::string& command, const std::string& instead)
{
  const MaterialsFile file = read_materials(materials);
  const Particle& sphere = file.particle(particle);
  if (!sphere.is_homogeneous_sphere()) fail(materials, fmt::format("'{}' is no homogeneous sphere", particle), particle, "a sphere of one material");
  const Material& material = sphere.materials.front();
  const LawMaterial named = law_material(material_name(file, material), material);
  SphereLaw found{law.empty() ? law_of_atlas(materials, named, material, command, instead) : read_law(law), named.name, law.empty() ? materials : law};
  if (found.law.bodies.contains(particle)) found.name = particle;
  check_size(found.wall(), sphere.radius, command);
  return found;
}

}  // namespace granulaw
