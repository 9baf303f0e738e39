#pragma once

#include "characterise/body/materials.hpp"

namespace granulaw {

/// E*/Y = 30: yields early, so that its runs are the cheapest.
inline Material soft_powder()
{
  Material m;
  m.density = 1500;
  m.youngs_modulus = 2.73e9;
  m.poisson_ratio = 0.3;
  m.yield_stress = 100e6;
  return m;
}

/// Elastic.
inline Material glass()
{
  Material m;
  m.density = 2500;
  m.youngs_modulus = 70e9;
  m.poisson_ratio = 0.22;
  return m;
}

inline Material rate_dependent_powder()
{
  Material m = soft_powder();
  m.rate = {"cowper-symonds", {{"reference_rate", {40.}}, {"exponent", {5.}}}};
  return m;
}

/// Powder, stronger powder and glass; a grain of the powder, one coated with glass, one whose yield stress
/// depends on the rate.
inline Materials some_materials()
{
  Material stronger = soft_powder();
  stronger.yield_stress = 130e6;
  Materials m{"test", {{"powder", soft_powder()}, {"stronger", stronger}, {"glass", glass()}}, {}};
  m.particles["grain"] = Particle::sphere(2e-3, soft_powder());
  m.particles["rated"] = Particle::sphere(2e-3, rate_dependent_powder());
  Particle coated = Particle::sphere(2e-3, soft_powder());
  coated.materials.push_back(glass());
  coated.layers.push_back({1e-4, 1});
  m.particles["coated"] = coated;
  return m;
}

}  // namespace granulaw
