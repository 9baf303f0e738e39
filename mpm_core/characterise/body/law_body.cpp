#include "characterise/body/law_body.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/state_archive.hpp"
#include "characterise/body/law_material.hpp"

namespace granulaw {

namespace {

LawBody body_of_material(const std::string& name, const Material& material)
{
  const CharacterisedBody characterised = characterised_body_of(material);
  return {law_material(name, material), characterised, sphere_name, material_hash(characterised, material)};
}

/// Body of any shape: the sphere of its material, at whatever radius touches.
LawBody body_of_shape(const std::string& name, const Particle& particle, const std::string& where)
{
  const bool uniform =
      particle.materials.size() == 1 && particle.layers.empty() && particle.inclusions.empty();
  if (!uniform)
    fail(where,
         "has a shape in three dimensions and layers or inclusions, which no sphere of its radius of "
         "curvature represents: a law is made of shapes of one material, or of a profile");
  if (particle.materials.front().rate_dependent())
    fail(where,
         "has a shape in three dimensions and a material that depends on the rate, whose law holds "
         "for one radius: a shape touches with many");
  LawBody body = body_of_material(name, particle.materials.front());
  body.shape = particle;
  return body;
}

LawBody body_of_particle(const std::string& name, const Particle& particle, const std::string& source)
{
  const std::string where = fmt::format("{}: [particle.{}]", source, name);
  for (const Material& m : particle.materials) check_von_mises(m, where);
  if (particle.shape) return body_of_shape(name, particle, where);
  const CharacterisedBody characterised = characterised_body_of(particle);
  const Material& at_pole = particle.materials[static_cast<std::size_t>(characterised.pole_material)];
  LawBody body{law_material(name, at_pole), characterised, sphere_name,
               material_hash(characterised, at_pole)};
  if (particle.is_homogeneous_sphere()) return body;
  body.body = name;
  if (characterised.yields()) body.material.yield_stress = characterised.yield * characterised.scale.stress;
  return body;
}

}  // namespace

LawBody law_body(const std::string& name, const Materials& materials, const std::string& hint)
{
  if (materials.means_particle(name))
    return body_of_particle(name, materials.particle(name), materials.source);
  const Material& material = materials.material(name);
  const std::string where = fmt::format("{}: [material.{}]", materials.source, name);
  check_von_mises(material, where);
  if (material.rate_dependent())
    fail(where, fmt::format(
                    "its yield stress depends on the rate ('{}'), so its law depends on the particle's size: "
                    "{}",
                    material.rate.name, hint));
  return body_of_material(name, material);
}

std::string material_hash(const CharacterisedBody& characterised, const Material& m)
{
  const std::string text =
      characterised.is_plain()
          ? fmt::format("{:.17g} {:.17g} {:.17g} {:.17g} {:.17g}", m.density, m.youngs_modulus,
                        m.poisson_ratio, m.yield_stress, m.hardening_modulus)
          : characterised.description;
  return fmt::format("{:016x}", checksum(text));
}

}  // namespace granulaw
