#include "characterise/body/characterised_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"

namespace granulaw {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

std::string text_of(const char* what, const FlowLaw& law)
{
  if (law.name.empty()) return {};
  std::string text = fmt::format(" {}={}", what, law.name);
  for (const auto& [key, values] : law.values) {
    text += fmt::format(" {}", key);
    for (const double v : values) text += fmt::format(",{:.17g}", v);
  }
  return text;
}

}  // namespace

std::string description_of(const Material& m)
{
  return fmt::format("[{:.17g} {:.17g} {:.17g} {:.17g} {:.17g}{}{}{}]", m.density, m.youngs_modulus,
                     m.poisson_ratio, m.yield_stress, m.hardening_modulus, text_of("hardening", m.hardening),
                     text_of("rate", m.rate), text_of("surface", m.yield_surface));
}

void check_von_mises(const Material& m, const std::string& where)
{
  if (!m.yield_surface.name.empty())
    fail(where,
         "'yield_surface': a contact law is made of materials that yield by von Mises only; mpm impact and "
         "mpm press run this one",
         m.yield_surface.name, "no yield_surface");
}

namespace {

std::string text_of(const Particle& p)
{
  std::string text = fmt::format("radius={:.17g}", p.radius);
  for (const Material& m : p.materials) text += description_of(m);
  for (const Particle::Layer& l : p.layers) text += fmt::format(" layer {:.17g} {}", l.thickness, l.material);
  for (const Particle::Inclusion& i : p.inclusions)
    text += fmt::format(" inclusion {:.17g} {:.17g} {:.17g} {}", i.r, i.z, i.radius, i.material);
  for (const ProfilePoint& q : p.profile) text += fmt::format(" {:.17g},{:.17g}", q.r, q.z);
  return text;
}

/// Mass, by the volumes that a fine raster of the meridian finds of each material; a homogeneous body's is
/// exact.
double mass_of(const Particle& p)
{
  if (p.layers.empty() && p.inclusions.empty()) return p.materials[0].density * p.volume();
  constexpr int cells = 400;
  const double height = p.height(), dz = height / cells, dr = p.radius / cells;
  double mass = 0, volume = 0;
  for (int i = 0; i < cells; ++i)
    for (int k = 0; k < cells; ++k) {
      const double r = (i + 0.5) * dr, z = (k + 0.5) * dz;
      if (p.depth(r, z) < 0) continue;
      const double ring = 2 * M_PI * r * dr * dz;
      const int at = p.material_at(r, z);
      volume += ring;
      if (at >= 0) mass += ring * p.materials[static_cast<std::size_t>(at)].density;
    }
  return mass * p.volume() / volume;  // what the raster misses at the surface
}

/// Least distance from the contact pole, over the length, of a pore or of a material other than the pole's,
/// by a raster of the meridian; infinity: there is none.
double skin_of(const Particle& p, double length, int pole_material)
{
  if (p.layers.empty() && p.inclusions.empty()) return never;
  constexpr int cells = 400;
  const double dz = p.height() / cells, dr = p.radius / cells, diagonal = std::hypot(dr, dz);
  double nearest = never;
  for (int i = 0; i < cells; ++i)
    for (int k = 0; k < cells; ++k) {
      const double r = (i + 0.5) * dr, z = (k + 0.5) * dz;
      if (p.depth(r, z) < 0 || p.material_at(r, z) == pole_material) continue;
      nearest = std::min(nearest, std::max(0.0, std::hypot(r, z) - 0.5 * diagonal) / length);
    }
  return nearest;
}

void fill_yield(CharacterisedBody& s)
{
  s.yield = never;
  for (const Material& m : s.particle.materials) s.yield = std::min(s.yield, m.yield_stress / s.scale.stress);
  s.skin = skin_of(s.particle, s.scale.length, s.pole_material);
  s.onset = s.yields() ? onset_overlap(1.0, s.yield, s.poisson_ratio) : never;
}

void fill_plain(CharacterisedBody& s)
{
  const Material& m = s.particle.materials[0];
  s.description = fmt::format("nu={:.17g} yield={:.17g} hardening={:.17g}", m.poisson_ratio, m.yield_stress,
                              m.hardening_modulus);
}

}  // namespace

bool CharacterisedBody::rate_dependent() const
{
  return std::any_of(particle.materials.begin(), particle.materials.end(),
                     [](const Material& m) { return m.rate_dependent(); });
}

CharacterisedBody CharacterisedBody::elastic() const
{
  CharacterisedBody other = *this;
  for (Material& m : other.particle.materials) {
    m.yield_stress = never;
    m.hardening_modulus = 0;
    m.hardening = m.rate = {};
  }
  other.yield = other.onset = never;
  if (other.particle.is_homogeneous_sphere() && is_plain())
    fill_plain(other);
  else
    other.description = text_of(other.particle);
  return other;
}

CharacterisedBody CharacterisedBody::rate_free() const
{
  Particle other = particle;
  for (Material& m : other.materials) m.rate = {};
  return characterised_body_of(other);
}

CharacterisedBody characterised_body_of(const Particle& particle)
{
  check_revolution(particle, "contact law");
  for (const Material& m : particle.materials) check_von_mises(m, "contact law");
  if (particle.is_homogeneous_sphere() && !particle.materials[0].rate_dependent() &&
      particle.materials[0].hardening.name.empty())
    return characterised_body_of(particle.materials[0]);
  CharacterisedBody s;
  s.particle = particle;
  const double pole = particle.pole_curvature_radius();
  if (!(pole > 1e-3 * particle.radius && pole < 1e3 * particle.radius))
    fail("contact law", "a body needs a rounded contact pole",
         fmt::format("radius of curvature {:.3g} m", pole),
         fmt::format("0.001 to 1000 times its radius {:.3g} m", particle.radius));
  s.pole_material = std::max(0, particle.material_at(0.0, 1e-9 * pole));
  const Material& m = particle.materials[static_cast<std::size_t>(s.pole_material)];
  s.scale = {pole, m.e_star(), m.density};
  s.poisson_ratio = m.poisson_ratio;
  s.mass = mass_of(particle) / s.scale.mass();
  s.description = text_of(particle);
  fill_yield(s);
  return s;
}

CharacterisedBody characterised_body_of(const Material& material)
{
  check_von_mises(material, "contact law");
  if (material.rate_dependent())
    fail("contact law", "a rate-dependent material's law needs a particle of a certain size");
  if (material.hardening.name.empty()) {
    CharacterisedBody s =
        characterised_body_of(material.e_star() / material.yield_stress, material.poisson_ratio,
                              material.hardening_modulus / material.youngs_modulus);
    return material.yields() ? s : s.elastic();
  }
  CharacterisedBody s;
  s.particle = Particle::sphere(1.0, material);
  s.scale = {1.0, material.e_star(), material.density};
  s.poisson_ratio = material.poisson_ratio;
  s.mass = 4.0 / 3.0 * M_PI;
  s.description = text_of(s.particle);
  fill_yield(s);
  return s;
}

BodyNumbers numbers_of(const CharacterisedBody& body)
{
  return {body.onset, body.yield, body.mass, body.scale.length, body.rate_dependent()};
}

double pole_onset(const CharacterisedBody& s)
{
  const Material& m = s.particle.materials[static_cast<std::size_t>(s.pole_material)];
  return m.yields() ? onset_overlap(1.0, m.yield_stress / s.scale.stress, m.poisson_ratio) : never;
}

CharacterisedBody characterised_body_of(double e_star_over_yield, double poisson_ratio,
                                        double hardening_over_e)
{
  Material m;
  m.density = 1;
  m.poisson_ratio = poisson_ratio;
  m.youngs_modulus = 1 - poisson_ratio * poisson_ratio;
  m.yield_stress = 1 / e_star_over_yield;
  m.hardening_modulus = hardening_over_e * m.youngs_modulus;
  CharacterisedBody s;
  s.particle = Particle::sphere(1.0, m);
  s.poisson_ratio = poisson_ratio;
  s.mass = 4.0 / 3.0 * M_PI;
  fill_yield(s);
  fill_plain(s);
  return s;
}

}  // namespace granulaw
