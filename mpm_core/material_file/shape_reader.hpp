#pragma once

#include "solver/shape/shapes.hpp"
#include "material_file/toml_section.hpp"

namespace granulaw {

/// A kind of the list shape_kinds() with the values that a table of the file gives it.
struct NamedShape
{
  const ShapeKind* kind;
  ShapeValues values;
};

/// {kind = "NAME", key = value, ...} of a shape in three dimensions, {shape = "NAME", ...} of a profile.
/// Paths of files are relative to `folder`. `radius`, m, is the particle's own; 0: none.
NamedShape read_shape(const Section& table, const std::string& folder, double radius);
NamedShape read_profile(const Section& table, double radius);

/// "sphere, ellipsoid, ...": those in three dimensions.
std::string names_of_shapes();

}  // namespace granulaw
