#include "shape_reader.hpp"

#include <filesystem>

#include "solver/shape/box_solid.hpp"
#include "solver/shape/clump_solid.hpp"
#include "solver/shape/ellipsoid_solid.hpp"
#include "solver/shape/mesh_solid.hpp"
#include "solver/shape/polyhedron_solid.hpp"
#include "solver/shape/sphere_solid.hpp"
#include "solver/shape/superquadric_solid.hpp"

namespace granulaw {

namespace {

using SharedSolid = std::shared_ptr<const Solid>;

struct Surroundings
{
  const std::string& folder;
  double radius;
};

/// No length of a body may be this many times another: no grid would resolve both.
constexpr double longest_share = 100;

void fail_at(const Section& s, const char* key, const std::string& what, const std::string& found,
             const std::string& allowed)
{
  fail(s.where(s.node(key)), fmt::format("'{}' {}", key, what), found, allowed);
}

/// Three lengths over 0, m, none more than a hundred times another.
Vector3 lengths(const Section& s, const char* key)
{
  const std::vector<double> values = s.numbers(key, "m");
  const std::string found = fmt::format("{} numbers", values.size());
  if (values.size() != 3) fail_at(s, key, "must hold three lengths, along x, y and z", found, "3");
  const Vector3 v(values[0], values[1], values[2]);
  const std::string text = fmt::format("[{:g}, {:g}, {:g}] m", v.x(), v.y(), v.z());
  if (!(v.allFinite() && v.minCoeff() > 0)) fail_at(s, key, "is out of range", text, "over 0 m");
  if (v.maxCoeff() > longest_share * v.minCoeff())
    fail_at(s, key, "makes the body too flat or too slender", text,
            fmt::format("lengths up to {:g} times each other", longest_share));
  return v;
}

double scale_of(const Section& s)
{
  return s.has("scale") ? s.positive("scale", "") : 1;
}

std::string file_of(const Section& s, const Surroundings& around)
{
  const std::filesystem::path file(s.text("file"));
  return file.is_absolute() ? file.string() : (std::filesystem::path(around.folder) / file).string();
}

SharedSolid read_sphere(const Section& s, const Surroundings& around)
{
  return std::make_shared<SphereSolid>(s.has("radius") || around.radius == 0 ? s.positive("radius", "m")
                                                                             : around.radius);
}

SharedSolid read_ellipsoid(const Section& s, const Surroundings&)
{
  return std::make_shared<EllipsoidSolid>(lengths(s, "axes"));
}

SharedSolid read_superquadric(const Section& s, const Surroundings&)
{
  const Vector3 axes = lengths(s, "axes");
  const std::vector<double> n = s.numbers("exponents", "");
  if (n.size() != 2)
    fail_at(s, "exponents", "must hold two numbers, LIGGGHTS's blockiness n1 and n2",
            fmt::format("{} numbers", n.size()), "2");
  for (const double exponent : n)
    if (!(exponent >= 2 && exponent <= 20))
      fail_at(s, "exponents", "is out of range", fmt::format("{:g}", exponent), "2 to 20");
  return std::make_shared<SuperquadricSolid>(axes, n[0], n[1]);
}

SharedSolid read_box(const Section& s, const Surroundings&)
{
  const Vector3 sides = lengths(s, "sides");
  const double radius = s.positive("edge_radius", "m"), least = 1e-3 * sides.minCoeff();
  if (!(radius >= least && radius <= 0.5 * sides.minCoeff()))
    fail_at(s, "edge_radius", "does not fit the sides", fmt::format("{:g} m", radius),
            fmt::format("{:g} to {:g} m, a thousandth to half of the shortest side", least,
                        0.5 * sides.minCoeff()));
  return std::make_shared<BoxSolid>(sides, radius);
}

SharedSolid read_polyhedron(const Section& s, const Surroundings&)
{
  const std::vector<std::vector<double>> rows = s.rows("corners", 3, "[[0, 0, 0], [1e-3, 0, 0], ...] in m");
  if (rows.size() < 4 || rows.size() > 100)
    fail_at(s, "corners", "must hold the corners of a body", fmt::format("{}", rows.size()), "4 to 100");
  std::vector<Vector3> corners;
  for (const std::vector<double>& row : rows) corners.emplace_back(row[0], row[1], row[2]);
  return std::make_shared<PolyhedronSolid>(corners, s.positive("edge_radius", "m"),
                                           s.where(s.node("corners")));
}

SharedSolid read_clump_solid(const Section& s, const Surroundings& around)
{
  const std::string path = file_of(s, around);
  return std::make_shared<ClumpSolid>(read_clump(path, scale_of(s)), path);
}

SharedSolid read_mesh(const Section& s, const Surroundings& around)
{
  const std::string path = file_of(s, around);
  return std::make_shared<MeshSolid>(read_triangle_mesh(path, scale_of(s)), path);
}

struct SolidKind
{
  const char* name;
  Words keys;
  SharedSolid (*read)(const Section& section, const Surroundings& around);
};

/// A new kind: a reader above, and its entry in this list.
const std::vector<SolidKind>& solid_kinds()
{
  static const std::vector<SolidKind> kinds{{"sphere", {"radius"}, read_sphere},
                                            {"ellipsoid", {"axes"}, read_ellipsoid},
                                            {"superquadric", {"axes", "exponents"}, read_superquadric},
                                            {"box", {"sides", "edge_radius"}, read_box},
                                            {"polyhedron", {"corners", "edge_radius"}, read_polyhedron},
                                            {"clump", {"file", "scale"}, read_clump_solid},
                                            {"mesh", {"file", "scale"}, read_mesh}};
  return kinds;
}

}  // namespace

SharedSolid read_solid(const Section& s, const std::string& folder, double radius)
{
  const std::string name = s.text("kind");
  Words names;
  for (const SolidKind& kind : solid_kinds()) names.push_back(kind.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) fail_unknown(s.where(s.node("kind")), "no kind of shape", name, names);
  const SolidKind& kind = solid_kinds()[static_cast<std::size_t>(found - names.begin())];
  Words keys{"kind"};
  keys.insert(keys.end(), kind.keys.begin(), kind.keys.end());
  s.check_keys(keys);
  return kind.read(s, {folder, radius});
}

}  // namespace granulaw
