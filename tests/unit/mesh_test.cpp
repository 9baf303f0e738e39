// Bodies inside triangle meshes: against the sphere and the box, and what is refused.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>

#include "refusal.hpp"
#include "shape_checks.hpp"
#include "solver/shape/shapes.hpp"

namespace granulaw::mesh_test {

using std::numbers::pi;

/// Corners of a cube of edge 2 about the origin, two triangles a side.
TriangleMesh cube()
{
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.vertices.push_back(Vector3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// Halves every edge and moves the vertices onto the ellipsoid.
TriangleMesh refined(const TriangleMesh& coarse, const Vector3& axes)
{
  TriangleMesh fine;
  fine.vertices = coarse.vertices;
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [entry, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<int>(fine.vertices.size()));
    if (is_new) fine.vertices.push_back(0.5 * (coarse.vertices[a] + coarse.vertices[b]));
    return entry->second;
  };
  for (const auto& [a, b, c] : coarse.triangles) {
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const std::array<int, 3>& t : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
      fine.triangles.push_back(t);
  }
  for (Vector3& v : fine.vertices) v /= v.cwiseQuotient(axes).norm();
  return fine;
}

TriangleMesh ellipsoid_mesh(const Vector3& axes, int refinements)
{
  TriangleMesh mesh = cube();
  for (Vector3& v : mesh.vertices) v = v.cwiseProduct(axes) / std::sqrt(3.0);
  for (int k = 0; k < refinements; ++k) mesh = refined(mesh, axes);
  return mesh;
}

std::string sentence_of(const TriangleMesh& mesh)
{
  return granulaw::sentence_of([&] { mesh_shape(mesh, "m.stl"); });
}

TEST(Mesh, CubeIsTheSharpBox)
{
  const SharedShape mesh = mesh_shape(cube(), "cube");
  const SharedShape box = box_shape({2, 2, 2}, 0);
  for (const Vector3& x : random_points(*box, 500)) EXPECT_NEAR(mesh->depth(x), box->depth(x), 1e-14);
  const MassProperties own = mesh->mass_properties(), other = box->mass_properties();
  EXPECT_NEAR(own.volume, other.volume, 1e-13);
  EXPECT_NEAR((own.inertia - other.inertia).norm(), 0, 1e-12);
  expect_lipschitz(*mesh);
}

TEST(Mesh, FulfilsWhatEveryShapeMust)
{
  const SharedShape mesh = mesh_shape(ellipsoid_mesh({1, 2, 3}, 3), "ellipsoid");
  expect_lipschitz(*mesh);
  expect_support(*mesh);
  expect_normals(*mesh);
}

TEST(Mesh, OfASphereIsTheSphereToTheMeshsAccuracy)
{
  // Edges of up to h = 0.06 R: chords lie h^2/6 below the surface, at the middle of a triangle.
  const SharedShape mesh = mesh_shape(ellipsoid_mesh({1, 1, 1}, 5), "sphere");
  for (const Vector3& x : random_points(*mesh, 500)) EXPECT_NEAR(mesh->depth(x), 1 - x.norm(), 8e-4);
  EXPECT_NEAR(mesh->mass_properties().volume / (4 * pi / 3), 1, 2e-3);
  EXPECT_NEAR(mesh->mass_properties().inertia(0, 0) / (4 * pi / 3 * 0.4), 1, 3e-3);
  EXPECT_NEAR(mesh->finest_radius(), 1, 0.02);  // of h^2 and of uneven triangles
}

TEST(Mesh, PrincipalRadiiOfAnEllipsoid)
{
  const Vector3 axes(1, 1.5, 2);
  const SharedShape mesh = mesh_shape(ellipsoid_mesh(axes, 5), "ellipsoid");
  const SharedShape ellipsoid = ellipsoid_shape(axes);
  for (const Vector3& n : random_directions(40)) {
    const PrincipalRadii own = mesh->principal_radii(n), other = ellipsoid->principal_radii(n);
    // The vertex that stands for a direction lies up to half an edge, 0.03, from its support point: the
    // normals differ by 0.03/0.5, and the radii change by up to three times the change of the normal, less
    // the patch's averaging.
    EXPECT_NEAR(own.sharper / other.sharper, 1, 0.1);
    EXPECT_NEAR(own.flatter / other.flatter, 1, 0.1);
  }
}

TEST(Mesh, RefusesWhatEnclosesNoBody)
{
  const auto sentence = [](const std::function<void(TriangleMesh&)>& change) {
    TriangleMesh mesh = cube();
    change(mesh);
    return sentence_of(mesh);
  };
  EXPECT_EQ(sentence([](TriangleMesh& m) { m.triangles.pop_back(); }),
            "m.stl: the mesh is not closed: an edge belongs to one triangle only: found the edge from (1, "
            "1, -1) m to "
            "(1, -1, 1) m, allowed is two triangles at every edge");
  EXPECT_EQ(sentence([](TriangleMesh& m) { std::swap(m.triangles[3][0], m.triangles[3][1]); }),
            "m.stl: two neighbouring triangles of the mesh are wound in opposite senses: found the edge from "
            "(1, -1, 1) "
            "m to (-1, 1, 1) m, allowed is corners counter-clockwise seen from outside");
  EXPECT_EQ(sentence([](TriangleMesh& m) {
              for (auto& t : m.triangles) std::swap(t[0], t[1]);
            }),
            "m.stl: the mesh is inside out: its triangles are wound clockwise seen from outside: found a "
            "volume of -8 "
            "m^3, allowed is corners counter-clockwise seen from outside");
  EXPECT_EQ(sentence([](TriangleMesh& m) {
              m.triangles.push_back({0, 1, 7});
            }),
            "m.stl: the mesh encloses no body: an edge belongs to more than two triangles: found 3 at the "
            "edge from "
            "(-1, -1, -1) m to (1, -1, -1) m, allowed is two triangles at every edge");
  EXPECT_EQ(
      sentence([](TriangleMesh& m) {
        for (const Vector3& v : cube().vertices) m.vertices.push_back(v + Vector3(5, 0, 0));
        for (const auto& t : cube().triangles) m.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
      }),
      "m.stl: the mesh has several surfaces that do not hang together: found a second one at (4, -1, -1) m, "
      "allowed is one closed surface");
  EXPECT_EQ(sentence([](TriangleMesh& m) { m.triangles.resize(2); }),
            "m.stl: the mesh encloses no body: found 2 triangles, allowed is 4 or more");
}

TEST(Mesh, ReadsStlAsTextAndBinary)
{
  const TriangleMesh mesh = cube();
  const std::string path = testing::TempDir() + "granulaw_mesh_solid_test.stl";
  {
    std::ofstream out(path);
    out << "shape cube\n";
    for (const auto& t : mesh.triangles) {
      out << "facet normal 0 0 0\nouter loop\n";
      for (const int v : t) out << "vertex " << mesh.vertices[v].transpose() << "\n";
      out << "endloop\nendfacet\n";
    }
    out << "endsolid cube\n";
  }
  const TriangleMesh text = read_triangle_mesh(path, 1e-3);
  {
    std::ofstream out(path, std::ios::binary);
    out << std::string(80, ' ');
    const std::uint32_t count = 12;
    out.write(reinterpret_cast<const char*>(&count), 4);
    for (const auto& t : mesh.triangles) {
      float numbers[12] = {};
      for (int k = 0; k < 9; ++k) numbers[3 + k] = static_cast<float>(mesh.vertices[t[k / 3]][k % 3]);
      out.write(reinterpret_cast<const char*>(numbers), sizeof numbers);
      out.write("\0\0", 2);
    }
  }
  const TriangleMesh binary = read_triangle_mesh(path, 1e-3);
  std::filesystem::remove(path);
  for (const TriangleMesh& read : {text, binary}) {
    EXPECT_EQ(read.vertices.size(), 8u);
    EXPECT_EQ(read.triangles.size(), 12u);
    EXPECT_NEAR(mesh_shape(read, "cube")->mass_properties().volume, 8e-9, 1e-22);
  }
}

TEST(Polyhedron, OfABoxsCornersIsTheBox)
{
  std::vector<Vector3> corners{{0, 0, 0}, {0.1, 0.2, -0.3}, {0.5, 0, 1}};  // inside, and on a face
  for (const Vector3& v : cube().vertices) corners.push_back(v.cwiseProduct(Vector3(0.5, 0.75, 1)));
  const SharedShape polyhedron = polyhedron_shape(corners, 0.25, "polyhedron");
  const SharedShape box = box_shape({1.5, 2, 2.5}, 0.25);
  for (const Vector3& x : random_points(*box, 300)) EXPECT_NEAR(polyhedron->depth(x), box->depth(x), 1e-14);
  expect_support(*polyhedron);
  expect_normals(*polyhedron);
  const MassProperties own = polyhedron->mass_properties(), other = box->mass_properties();
  EXPECT_NEAR(own.volume / other.volume, 1, 1e-4);  // its mesh of directions
  EXPECT_NEAR((own.inertia - other.inertia).norm() / other.inertia.norm(), 0, 2e-4);
  for (const Vector3& n : {Vector3(1, 0, 0), Vector3(0.6, 0.8, 0), Vector3(1, 2, 2)}) {
    EXPECT_EQ(polyhedron->principal_radii(n.normalized()).sharper,
              box->principal_radii(n.normalized()).sharper);
    EXPECT_EQ(polyhedron->principal_radii(n.normalized()).flatter,
              box->principal_radii(n.normalized()).flatter);
  }
}

}  // namespace granulaw::mesh_test
