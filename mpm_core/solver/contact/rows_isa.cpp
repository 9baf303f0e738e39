// Compiled once for each instruction set, as body/axisymmetric_isa.cpp, under the same rules. A node's four entries are
// the lanes of a vector.
#include "solver/contact/rows.hpp"
#include "solver/material/parameter.hpp"

namespace granulaw::GRANULAW_ISA_NAMESPACE {

namespace {

typedef double Four __attribute__((vector_size(32), may_alias));

constexpr int stencil = 27;

GRANULAW_INLINE const Four& four(const double* values)
{
  return *reinterpret_cast<const Four*>(values);
}
GRANULAW_INLINE Four& four(double* values)
{
  return *reinterpret_cast<Four*>(values);
}
GRANULAW_INLINE double dot(Four a, Four b)
{
  const Four c = a * b;
  return (c[0] + c[1]) + (c[2] + c[3]);
}
GRANULAW_INLINE Four magnitude(Four a)
{
  return a < 0.0 ? -a : a;
}
GRANULAW_INLINE double largest_of(Four a)
{
  const double low = a[0] > a[1] ? a[0] : a[1], high = a[2] > a[3] ? a[2] : a[3];
  return low > high ? low : high;
}
GRANULAW_INLINE double square_root(double x)
{
  return __builtin_sqrt(x);
}

/// Three sums side by side: the next product does not wait for the last.
GRANULAW_INLINE Four carried(const double* field, const int* __restrict offset,
                             const double* __restrict weight)
{
  Four a{}, b{}, c{};
#pragma GCC unroll 9
  for (int k = 0; k < stencil; k += 3) {
    a += weight[k] * four(field + offset[k]);
    b += weight[k + 1] * four(field + offset[k + 1]);
    c += weight[k + 2] * four(field + offset[k + 2]);
  }
  return (a + b) + c;
}

GRANULAW_INLINE void push(const RowNodes& nodes, const ContactRow& row, Four impulse)
{
  double* v = nodes.v + row.node;
  const double* inverse_mass = nodes.inverse_mass + row.node;
#pragma GCC unroll 9
  for (int k = 0; k < stencil; ++k) {
    const int at = nodes.offset[k];
    four(v + at) += row.weight[k] * four(inverse_mass + at) * impulse;
  }
}

void carry(const double* field, const int* offset, const double* weight, double* sum)
{
  const Four found = carried(field, offset, weight);
  for (int c = 0; c < 4; ++c) sum[c] = found[c];
}

/// Response and velocity at the start of the step.
GRANULAW_INLINE void weigh(const RowNodes& nodes, double kick, ContactRow& row)
{
  Four response{}, kicked{};
  for (int k = 0; k < stencil; ++k) {
    const int at = row.node + nodes.offset[k];
    const double w = row.weight[k];
    const Four inverse_mass = four(nodes.inverse_mass + at);
    response += w * w * inverse_mass;
    kicked += w * inverse_mass * four(nodes.f + at);
  }
  const Four normal = four(row.normal);
  row.response = dot(normal * normal, response);
  row.tangent_response = largest_of(response);
  four(row.before) = four(row.before) - kick * kicked;
}

int make(const RowNodes& nodes, const RowPlane& plane, const int* candidates, int count, double kick,
         double dt, double recovery, ContactRow* rows)
{
  const Four normal = four(plane.normal);
  int made = 0;
  for (int n = 0; n < count; ++n) {
    const int m = candidates[n], node = 4 * plane.node[m];
    const double* weight = plane.weight + long(stencil) * m;
    double* impulse = plane.impulse + 4L * m;
    const Four start{plane.place[m][0], plane.place[m][1], plane.place[m][2], 0.0};
    const Four velocity = carried(nodes.v + node, nodes.offset, weight);
    const double gap = dot(normal, start + carried(nodes.u + node, nodes.offset, weight)) - plane.position;
    const double approach = dot(normal, velocity) - plane.velocity;
    const double fast = approach < 0.0 ? -approach : approach;
    const bool pushed = largest_of(magnitude(four(impulse))) > 0.0;
    if (gap + dt * approach > 0 && !pushed && gap > 4 * dt * fast) continue;
    ContactRow& row = rows[made];
    four(row.normal) = normal, four(row.before) = velocity;
    row.weight = weight, row.impulse = impulse;
    row.needed = plane.velocity - (gap < 0 ? recovery : 1) * gap / dt;
    row.speed = plane.velocity, row.friction = plane.friction;
    row.marker = m, row.plane = plane.plane, row.node = node;
    weigh(nodes, kick, row);
    made += row.response > 0 ? 1 : 0;
  }
  return made;
}

void start(const RowNodes& nodes, const ContactRow* rows, int count)
{
  for (int n = 0; n < count; ++n)
    if (largest_of(magnitude(four(rows[n].impulse))) > 0.0) push(nodes, rows[n], four(rows[n].impulse));
}

/// The tangential impulse that stops the sliding, or the friction's most against it.
GRANULAW_INLINE Four tangential_impulse(const ContactRow& row, Four v, Four p, double normal_velocity,
                                        double normal_impulse, double wanted)
{
  const Four normal = four(row.normal);
  const Four sliding = v - normal_velocity * normal;
  const Four tangential = p - normal_impulse * normal - sliding / row.tangent_response;
  const double most = row.friction * wanted, size = square_root(dot(tangential, tangential));
  return size > most ? most / size * tangential : tangential;
}

double sweep(const RowNodes& nodes, ContactRow* rows, int count)
{
  double change = 0, largest = 0;
  for (int n = 0; n < count; ++n) {
    const ContactRow& row = rows[n];
    const Four normal = four(row.normal), v = carried(nodes.v + row.node, nodes.offset, row.weight);
    const Four p = four(row.impulse);
    const double normal_velocity = dot(normal, v), normal_impulse = dot(normal, p);
    const double free = normal_impulse + (row.needed - normal_velocity) / row.response;
    const double wanted = free > 0.0 ? free : 0.0;
    Four next = wanted * normal;
    if (row.friction > 0.0 && wanted > 0.0)
      next += tangential_impulse(row, v, p, normal_velocity, normal_impulse, wanted);
    const Four step = next - p;
    const double moved = largest_of(magnitude(step));
    if (moved > 0.0) push(nodes, row, step);
    four(row.impulse) = next;
    change = moved > change ? moved : change;
    largest = wanted > largest ? wanted : largest;
  }
  return largest > 0.0 ? change / largest : 0.0;
}

double largest(const double* values, int count)
{
  double most = 0;
#pragma omp simd reduction(max : most)
  for (int k = 0; k < count; ++k) {
    const double size = values[k] < 0.0 ? -values[k] : values[k];
    most = size > most ? size : most;
  }
  return most;
}

}  // namespace

extern const RowKernels row_kernels{carry, make, start, sweep, largest};

}  // namespace granulaw::GRANULAW_ISA_NAMESPACE
