#pragma once

#include <string>
#include <vector>

#include "characterise/body/materials.hpp"
#include "solver/run/compact.hpp"

namespace granulaw {

/// Spheres in a box from a file, and their materials in the order in which the packing counts them. Formats:
///
///     # box LX LY LZ                    the first line, m: from 0
///     x y z radius [material]           m; a line for each sphere; # begins a comment
///
/// or a dump of LIGGGHTS (dump custom with x y z radius, also type; the last frame), or a data file of its
/// atom style granular (id type diameter density x y z). A box that does not begin at 0 is moved there.
struct PackingFile
{
  Packing packing;
  std::vector<std::string> names;
  std::vector<Material> materials;
};

/// `by_type`: material of each atom type, in order; empty: the materials file has one. Throws Error.
PackingFile read_packing(const std::string& path, const Materials& materials,
                         const std::vector<std::string>& by_type = {});

}  // namespace granulaw
