#include "solver/shape/shapes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"

namespace granulaw {

// Each at the end of the file of its shape.
ShapeKind sphere_kind();
ShapeKind ellipsoid_kind();
ShapeKind superquadric_kind();
ShapeKind box_kind();
ShapeKind polyhedron_kind();
ShapeKind clump_kind();
ShapeKind mesh_kind();
ShapeKind ellipsoid_profile_kind();
ShapeKind flattened_sphere_kind();
ShapeKind conical_tip_kind();
ShapeKind tablet_kind();

const std::vector<ShapeKind>& shape_kinds()
{
  static const std::vector<ShapeKind> kinds{
      sphere_kind(),           ellipsoid_kind(),   superquadric_kind(), box_kind(),
      polyhedron_kind(),       clump_kind(),       mesh_kind(),         ellipsoid_profile_kind(),
      flattened_sphere_kind(), conical_tip_kind(), tablet_kind()};
  return kinds;
}

bool ShapeKind::takes_radius() const
{
  return std::any_of(keys.begin(), keys.end(),
                     [](const ShapeKey& key) { return key.name == std::string("radius"); });
}

ShapeKey ShapeKey::positive(const char* name, const char* unit, bool required)
{
  return {name, unit, std::numeric_limits<double>::min(), std::numeric_limits<double>::max(), required};
}

ShapeKey ShapeKey::lengths(const char* name)
{
  ShapeKey key = positive(name, "m");
  key.form = Form::numbers, key.count = 3, key.holds = "three lengths, along x, y and z";
  return key;
}

std::vector<Vector3> ShapeValues::points(const char* key) const
{
  const std::vector<double>& all = numbers.at(key);
  std::vector<Vector3> found;
  for (std::size_t k = 0; k + 2 < all.size(); k += 3) found.emplace_back(all[k], all[k + 1], all[k + 2]);
  return found;
}

Vector3 ShapeValues::lengths(const char* key) const
{
  constexpr double longest_share = 100;  // no grid would resolve both lengths
  const Vector3 v = points(key).front();
  if (v.maxCoeff() > longest_share * v.minCoeff())
    fail(where(key), fmt::format("'{}' makes the body too flat or too slender", key),
         fmt::format("[{:g}, {:g}, {:g}] m", v.x(), v.y(), v.z()),
         fmt::format("lengths up to {:g} times each other", longest_share));
  return v;
}

}  // namespace granulaw
