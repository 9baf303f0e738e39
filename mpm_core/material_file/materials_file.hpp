#pragma once

#include <string>

#include "characterise/body/materials.hpp"

namespace granulaw {

/// MATERIALS.toml, read and checked: SI numbers. Its path is the source of the Materials.
///
///     [material.powder]            # any number of materials
///     density = 1500               # kg/m^3
///     youngs_modulus = 10e9        # Pa
///     poisson_ratio = 0.3          # 0 to below 0.5
///     yield_stress = 100e6         # Pa; leave it out for an elastic material
///     hardening = {law = "linear", modulus = 1e9}   # Pa; leave it out for a perfectly plastic one; or
///         # strength (offset + ep)^exponent
///         {law = "swift", strength = 251e6, exponent = 0.2, offset = 0.01}
///         # S - (S - Y) exp(-ep/strain)
///         {law = "voce", saturation_stress = 200e6, strain = 0.1}
///         # Y + strength ep^exponent
///         {law = "johnson-cook", strength = 150e6, exponent = 0.3}
///         # straight between, then constant
///         {law = "tabulated", strain = [0, 0.1, 1], stress = [100e6, 150e6, 180e6]}
///     # times 1 + C ln(rate/reference), 1/s
///     rate = {law = "johnson-cook", coefficient = 0.02, reference_rate = 1}; or
///         # times 1 + (rate/reference)^(1/exponent)
///         {law = "cowper-symonds", reference_rate = 40, exponent = 5}
///     surface_energy = 0.05        # J/m2, of each surface that sticks; leave it out for none
///     adhesion_range = 0.4e-9      # m, gap at which its attraction ends
///
///     [particle.grain]             # a homogeneous sphere
///     radius = 2e-3                # m
///     material = "powder"
///
///     [particle.capsule]           # layers, inclusions, profile: any of them (docs/guide/particles.md)
///     radius = 2e-3                # m: largest distance from the axis; may be left out with points
///     material = "powder"          # the body; of a layered one, the core
///     # from the surface inwards; m
///     layers = [{material = "shell", thickness = 20e-6}]
///     # balls on the axis, centre z above the contact pole; with r from the axis: rings; m
///     inclusions = [{material = "hard", radius = 0.2e-3, z = 1e-3},
///                   {pore = true, radius = 0.1e-3, z = 1e-3, r = 0.5e-3}]
///     # a body of revolution that hits along its axis; shapes and their keys: solver/shape/profiles.cpp
///     profile = {shape = "ellipsoid", aspect = 1.5}; or
///         # [r, z] from the contact pole to the far pole; m
///         {points = [[0, 0], [1e-3, 0.2e-3], [0, 2e-3]]}
///
///     [particle.pebble]            # a body of any shape, instead of radius and profile; m
///     material = "powder"
///     shape = {kind = "ellipsoid", axes = [1e-3, 1.2e-3, 1.5e-3]}    # half axes; or
///         {kind = "sphere", radius = 1e-3}
///         {kind = "superquadric", axes = [1e-3, 1e-3, 2e-3], exponents = [4, 2]}    # LIGGGHTS's n1, n2
///         {kind = "box", sides = [2e-3, 2e-3, 3e-3], edge_radius = 0.2e-3}
///         {kind = "polyhedron", corners = [[0, 0, 0], [2e-3, 0, 0], ...], edge_radius = 0.2e-3}
///         {kind = "clump", file = "stone.multisphere", scale = 1e-3}  # lines of x y z r; scale may be left
///         out {kind = "mesh", file = "stone.stl", scale = 1e-3}           # closed triangle mesh
///     inclusions = [{pore = true, radius = 0.1e-3, x = 0.3e-3, y = 0, z = 0}]    # balls
using MaterialsFile = Materials;

/// Every problem is one sentence with file, line and key, as Error. A file that a particle names and that cannot be used
/// stops those who use the particle (Materials::faults).
MaterialsFile read_materials(const std::string& path);

}  // namespace granulaw
