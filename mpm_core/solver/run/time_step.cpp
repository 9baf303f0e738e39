#include "solver/run/time_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/error.hpp"
#include "solver/grid/updated_body.hpp"
#include "solver/body/kernels.hpp"
#include "solver/loading/loading_programme.hpp"
#include "solver/body/spatial_kernels.hpp"
#include "solver/contact/spatial_scene.hpp"

namespace granulaw {

namespace {

/// On a reference grid (`mapped`, `rectilinear`) weights, masses and nodal velocities are kept for good; on
/// the `updated` grid the points bring them anew.
void points_to_grid(Body& body)
{
  if (body.moving)
    updated_points_to_grid(body);
  else
    kernels().internal_force(body, false);
}

void points_to_grid(SpatialBody& body)
{
  spatial_kernels().internal_force(body, false);
}

void update_grid(Body& body, double kick)
{
  kernels().accelerate(body, kick);
  for (const int i : body.axis) body.vr_i[i] = 0;  // symmetry
}

void update_grid(SpatialBody& body, double kick)
{
  spatial_kernels().accelerate(body, kick);
}

void grid_to_points(Body& body, double dt)
{
  body.travel += dt * body.mean_velocity();
  kernels().move(body, dt);
  if (body.moving) updated_grid_to_points(body, dt);
}

void grid_to_points(SpatialBody& body, double dt)
{
  const Vector3 way = dt * mean_velocity(body);
  for (int d = 0; d < 3; ++d) body.travel[d] += way[d];
  spatial_kernels().move(body, dt);
}

}  // namespace

template <class Scene>
double advance(Scene& scene, BasicProgramme<Scene>& programme, double time, double kick, double dt)
{
  for (auto& body : scene.bodies) {
    points_to_grid(body);     // stresses become forces on the nodes
    update_grid(body, kick);  // forces become velocities
  }
  programme.lead(scene, time, dt);                                        // what pushes from outside
  const double impulse = scene.contact->correct(scene.bodies, kick, dt);  // nothing passes the other side
  programme.apply(scene, time, dt, impulse > 0);                          // what holds or throws the bodies
  scene.contact->account(scene.bodies);
  for (auto& body : scene.bodies) grid_to_points(body, dt);  // displacements, and the points with them
  return impulse;
}

template double advance(Scene&, BasicProgramme<Scene>&, double, double, double);
template double advance(SpatialScene&, BasicProgramme<SpatialScene>&, double, double, double);

namespace {

/// Beyond this the step would fall without end: a film of Y/100 on a core lasts 300000 steps, and impacts at
/// 5000 V_y stay below 45.
constexpr double squeezed = 50;

/// The points come and go among the nodes of an `updated` grid, so its frequencies change all the time.
/// Inside a uniform grid of quadratic splines with lumped masses omega_max = sqrt(3) c/h in two dimensions,
/// which allows dt = 1.15 h/c; nodes with little mass near a surface take half of that off.
double updated_step(const Body& body)
{
  const MovingPoints& m = *body.moving;
  double fastest = 0, finest = 1;
  for (const Region& region : body.regions)
    for (int p = region.begin; p < region.end; ++p)
      fastest = std::max(
          fastest, (region.moduli.bulk + 4.0 / 3.0 * region.moduli.shear) * body.volume_p[p] / m.mass[p]);
  for (const SplineAxis* axis : {&m.r_axis, &m.z_axis})
    for (int c = 0; c < axis->cells(); ++c)
      finest = std::min(finest, axis->lines()[c + 1] - axis->lines()[c]);
  return 0.6 * finest / std::sqrt(fastest);
}

/// A body's nodes as the power iteration sees them: x holds `components` numbers for each of `count` nodes.
struct NodeVector
{
  int count, components;
  std::vector<double> x;

  NodeVector(int nodes, int each) : count(nodes), components(each), x(std::size_t(nodes) * each) {}
  void fill_at_random()
  {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (double& value : x) value = uniform(random);
  }
  double& operator()(int node, int component) { return x[std::size_t(components) * node + component]; }
  double square(int node)
  {
    double sum = 0;
    for (int c = 0; c < components; ++c) sum += (*this)(node, c) * (*this)(node, c);
    return sum;
  }
};

/// omega_max^2 by power iteration on M^-1 K. respond(step) replaces x by M^-1 K x, found with the
/// displacements step x, no larger than `amplitude`: the response is linear then. hold() zeroes what is held.
/// The vector that converges fastest alternates in sign.
template <class Respond, class Hold>
double largest_eigenvalue(NodeVector& x, const std::vector<double>& mass, double amplitude, int iterations,
                          Respond respond, Hold hold)
{
  hold();
  double eigenvalue = 0;
  for (int n = 0; n < iterations; ++n) {
    double norm = 0;
    for (int i = 0; i < x.count; ++i) norm += mass[i] * x.square(i);
    const double scale = 1 / std::sqrt(norm);
    double largest = 0;
    for (double& value : x.x) {
      largest = std::max(largest, std::abs(value * scale));
      value *= scale;
    }
    respond(amplitude / largest);
    eigenvalue = 0;
    for (int i = 0; i < x.count; ++i) eigenvalue += mass[i] * x.square(i);
    hold();
    eigenvalue = std::sqrt(eigenvalue);  // |M^-1 K x| for |x| = 1, in the mass norm: from below
  }
  return eigenvalue;
}

[[noreturn]] void fail_squeezed()
{
  fail("solver",
       "a cell has been squeezed to a fiftieth of its size, more than a reference grid can follow (over "
       "0.4 R? a soft "
       "layer on a hard core?); stay below this depth or use --grid updated");
}

}  // namespace

template <>
StableStep<Body>::StableStep(Body& body)
{
  if (body.moving) {
    omega_ = 2 / updated_step(body);
    return;
  }
  NodeVector x(body.nodes, 2);
  x.fill_at_random();
  const auto respond = [&](double step) {
    for (int i = 0; i < body.nodes; ++i) body.ur_i[i] = step * x(i, 0), body.uz_i[i] = step * x(i, 1);
    kernels().internal_force(body, true);
    for (int i = 0; i < body.nodes; ++i) {
      x(i, 0) = -body.fr_i[i] / step * body.inverse_mass_i[i];
      x(i, 1) = -body.fz_i[i] / step * body.inverse_mass_i[i];
    }
  };
  const auto hold_axis = [&] {
    for (const int i : body.axis) x(i, 0) = 0;
  };
  omega_ = 1.01 * std::sqrt(largest_eigenvalue(x, body.mass_i, 1e-7, 80, respond, hold_axis));
  std::fill(body.ur_i.begin(), body.ur_i.end(), 0.0);
  std::fill(body.uz_i.begin(), body.uz_i.end(), 0.0);
  bound_ = kernels().growth(body);
}

template <>
double StableStep<Body>::limit(const Body& body) const
{
  if (body.moving) return 2 / omega_;
  const double worst = std::max(bound_, kernels().growth(body));
  if (worst > squeezed * squeezed * bound_) fail_squeezed();
  return 2 / (omega_ * std::sqrt(worst / bound_));
}

template <>
StableStep<SpatialBody>::StableStep(SpatialBody& body)
{
  const SpatialKernels& kernel = spatial_kernels();
  NodeVector x(body.nodes, 4);
  x.fill_at_random();
  const auto respond = [&](double step) {
    for (std::size_t k = 0; k < x.x.size(); ++k) body.u_i[k] = step * x.x[k];
    kernel.internal_force(body, true);
    for (std::size_t k = 0; k < x.x.size(); ++k) x.x[k] = -body.f_i[k] / step * body.inverse_mass_i[k];
  };
  const auto hold = [&] {
    for (std::size_t k = 0; k < x.x.size(); ++k)
      if (body.inverse_mass_i[k] == 0) x.x[k] = 0;
  };
  omega_ =
      1.01 * std::sqrt(largest_eigenvalue(x, body.mass_i, 1e-7 * body.surface.finest, 30, respond, hold));
  std::fill(body.u_i.begin(), body.u_i.end(), 0.0);
}

template <>
double StableStep<SpatialBody>::limit(const SpatialBody& body) const
{
  const CellGrowth now = spatial_kernels().growth(body);
  if (!(now.least_volume > 0) || now.largest > squeezed * squeezed)
    fail(
        "solver",
        fmt::format("a cell was {}: the body is squeezed further than a reference grid can follow (planes "
                    "from all sides: beyond a nominal density of about 1.1); stay below this depth or take a "
                    "finer grid",
                    now.least_volume > 0 ? "squeezed to a fiftieth of its size" : "turned inside out"));
  // At the surface a cut lets the frequencies be up to twice those of a filled cell: there they grow from the
  // highest of the body at rest.
  return 2 / std::sqrt(std::max(omega_ * omega_ * std::max(1.0, now.cut), now.filled_omega2));
}

}  // namespace granulaw
