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

  /// Adds the impulses of the last step to the velocities.
  void (*start)(const RowNodes* bodies, const ContactRow* rows, int count);

  /// One Gauss-Seidel sweep; the largest change of an impulse over the largest impulse, 1 if all became 0.
  double (*sweep)(const RowNodes* bodies, ContactRow* rows, int count);

  /// Largest magnitude of an entry.
  double (*largest)(const double* values, int count);
};

/// Kernels of the instruction set that runs, for the bodies of a scene.
const RowKernels& row_kernels(const Body& body);

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
