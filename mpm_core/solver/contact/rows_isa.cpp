// Compiled once for each instruction set, as body/axisymmetric_isa.cpp, under the same rules. A vector in
// space has four lanes: x, y, z and a zero; of revolution r is along x.
#include "solver/contact/rows.hpp"
#include "solver/material/parameter.hpp"

namespace granulaw::GRANULAW_ISA_NAMESPACE {

namespace {

typedef double Four __attribute__((vector_size(32), may_alias));

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

/// Layout of the nodes' fields in three dimensions: a node is one access. Three sums side by side: the next
/// product does not wait for the last. The first body's markers have as many nodes as a cell, which the
/// compiler knows; those of the second a multiple of three.
struct InCells
{
  GRANULAW_INLINE Four carried(const RowNodes&, const double* field, const Stencil& marker, int corners)
  {
    const double* from = field + marker.lowest;
    const int* __restrict offset = marker.offset;
    const double* __restrict weight = marker.weight;
    Four a{}, b{}, c{};
#pragma GCC unroll 9
    for (int k = 0; k < corners; k += 3) {
      a += weight[k] * four(from + offset[k]);
      b += weight[k + 1] * four(from + offset[k + 1]);
      c += weight[k + 2] * four(from + offset[k + 2]);
    }
    return (a + b) + c;
  }
  GRANULAW_INLINE void push(const RowNodes& nodes, const Stencil& marker, int corners, Four impulse)
  {
    double* v = nodes.v + marker.lowest;
    const double* inverse_mass = nodes.inverse_mass + marker.lowest;
#pragma GCC unroll 9
    for (int k = 0; k < corners; ++k) {
      const int at = marker.offset[k];
      four(v + at) += marker.weight[k] * four(inverse_mass + at) * impulse;
    }
  }
  GRANULAW_INLINE int corners(const Stencil&)
  {
    return cell_nodes;
  }
  GRANULAW_INLINE Four at(const RowNodes&, const double* field, int entry)
  {
    return four(field + entry);
  }
};

/// Layout of a body of revolution: all r, then all z.
struct InCorners
{
  GRANULAW_INLINE Four at(const RowNodes& nodes, const double* field, int entry)
  {
    return Four{field[entry], 0.0, field[entry + nodes.apart], 0.0};
  }
  GRANULAW_INLINE int corners(const Stencil& marker) { return marker.corners; }
  GRANULAW_INLINE Four carried(const RowNodes& nodes, const double* field, const Stencil& marker, int corners)
  {
    double r = 0, z = 0;
    for (int k = 0; k < corners; ++k) {
      const double* x = field + marker.lowest + marker.offset[k];
      r += marker.weight[k] * x[0], z += marker.weight[k] * x[nodes.apart];
    }
    return Four{r, 0.0, z, 0.0};
  }
  GRANULAW_INLINE void push(const RowNodes& nodes, const Stencil& marker, int corners, Four impulse)
  {
    const double r = impulse[0], z = impulse[2];
    for (int k = 0; k < corners; ++k) {
      const int entry = marker.lowest + marker.offset[k];
      const double* per_mass = nodes.inverse_mass + entry;
      nodes.v[entry] += marker.weight[k] * per_mass[0] * r;
      nodes.v[entry + nodes.apart] += marker.weight[k] * per_mass[nodes.apart] * z;
    }
  }
};

template <class Layout>
GRANULAW_INLINE Four velocity_of(const RowNodes* bodies, const ContactRow& row)
{
  const RowNodes& near = bodies[row.near.body];
  Four v = Layout::carried(near, near.v, row.near, Layout::corners(row.near));
  if (row.far.corners > 0) {
    const RowNodes& far = bodies[row.far.body];
    v += four(row.of_other) * Layout::carried(far, far.v, row.far, row.far.corners);
    v += four(row.drift);
  }
  return v;
}

template <class Layout>
GRANULAW_INLINE void push(const RowNodes* bodies, const ContactRow& row, Four impulse)
{
  Layout::push(bodies[row.near.body], row.near, Layout::corners(row.near), impulse);
  if (row.far.corners > 0)
    Layout::push(bodies[row.far.body], row.far, row.far.corners, four(row.of_other) * impulse);
}

template <class Layout>
void carry(const RowNodes& nodes, const double* field, const Stencil& marker, double* sum)
{
  const Four found = Layout::carried(nodes, field, marker, Layout::corners(marker));
  for (int c = 0; c < 4; ++c) sum[c] = found[c];
}

template <class Layout>
void velocity(const RowNodes* bodies, const ContactRow& row, double* sum)
{
  const Four found = velocity_of<Layout>(bodies, row);
  for (int c = 0; c < 4; ++c) sum[c] = found[c];
}

/// Adds one body's share to the response, and its velocity of the last kick.
template <class Layout>
GRANULAW_INLINE void weigh_one(const RowNodes& nodes, const Stencil& marker, int corners, Four& response,
                               Four& kicked)
{
  for (int k = 0; k < corners; ++k) {
    const int at = marker.lowest + marker.offset[k];
    const double w = marker.weight[k];
    const Four inverse_mass = Layout::at(nodes, nodes.inverse_mass, at);
    response += w * w * inverse_mass;
    kicked += w * inverse_mass * Layout::at(nodes, nodes.f, at);
  }
}

template <class Layout>
GRANULAW_INLINE void weigh_row(const RowNodes* bodies, double kick, Four velocity_now, ContactRow& row)
{
  Four response{}, kicked{};
  weigh_one<Layout>(bodies[row.near.body], row.near, Layout::corners(row.near), response, kicked);
  if (row.far.corners > 0) {
    Four of_far{};
    weigh_one<Layout>(bodies[row.far.body], row.far, row.far.corners, response, of_far);
    kicked += four(row.of_other) * of_far;
  }
  const Four normal = four(row.normal);
  row.response = dot(normal * normal, response);
  row.tangent_response = largest_of(response);
  four(row.before) = velocity_now - kick * kicked;
}

template <class Layout>
void weigh(const RowNodes* bodies, double kick, ContactRow& row)
{
  weigh_row<Layout>(bodies, kick, velocity_of<Layout>(bodies, row), row);
}

template <class Layout>
int make(const RowNodes* bodies, const RowPlane& plane, const int* candidates, int count, double kick,
         double dt, double recovery, ContactRow* rows)
{
  const RowNodes& nodes = bodies[0];
  const Four normal = four(plane.normal);
  int made = 0;
  for (int n = 0; n < count; ++n) {
    const int m = candidates[n];
    const Stencil marker{0, cell_nodes, 4 * plane.node[m], plane.offset, plane.weight + long(cell_nodes) * m};
    double* impulse = plane.impulse + 4L * m;
    const Four start{plane.place[m][0], plane.place[m][1], plane.place[m][2], 0.0};
    const Four velocity = Layout::carried(nodes, nodes.v, marker, cell_nodes);
    const double gap =
        dot(normal, start + Layout::carried(nodes, nodes.u, marker, cell_nodes)) - plane.position;
    const double approach = dot(normal, velocity) - plane.velocity;
    const double fast = approach < 0.0 ? -approach : approach;
    const bool pushed = largest_of(magnitude(four(impulse))) > 0.0;
    if (gap + dt * approach > 0 && !pushed && gap > 4 * dt * fast) continue;
    ContactRow& row = rows[made];
    four(row.normal) = normal, four(row.along) = normal;
    row.near = marker, row.far.corners = 0, row.impulse = impulse;
    row.needed = plane.velocity - (gap < 0 ? recovery : 1) * gap / dt;
    row.speed = plane.velocity, row.friction = plane.friction;
    row.marker = m, row.plane = plane.plane;
    weigh_row<Layout>(bodies, kick, velocity, row);
    made += row.response > 0 ? 1 : 0;
  }
  return made;
}

// The inverse of a sphere's motion x(X) = X + sum N_k(X) u_k. Beyond the surface it goes on linearly: the
// splines' own continuation folds in small cut cells.

/// Images deeper or further out than these, over the radius, are none.
constexpr double deepest_image = 0.3, farthest_image = 1.35;

GRANULAW_INLINE double length_of(Four a)
{
  return square_root(dot(a, a));
}
GRANULAW_INLINE Four cross(Four a, Four b)
{
  return Four{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0], 0.0};
}

/// The splines that are not 0 at a place, and their slopes.
struct SplinesAt
{
  double n[3][3], dn[3][3];
  int lowest;
};

GRANULAW_INLINE void find_splines(const SphereGrid& grid, Four X, SplinesAt& s)
{
  const double length = length_of(X), most = 0.999 * grid.radius, scale = length > most ? most / length : 1.0;
  int at[3];
#pragma GCC unroll 3
  for (int d = 0; d < 3; ++d) {
    const SphereGrid::Axis& axis = grid.axis[d];
    const double x = scale * X[d];
    int bucket = static_cast<int>((x - axis.low) * axis.per_bucket);
    bucket = bucket < 0 ? 0 : (bucket < axis.buckets ? bucket : axis.buckets - 1);
    int cell = axis.first[bucket];
    while (cell + 1 < axis.cells && x >= axis.lines[cell + 1]) ++cell;
    at[d] = cell;
  }
  const SphereGrid::Holder& holder =
      grid.holder[(at[2] * grid.axis[1].cells + at[1]) * grid.axis[0].cells + at[0]];
  s.lowest = holder.lowest;
#pragma GCC unroll 3
  for (int d = 0; d < 3; ++d) {
    const CellPolynomials& cell = grid.axis[d].cell[holder.cell[d]];
    const double xi = (X[d] - cell.middle) * cell.per_edge;
#pragma GCC unroll 3
    for (int a = 0; a < 3; ++a) {
      s.n[d][a] = cell.n[a][0] + xi * (cell.n[a][1] + xi * cell.n[a][2]);
      s.dn[d][a] = (cell.n[a][1] + 2 * xi * cell.n[a][2]) * cell.per_edge;
    }
  }
}

/// Where a reference place has moved to, and the columns of F there.
GRANULAW_INLINE void motion(const SphereGrid& grid, const double* u, Four X, Four& x, Four (&F)[3])
{
  const double length = length_of(X);
  const Four on = length > grid.radius ? grid.radius / length * X : X;
  SplinesAt s;
  find_splines(grid, on, s);
  Four moved{}, gx{}, gy{}, gz{};
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k)
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) {
      const double* from = u + s.lowest + j * grid.stride[1] + k * grid.stride[2];
      const Four a = four(from), b = four(from + 4), c = four(from + 8);
      const Four line = s.n[0][0] * a + s.n[0][1] * b + s.n[0][2] * c;
      const Four slope = s.dn[0][0] * a + s.dn[0][1] * b + s.dn[0][2] * c;
      const double across = s.n[1][j] * s.n[2][k];
      moved += across * line, gx += across * slope;
      gy += s.dn[1][j] * s.n[2][k] * line, gz += s.n[1][j] * s.dn[2][k] * line;
    }
  x = on + moved;
  F[0] = Four{1, 0, 0, 0} + gx, F[1] = Four{0, 1, 0, 0} + gy, F[2] = Four{0, 0, 1, 0} + gz;
  if (length > grid.radius) {
    const Four beyond = X - on;
    x += beyond[0] * F[0] + beyond[1] * F[1] + beyond[2] * F[2];
  }
}

/// One of Newton's steps. `normal`: of the surface that has moved, of length 1.
GRANULAW_INLINE bool newton_step(const SphereGrid& grid, const double* u, Four place, Four& X, Four& normal,
                                 double& gap, double& left)
{
  Four x, F[3];
  motion(grid, u, X, x, F);
  const Four rows[3] = {cross(F[1], F[2]), cross(F[2], F[0]), cross(F[0], F[1])};  // of F^-1, times det F
  const double det = dot(F[0], rows[0]);
  if (!(det > 1e-6)) return false;
  const Four error = place - x;
  Four step{dot(rows[0], error) / det, dot(rows[1], error) / det, dot(rows[2], error) / det, 0.0};
  left = length_of(error);
  const double size = length_of(step), most = 0.5 * grid.radius;
  if (size > most) step *= most / size;
  X += step;
  const double length = length_of(X);
  const Four slope = (X[0] * rows[0] + X[1] * rows[1] + X[2] * rows[2]) / (det * length);  // F^-T N
  const double steepness = length_of(slope);
  normal = slope / steepness;
  gap = (length - grid.radius) / steepness;
  return length > deepest_image * grid.radius && length < farthest_image * grid.radius;
}

bool invert(const RowNodes& body, const SphereGrid& grid, const double* place, int steps, double most,
            double* image, double* normal, double* gap, double* left)
{
  Four X = four(image), n{};
  *gap = 0, *left = 0;
  bool found = true;
  for (int k = 0; k < steps && found; ++k) {
    found = newton_step(grid, body.u, four(place), X, n, *gap, *left);
    if (*left < 1e-5 * grid.radius || (k > 0 && *gap > most)) break;
  }
  four(image) = X, four(normal) = n;
  return found;
}

/// The image of a marker at `place` (in the far body's frame), its gap and normal; false: it has none, and
/// never had.
GRANULAW_INLINE bool find_image(const SphereGrid& grid, const double* u, Four place, Four signs,
                                FacingMarker& marker, double& gap)
{
  Four X = four(marker.image), normal;
  double left;
  if (newton_step(grid, u, place, X, normal, gap, left)) {
    four(marker.image) = X, four(marker.normal) = signs * normal;
    return true;
  }
  normal = signs * four(marker.normal);
  if (!(dot(normal, normal) > 0)) return false;
  Four x, F[3];
  motion(grid, u, four(marker.image), x, F);
  gap = dot(normal, place - x);
  return true;
}

template <class Layout>
int face(const RowNodes* bodies, const FacingSurface& surface, FacingMarker* markers, int count, double kick,
         double dt, double recovery, ContactRow* rows, double* far_weights)
{
  const RowNodes &nodes = bodies[surface.near_body], &far = bodies[surface.far_body];
  const SphereGrid& grid = *surface.far;
  const Four signs = four(surface.signs), shift = four(surface.shift), drift = four(surface.drift);
  const double soon = 2 * dt * surface.closing;
  int made = 0;
  for (int n = 0; n < count; ++n) {
    FacingMarker& marker = markers[n];
    if (marker.sleep > 0) {
      --marker.sleep;
      continue;
    }
    const int m = marker.marker;
    const Stencil near{surface.near_body, cell_nodes, 4 * surface.node[m], surface.near->offset,
                       surface.weight + long(cell_nodes) * m};
    const Four start{surface.place[m][0], surface.place[m][1], surface.place[m][2], 0.0};
    const Four place = start + Layout::carried(nodes, nodes.u, near, cell_nodes);
    double gap;
    if (!find_image(grid, far.u, signs * (place + shift), signs, marker, gap)) continue;
    const bool pushed = largest_of(magnitude(four(marker.impulse))) > 0.0;
    if (!pushed && gap > soon + surface.open) {
      const double steps = gap / (soon + 1e-12);
      marker.sleep = steps < 20 ? static_cast<int>(steps) : 20;
      continue;
    }
    SplinesAt s;
    find_splines(grid, four(marker.image), s);
    double* weight = far_weights + long(cell_nodes) * made;
    Four there{};
#pragma GCC unroll 27
    for (int k = 0; k < cell_nodes; ++k) {
      weight[k] = s.n[0][k / 9] * s.n[1][k / 3 % 3] * s.n[2][k % 3];
      there += weight[k] * four(far.v + s.lowest + grid.offset[k]);
    }
    const Four normal = four(marker.normal);
    Four velocity = Layout::carried(nodes, nodes.v, near, cell_nodes) - signs * there;
    velocity += drift;
    if (!pushed && gap + dt * dot(normal, velocity) > surface.open) continue;
    ContactRow& row = rows[made];
    four(row.normal) = normal, four(row.along) = normal;
    four(row.of_other) = -signs, four(row.drift) = drift;
    row.near = near, row.far = {surface.far_body, cell_nodes, s.lowest, grid.offset, weight};
    row.impulse = marker.impulse, row.friction = surface.friction, row.speed = 0;
    row.needed = -(gap < 0 ? recovery : 1) * gap / dt;
    row.marker = n, row.plane = -1;
    weigh_row<Layout>(bodies, kick, velocity, row);
    made += row.response > 0 ? 1 : 0;
  }
  return made;
}

template <class Layout>
void push_side(const RowNodes& nodes, const ContactRow* rows, int count, bool far, const double* known)
{
  for (int n = 0; n < count; ++n) {
    const ContactRow& row = rows[n];
    const Four impulse = known ? four(row.impulse) - four(known + 4L * n) : four(row.impulse);
    if (!(largest_of(magnitude(impulse)) > 0.0)) continue;
    if (far)
      Layout::push(nodes, row.far, row.far.corners, four(row.of_other) * impulse);
    else
      Layout::push(nodes, row.near, Layout::corners(row.near), impulse);
  }
}

template <class Layout>
void start(const RowNodes* bodies, const ContactRow* rows, int count)
{
  for (int n = 0; n < count; ++n)
    if (largest_of(magnitude(four(rows[n].impulse))) > 0.0)
      push<Layout>(bodies, rows[n], four(rows[n].impulse));
}

/// The tangential impulse that stops the sliding, or the friction's most against it. Normals are of length 1.
GRANULAW_INLINE Four tangential_impulse(const ContactRow& row, Four v, Four p, double normal_velocity,
                                        double normal_impulse, double wanted)
{
  const Four normal = four(row.normal);
  const Four sliding = v - normal_velocity * normal;
  const Four tangential = p - normal_impulse * normal - sliding / row.tangent_response;
  const double most = row.friction * wanted, size = square_root(dot(tangential, tangential));
  return size > most ? most / size * tangential : tangential;
}

template <class Layout>
double sweep(const RowNodes* bodies, ContactRow* rows, int count)
{
  double change = 0, largest = 0;
  for (int n = 0; n < count; ++n) {
    const ContactRow& row = rows[n];
    const Four normal = four(row.normal), v = velocity_of<Layout>(bodies, row);
    const Four p = four(row.impulse);
    const double normal_velocity = dot(normal, v), normal_impulse = dot(four(row.along), p);
    const double free = normal_impulse + (row.needed - normal_velocity) / row.response;
    const double wanted = free > 0.0 ? free : 0.0;
    Four next = wanted * normal;
    if (row.friction > 0.0 && wanted > 0.0)
      next += tangential_impulse(row, v, p, normal_velocity, normal_impulse, wanted);
    const Four step = next - p;
    const double moved = largest_of(magnitude(step));
    if (moved > 0.0) push<Layout>(bodies, row, step);
    four(row.impulse) = next;
    change = moved > change ? moved : change;
    largest = wanted > largest ? wanted : largest;
  }
  // where all have let go, a marker may have to be pushed again
  return largest > 0.0 ? change / largest : (change > 0.0 ? 1.0 : 0.0);
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

// bodies of revolution meet by contact/surface.cpp
extern const RowKernels corner_rows{
    carry<InCorners>, velocity<InCorners>,  weigh<InCorners>, make<InCorners>,  nullptr,
    nullptr,          push_side<InCorners>, start<InCorners>, sweep<InCorners>, largest};
extern const RowKernels cell_rows{
    carry<InCells>, velocity<InCells>,  weigh<InCells>, make<InCells>,  face<InCells>,
    invert,         push_side<InCells>, start<InCells>, sweep<InCells>, largest};

}  // namespace granulaw::GRANULAW_ISA_NAMESPACE
