#pragma once

#include <array>

#include "solver/body/kernels.hpp"

namespace granulaw {

// Contact of markers with planes and with other bodies, as the kernels take it: plain data and raw pointers.

/// Fields of a body's nodes.
struct RowNodes
{
  const double* u;
  double* v;
  const double* f;
  const double* inverse_mass;
  int apart;  ///< entries from a node's r to its z; three dimensions: the entries x, y, z and a zero are one
              ///< access
};

/// Nodes that carry a marker: entry `lowest + offset[k]` with weight[k].
struct Stencil
{
  int body, corners;
  int lowest;
  const int* offset;
  const double* weight;
};

/// One marker that may touch a plane or another body.
struct alignas(32) ContactRow
{
  double normal[4];         ///< of the other side, away from it
  double along[4];          ///< normal over its square: its product with an impulse is that along the normal
  double before[4];         ///< velocity of separation at the start of the step
  double of_other[4];       ///< signs with which the other body's velocity counts in the first one's frame
  double drift[4];          ///< added to the velocity of separation: of a periodic image
  Stencil near, far;        ///< far: of the other body; no corners: the other side is rigid
  double* impulse;          ///< [4], of the last step, then of this one
  double needed;            ///< velocity along the normal, at least
  double response;          ///< normal velocity gained per unit of impulse
  double tangent_response;  ///< the same of a tangential one, at most
  double speed;             ///< of a rigid side along the normal
  double friction;
  int marker, plane;
};

/// A plane against the markers that might reach it soon; three dimensions.
struct RowPlane
{
  alignas(32) double normal[4];
  double position, velocity, friction;
  int plane;
  const std::array<double, 3>* place;  ///< of every marker on the reference surface
  const int* node;                     ///< lowest node
  const int* offset;                   ///< entries from it to each of its nodes, the same for all
  const double* weight;                ///< [marker][node]
  double* impulse;                     ///< [marker][4]
};

/// One spline of a cell is a polynomial of xi = (x - middle) per_edge: n[spline][power].
struct CellPolynomials
{
  double middle, per_edge, n[3][3];
};

/// The reference grid of a sphere about its origin, as the inverse of its motion reads it; three dimensions.
struct SphereGrid
{
  struct Axis
  {
    double low, per_bucket;  ///< equal buckets over the lines of the axis
    int buckets, cells;
    const int* first;  ///< the first cell that overlaps a bucket
    const double* lines;
    const CellPolynomials* cell;
  };
  /// The cell whose polynomials hold: itself, or the nearest with a part of the body.
  struct Holder
  {
    int cell[3], lowest;  ///< lowest: entry of its lowest node
  };
  Axis axis[3];
  const Holder* holder;    ///< [z][y][x]
  int stride[3];           ///< entries between nodes along each axis
  int offset[cell_nodes];  ///< entries from a cell's lowest node to each of its nodes
  double radius;
};

/// A marker of one body near the surface of another.
struct alignas(32) FacingMarker
{
  double impulse[4];  ///< of the last step
  double image[4];    ///< where it lies in the other body's reference
  double normal[4];   ///< of the other body there, in the marker's frame; 0: not yet known
  int marker;
  int sleep;   ///< steps until it is looked at again
  int pushed;  ///< it was pushed since this was set to 0
};

/// The surface of a body as the markers of another meet it. `place`, `node`, `weight`: as in RowPlane.
struct FacingSurface
{
  /// A place x of the near body is signs (x + shift) for the far one; drift: rate of the shift.
  alignas(32) double signs[4], shift[4], drift[4];
  int near_body, far_body;
  const SphereGrid *near, *far;
  const std::array<double, 3>* place;
  const int* node;
  const double* weight;
  double friction;
  double open;     ///< gaps up to this make rows
  double closing;  ///< speed at which a gap closes, at most, about
};

/// The kernels of rows for one instruction set and one layout of the nodes' fields.
struct RowKernels
{
  /// Sum of weight times field over a marker's nodes.
  void (*carry)(const RowNodes& nodes, const double* field, const Stencil& marker, double* sum);

  /// Velocity of separation.
  void (*velocity)(const RowNodes* bodies, const ContactRow& row, double* sum);

  /// Fills the row's responses and, from its velocity, `before`.
  void (*weigh)(const RowNodes* bodies, double kick, ContactRow& row);

  /// Rows of the candidates that would pass the plane in a step `dt`, or might once their neighbours are
  /// pushed back; how many. `recovery`: share of its way that a marker behind the plane comes back in a step.
  int (*make)(const RowNodes* bodies, const RowPlane& plane, const int* candidates, int count, double kick,
              double dt, double recovery, ContactRow* rows);

  /// Rows of markers against the surface of another deformable sphere, with room for cell_nodes weights
  /// each; how many. One step of Newton's from the image of the last step finds the new one. A marker that
  /// loses its image keeps the plane that it had.
  int (*face)(const RowNodes* bodies, const FacingSurface& surface, FacingMarker* markers, int count,
              double kick, double dt, double recovery, ContactRow* rows, double* far_weights);

  /// Newton's steps from `image` for the place [4] of the reference that has moved to `place` [4]; they end
  /// where it is found, or where the gap is beyond `most`. False: it cannot be found. `left`: the last step's
  /// distance, before it.
  bool (*invert)(const RowNodes& body, const SphereGrid& grid, const double* place, int steps, double most,
                 double* image, double* normal, double* gap, double* left);

  /// Adds impulses to the velocities of one side of rows: those of the rows less `known` ([row][4], or none).
  void (*push)(const RowNodes& nodes, const ContactRow* rows, int count, bool far, const double* known);

  /// Adds the impulses of the last step to the velocities.
  void (*start)(const RowNodes* bodies, const ContactRow* rows, int count);

  /// One Gauss-Seidel sweep; the largest change of an impulse over the largest impulse, 1 if all became 0.
  double (*sweep)(const RowNodes* bodies, ContactRow* rows, int count);

  /// Largest magnitude of an entry.
  double (*largest)(const double* values, int count);
};

/// Kernels of the instruction set that runs, for the bodies of a scene.
const RowKernels& row_kernels(bool three_dimensions);
inline const RowKernels& row_kernels(const Body& body)
{
  return row_kernels(body.reference().is_spatial());
}

namespace isa_generic {
extern const RowKernels corner_rows, cell_rows;
}
namespace isa_avx2 {
extern const RowKernels corner_rows, cell_rows;
}
namespace isa_avx512 {
extern const RowKernels corner_rows, cell_rows;
}

}  // namespace granulaw
