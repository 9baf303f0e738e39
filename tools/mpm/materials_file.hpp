#pragma once

#include <map>
#include <string>

#include "solver/material.hpp"

namespace granulaw {

/// MATERIALS.toml, read and checked: SI numbers.
///
///     [material.powder]            # any number of materials
///     density = 1500               # kg/m^3
///     youngs_modulus = 10e9        # Pa
///     poisson_ratio = 0.3          # 0 to below 0.5
///     yield_stress = 100e6         # Pa; leave it out for an elastic material
///     hardening = {law = "linear", modulus = 1e9}   # Pa; leave it out for a perfectly plastic one; or
///         {law = "swift", strength = 251e6, exponent = 0.2, offset = 0.01}  # strength (offset +
///         ep)^exponent {law = "voce", saturation_stress = 200e6, strain = 0.1}     # S - (S - Y)
///         exp(-ep/strain) {law = "johnson-cook", strength = 150e6, exponent = 0.3}    # Y + strength
///         ep^exponent {law = "tabulated", strain = [0, 0.1, 1], stress = [100e6, 150e6, 180e6]}  # straight
///         between, then constant
///     rate = {law = "johnson-cook", coefficient = 0.02, reference_rate = 1}   # 1/s: times 1 + C
///     ln(rate/reference); or
///         {law = "cowper-symonds", reference_rate = 40, exponent = 5}         # times 1 +
///         (rate/reference)^(1/exponent)
///
///     [particle.grain]             # homogeneous spheres
///     radius = 2e-3                # m
///     material = "powder"
struct MaterialsFile
{
  std::string path;
  std::map<std::string, Material> materials;
  struct Particle
  {
    double radius;
    std::string material;
  };  // m
  std::map<std::string, Particle> particles;

  /// Throws Error naming the nearest where there is no such particle or material.
  Sphere sphere(const std::string& particle) const;
  const Material& material(const std::string& name) const;
};

/// Every problem is one sentence with file, line and key, as Error.
MaterialsFile read_materials(const std::string& path);

}  // namespace granulaw
