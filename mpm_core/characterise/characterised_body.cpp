#include "characterise/characterised_body.hpp"

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

std::string text_of(const Material& m)
{
  return fmt::format("[{:.17g} {:.17g} {:.17g} {:.17g} {:.17g}{}{}]", m.density, m.youngs_modulus,
                     m.poisson_ratio, m.yield_stress, m.hardening_modulus, text_of("hardening", m.hardening),
                     text_of("rate", m.rate));
}

std::string text_of(const Particle& p)
{
  std::string text = fmt::format("radius={:.17g}", p.radius);
  for (const Material& m : p.materials) text += text_of(m);
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

/// Least distances from the contact pole, over the length.
struct PoleDistances
{
  std::vector<double> material;  ///< 0: the pole's own, or too small to be found
  double pore = never;
};

/// By a raster of the meridian.
PoleDistances distances_from_pole(const Particle& p, double length, int pole_material)
{
  constexpr int cells = 400;
  const double dz = p.height() / cells, dr = p.radius / cells, diagonal = std::hypot(dr, dz);
  PoleDistances nearest{std::vector<double>(p.materials.size(), never)};
  for (int i = 0; i < cells; ++i)
    for (int k = 0; k < cells; ++k) {
      const double r = (i + 0.5) * dr, z = (k + 0.5) * dz;
      if (p.depth(r, z) < 0) continue;
      const int at = p.material_at(r, z);
      double& d = at < 0 ? nearest.pore : nearest.material[static_cast<std::size_t>(at)];
      d = std::min(d, std::max(0.0, std::hypot(r, z) - 0.5 * diagonal) / length);
    }
  for (double& d : nearest.material)
    if (d == never) d = 0;
  nearest.material[static_cast<std::size_t>(pole_material)] = 0;
  return nearest;
}

/// Overlap at which a material at this distance from the pole begins to yield, all over the length and E* at
/// the pole: where the von Mises stress on the axis of Hertz's contact reaches Y there (Johnson 1985,
/// eq. 3.45).
double buried_onset(double yield, double poisson_ratio, double distance)
{
  const double at_pole = onset_overlap(1.0, yield, poisson_ratio);
  const double largest = 1 / onset_pressure_ratio(poisson_ratio);  // over p0, at a depth of about a half of a
  const auto mises = [&](double a) {
    const double z = distance / a;
    return z > 0.48 ? 1.5 / (1 + z * z) - (1 + poisson_ratio) * (1 - z * std::atan(1 / z)) : largest;
  };
  double a = std::sqrt(at_pole);
  while (a < 1 && 2 * a / M_PI * mises(a) < yield * (1 - 1e-9)) a *= 1.02;  // p0 = 2 a/pi
  // A half for what the bodies' different stiffnesses do: too early an onset costs a few runs, too late a one
  // calls elastic what is not.
  return a * a > at_pole ? std::max(at_pole, 0.5 * a * a) : at_pole;
}

void fill_yield(CharacterisedBody& s)
{
  s.yield = s.onset = never;
  PoleDistances distance{std::vector<double>(s.particle.materials.size(), 0.0)};
  if (!s.particle.layers.empty() || !s.particle.inclusions.empty())
    distance = distances_from_pole(s.particle, s.scale.length, s.pole_material);
  s.skin = distance.pore;
  for (std::size_t k = 0; k < s.particle.materials.size(); ++k) {
    if (static_cast<int>(k) != s.pole_material) s.skin = std::min(s.skin, distance.material[k]);
    const Material& m = s.particle.materials[k];
    if (!m.yields()) continue;
    const double yield = m.yield_stress / s.scale.stress;
    s.yield = std::min(s.yield, yield);
    s.onset = std::min(s.onset, buried_onset(yield, m.poisson_ratio, distance.material[k]));
  }
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
  if (material.rate_dependent())
    fail("contact law", "a rate-dependent material's law needs a particle of a certain size");
  if (material.hardening.name.empty()) {
    CharacterisedBody s =
        characterised_body_of(material.e_star() / material.yield_stress, material.poisson_ratio,
                              material.hardening_modulus / material.youngs_modulus);
    return material.yields() ? s : s.elastic();
  }
  CharacterisedBody s;
  s.particle = Particle::from(Sphere{1.0, material});
  s.scale = {1.0, material.e_star(), material.density};
  s.poisson_ratio = material.poisson_ratio;
  s.mass = 4.0 / 3.0 * M_PI;
  s.description = text_of(s.particle);
  fill_yield(s);
  return s;
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
  s.particle = Particle::from(Sphere{1.0, m});
  s.poisson_ratio = poisson_ratio;
  s.mass = 4.0 / 3.0 * M_PI;
  fill_yield(s);
  fill_plain(s);
  return s;
}

}  // namespace granulaw
