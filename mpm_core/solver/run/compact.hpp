#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "solver/output/checkpoint.hpp"
#include "solver/runs.hpp"

namespace granulaw {

/// Spheres in a box that begins at the origin; SI.
struct Packing
{
  struct Sphere
  {
    std::array<double, 3> centre;
    double radius;
    int material;  ///< index in the list of materials
  };
  std::vector<Sphere> spheres;
  std::array<double, 3> box;
};

/// The way in which a packing is pressed.
struct CompactPlan
{
  bool walls = false;  ///< a die of six walls whose lid comes down; else all sides of a periodic box close in
  double friction = 0;    ///< Coulomb's coefficient of all contacts
  double density = 0.95;  ///< the end: volume of the undeformed spheres over that of the box
  double rate = 0.002;    ///< dL/dt = -rate c*/R L; R the mean radius, c* the lowest of the materials
  double unload_to =
      -1;  ///< fraction of the largest stress (walls: of the lid) at which the unloading ends; < 0: none
  int cells = 6;  ///< of the grid, to a diameter
  int seed = 1;   ///< of the turns of the grids
};

/// Means over a window of density.
struct CompactRow
{
  bool unloading;
  double density;
  std::array<double, 3> stress;       ///< Pa, compression positive, from the contacts
  std::array<double, 3> wall_stress;  ///< Pa, means of both walls; 0 of a periodic box
  std::array<double, 6> wall_force;   ///< N, normal: -x +x -y +y -z +z; 0 of a periodic box
  double coordination;                ///< contacts of a sphere, walls included
  std::array<double, 3> box;          ///< m, at the end of the window
  /// J, at the end of the window. work: of the sides so far; the rest: what it became
  double work, kinetic, elastic, plastic, lost_in_contact;
};

/// A contact at the end of a window; means over it.
struct CompactContact
{
  double density;
  bool unloading;
  int sphere, other;          ///< other < 0: wall -1 - other
  std::array<int, 3> image;   ///< boxes by which `sphere` is moved to meet `other`
  double normal, tangential;  ///< N
  double distance, area;      ///< m, of the centres; m^2, undeformed
};

struct CompactResult
{
  std::vector<CompactRow> rows;
  std::vector<CompactContact> contacts;
  double largest_start_overlap = 0;  ///< over the smaller radius
  int start_overlaps = 0;            ///< contacts that overlapped at the start
  double energy_error = 0;           ///< largest |work - energies| over the largest work
  double largest_created = 0;        ///< most energy that contacts created, over the largest work
  double momentum = 0;  ///< of all spheres at the end, over mass times the sides' speed; periodic
  double cpu_s = 0;
  long steps = 0;
  int points = 0;  ///< material points of all spheres
};

/// Fraction of a sphere's radius up to which spheres of a packing may overlap at the start.
inline constexpr double most_start_overlap = 0.02;

/// Presses a packing of deformable spheres. `options`: courant, threads, precision, progress, checkpoints.
/// Throws Error. docs/theory/packings.md, docs/evidence/packings.md.
CompactResult compact(const Packing& packing, const std::vector<Material>& materials, const CompactPlan& plan,
                      const RunOptions& options = {});

}  // namespace granulaw
