#pragma once

#include <array>

namespace granulaw {

// Contact of markers with planes, as the kernels take it: plain data and raw pointers. A marker hangs on the
// nodes of one cell; a node's entries are x, y, z and a zero.

/// Fields of the nodes, and the entries from the lowest node of a cell to each of its nodes.
struct RowNodes
{
  const double* u;
  double* v;
  const double* f;
  const double* inverse_mass;
  const int* offset;
};

/// One marker that may touch one plane.
struct alignas(32) ContactRow
{
  double normal[4];  ///< of the plane, away from it
  double before[4];  ///< velocity at the start of the step
  const double* weight;
  double* impulse;          ///< of the last step, then of this one
  double needed;            ///< velocity along the normal, at least
  double response;          ///< normal velocity gained per unit of impulse
  double tangent_response;  ///< the same of a tangential one, at most
  double speed;             ///< of the plane along its normal
  double friction;
  int marker, plane;
  int node;  ///< entry of the lowest of its nodes
};

/// A plane against the markers that might reach it soon.
struct RowPlane
{
  alignas(32) double normal[4];
  double position, velocity, friction;
  int plane;
  const std::array<double, 3>* place;  ///< of every marker on the reference surface
  const int* node;                     ///< lowest node
  const double* weight;                ///< [marker][node]
  double* impulse;                     ///< [marker][4]
};

/// The kernels of rows for one instruction set.
struct RowKernels
{
  /// Sum of weight times field over a marker's nodes.
  void (*carry)(const double* field, const int* offset, const double* weight, double* sum);

  /// Rows of the candidates that would pass the plane in a step `dt`, or might once their neighbours are
  /// pushed back; how many. `recovery`: share of its way that a marker behind the plane comes back in a step.
  int (*make)(const RowNodes& nodes, const RowPlane& plane, const int* candidates, int count, double kick,
              double dt, double recovery, ContactRow* rows);

  /// Adds the impulses of the last step to the velocities.
  void (*start)(const RowNodes& nodes, const ContactRow* rows, int count);

  /// One Gauss-Seidel sweep; the largest change of an impulse over the largest impulse.
  double (*sweep)(const RowNodes& nodes, ContactRow* rows, int count);

  /// Largest magnitude of an entry.
  double (*largest)(const double* values, int count);
};

const RowKernels& row_kernels();

namespace isa_generic {
extern const RowKernels row_kernels;
}
namespace isa_avx2 {
extern const RowKernels row_kernels;
}
namespace isa_avx512 {
extern const RowKernels row_kernels;
}

}  // namespace granulaw
