#pragma once

#include <map>
#include <string>

#include "solver/particle.hpp"

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
///     [particle.grain]             # a homogeneous sphere
///     radius = 2e-3                # m
///     material = "powder"
///
///     [particle.coated]            # any of the three keys below, in any combination: docs/particles.md
///     radius = 2e-3                # m: largest distance from the axis; may be left out with points
///     material = "powder"          # the body; of a layered one, the core
///     layers = [{material = "shell", thickness = 20e-6}]          # m; from the surface inwards
///     inclusions = [{material = "hard", radius = 0.2e-3, z = 1e-3},            # m: a ball on the axis whose
///                                                      # centre is z above the contact pole
///                   {pore = true, radius = 0.1e-3, z = 1e-3, r = 0.5e-3}]      # a ring, r from the axis
///     profile = {shape = "ellipsoid", aspect = 1.5}    # a body of revolution that hits along its axis; the
///                                                      # shapes and their keys: solver/profiles.hpp; or
///         {points = [[0, 0], [1e-3, 0.2e-3], ...]}     # m: [r, z] from the contact pole to the far pole
struct MaterialsFile
{
  std::string path;
  std::map<std::string, Material> materials;
  std::map<std::string, Particle> particles;  ///< checked

  /// These throw Error naming the nearest where there is no such particle or material.
  const Particle& particle(const std::string& name) const;
  const Material& material(const std::string& name) const;
  /// A particle that is a homogeneous sphere; of any other it says so, as Error.
  Sphere sphere(const std::string& particle) const;
};

/// Every problem is one sentence with file, line and key, as Error.
MaterialsFile read_materials(const std::string& path);

}  // namespace granulaw
