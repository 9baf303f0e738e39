#include "liggghts_plugin/confine/wall_planes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>

#include "contact/vector.hpp"
#include "liggghts_plugin/engine/gather.hpp"

namespace granulaw::plugin {

namespace {

constexpr double tolerance = 1e-6;  // of normals, and of distances over the mesh's size: LIGGGHTS's single-precision STL files
constexpr int planes_a_wall = 1 << 20;

struct Triangle
{
  int number;
  Vector normal;
  double offset;  // of its plane from the origin, over the mesh's size
};

/// FNV-1a: the same on every machine.
std::uint32_t hash(std::string_view text)
{
  std::uint32_t h = 2166136261u;
  for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 16777619u;
  return h;
}

/// The triangles of all ranks, by their numbers.
std::vector<Triangle> all_triangles(LAMMPS_NS::TriMesh& mesh, MPI_Comm world)
{
  constexpr int numbers = 7;  // number, normal, a corner
  std::vector<double> own;
  for (int t = 0; t < mesh.sizeLocal(); ++t) {
    double normal[3], corner[3];
    mesh.surfaceNorm(t, normal), mesh.node_slow(t, 0, corner);
    own.insert(own.end(), {static_cast<double>(mesh.id(t)), normal[0], normal[1], normal[2], corner[0], corner[1], corner[2]});
  }
  const std::vector<double> all = gather(own, world);
  std::vector<Triangle> found;
  double size = 0;
  for (std::size_t k = 0; k < all.size(); k += numbers) {
    const Vector normal{all[k + 1], all[k + 2], all[k + 3]}, corner{all[k + 4], all[k + 5], all[k + 6]};
    found.push_back({static_cast<int>(all[k]), normal, dot(normal, corner)});
    size = std::max(size, norm(corner));
  }
  for (Triangle& t : found) t.offset /= std::max(size, 1e-300);
  std::ranges::sort(found, {}, &Triangle::number);
  return found;
}

/// Planes found so far, in cells of normal and offset. A side of a cell is longer than the tolerance, so that a plane that agrees
/// lies in the same cell or in one beside it.
class Planes
{
 public:
  int place(const Triangle& t)
  {
    for (const double sign : {1.0, -1.0})  // triangles that face each other lie in one plane
      if (const int found = find({t.number, times(t.normal, sign), sign * t.offset}); found >= 0) return found;
    cells_[cell(t)].push_back({t, count_});
    return count_++;
  }

 private:
  using Cell = std::array<int, 4>;
  static Cell cell(const Triangle& t)
  {
    constexpr double side = 16 * tolerance;
    const auto place = [](double x) { return static_cast<int>(std::floor(x / side)); };
    return {place(t.normal[0]), place(t.normal[1]), place(t.normal[2]), place(t.offset)};
  }
  int find(const Triangle& t) const
  {
    const Cell at = cell(t);
    for (int k = 0; k < 81; ++k) {
      const auto found = cells_.find({at[0] + k % 3 - 1, at[1] + k / 3 % 3 - 1, at[2] + k / 9 % 3 - 1, at[3] + k / 27 - 1});
      if (found == cells_.end()) continue;
      for (const auto& [other, number] : found->second)
        if (norm(sum(t.normal, other.normal, -1.0)) < tolerance && std::abs(t.offset - other.offset) < tolerance) return number;
    }
    return -1;
  }
  std::map<Cell, std::vector<std::pair<Triangle, int>>> cells_;
  int count_ = 0;
};

}  // namespace

WallPlanes::WallPlanes(FixWallGran& wall, MPI_Comm world) : first_(-1 - static_cast<Key>(hash(wall.id)) * planes_a_wall)
{
  if (!wall.is_mesh_wall()) return;
  int before = 0;
  for (int m = 0; m < wall.n_meshes(); ++m) {
    auto& numbers = plane_.emplace_back();
    Planes of_mesh;
    int last = -1;
    for (const Triangle& t : all_triangles(*wall.mesh_list()[m]->triMesh(), world)) {
      const int plane = of_mesh.place(t);
      numbers[t.number] = before + plane;
      last = std::max(last, plane);
    }
    before += last + 1;
  }
}

WallPlanes::Key WallPlanes::key(int mesh, int triangle) const
{
  return triangle < 0 ? first_ : first_ - plane_[static_cast<std::size_t>(mesh)].at(triangle) % planes_a_wall;
}

}  // namespace granulaw::plugin
