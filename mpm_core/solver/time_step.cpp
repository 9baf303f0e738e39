#include "solver/time_step.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "base/error.hpp"
#include "solver/grid/updated_body.hpp"
#include "solver/kernels.hpp"
#include "solver/run/loading_programme.hpp"

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

void grid_to_points(Body& body, double dt)
{
  body.travel += dt * body.mean_velocity();
  kernels().move(body, dt);
  if (body.moving) updated_grid_to_points(body, dt);
}

}  // namespace

double advance(Scene& scene, LoadingProgramme& programme, double time, double kick, double dt)
{
  const Kernels& k = kernels();
  for (Body& body : scene.bodies) {
    points_to_grid(body);                            // stresses become forces on the nodes
    k.accelerate(body, kick);                        // grid update
    for (const int i : body.axis) body.vr_i[i] = 0;  // symmetry
  }
  const double impulse = scene.contact->correct(scene.bodies, kick, dt);  // nothing passes the other side
  programme.apply(scene, time, dt, impulse > 0);                          // what holds or throws the bodies
  scene.contact->account(scene.bodies);
  for (Body& body : scene.bodies) grid_to_points(body, dt);  // displacements, and the points with them
  return impulse;
}

namespace {

/// Sum of squared gradients over the corners: a cell's own bound on omega^2 is c^2 times this, up to a factor
/// common to all cells.
double cell_bound(const Body& body, int p)
{
  double sum = 0;
  for (int k = 0; k < body.corners; ++k) {
    const std::size_t at = std::size_t(k) * body.points + p;
    sum += body.br_p[at] * body.br_p[at] + body.bz_p[at] * body.bz_p[at];
  }
  return sum;
}

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

}  // namespace

StableStep::StableStep(Body& body)
{
  if (body.moving) {
    omega_ = 2 / updated_step(body);
    return;
  }
  // Displacements of 1e-7 keep the response linear; the vector that converges fastest alternates in sign.
  constexpr double amplitude = 1e-7;
  constexpr int iterations = 80;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> xr(body.nodes), xz(body.nodes);
  for (int i = 0; i < body.nodes; ++i) xr[i] = uniform(random), xz[i] = uniform(random);
  for (const int i : body.axis) xr[i] = 0;
  double eigenvalue = 0;
  for (int n = 0; n < iterations; ++n) {
    double norm = 0;
    for (int i = 0; i < body.nodes; ++i) norm += body.mass_i[i] * (xr[i] * xr[i] + xz[i] * xz[i]);
    const double scale = 1 / std::sqrt(norm);
    double largest = 0;
    for (int i = 0; i < body.nodes; ++i)
      largest = std::max({largest, std::abs(xr[i] * scale), std::abs(xz[i] * scale)});
    const double step = amplitude / largest;
    for (int i = 0; i < body.nodes; ++i) {
      xr[i] *= scale, xz[i] *= scale;
      body.ur_i[i] = step * xr[i], body.uz_i[i] = step * xz[i];
    }
    kernels().internal_force(body, true);
    eigenvalue = 0;
    for (int i = 0; i < body.nodes; ++i) {
      const double ar = -body.fr_i[i] / step * body.inverse_mass_i[i];
      const double az = -body.fz_i[i] / step * body.inverse_mass_i[i];
      eigenvalue += body.mass_i[i] * (ar * ar + az * az);
      xr[i] = ar, xz[i] = az;
    }
    for (const int i : body.axis) xr[i] = 0;
    eigenvalue = std::sqrt(eigenvalue);  // |M^-1 K x| for |x| = 1, in the mass norm: from below
  }
  omega_ = 1.01 * std::sqrt(eigenvalue);
  std::fill(body.ur_i.begin(), body.ur_i.end(), 0.0);
  std::fill(body.uz_i.begin(), body.uz_i.end(), 0.0);
  for (int p = 0; p < body.points; ++p) bound_ = std::max(bound_, cell_bound(body, p));
}

double StableStep::limit(const Body& body) const
{
  if (body.moving) return 2 / omega_;
  double worst = bound_;
  const int n = body.points;
  for (int p = 0; p < n; ++p) {
    double hrr = 0, hrz = 0, hzr = 0, hzz = 0;
    for (int k = 0; k < body.corners; ++k) {
      const std::size_t at = std::size_t(k) * n + p;
      const int i = body.corner_p[at];
      hrr += body.br_p[at] * body.ur_i[i], hrz += body.bz_p[at] * body.ur_i[i];
      hzr += body.br_p[at] * body.uz_i[i], hzz += body.bz_p[at] * body.uz_i[i];
    }
    // largest eigenvalue of F^-1 F^-T = 1/(smallest of F^T F); 2 x 2
    const double frr = 1 + hrr, fzz = 1 + hzz;
    const double a = frr * frr + hzr * hzr, b = hrz * hrz + fzz * fzz, c = frr * hrz + hzr * fzz;
    const double smallest = 0.5 * (a + b) - std::sqrt(0.25 * (a - b) * (a - b) + c * c);
    worst = std::max(worst, cell_bound(body, p) / std::max(smallest, 1e-12));
  }
  if (worst > squeezed * squeezed * bound_)
    fail("solver",
         "a cell has been squeezed to a fiftieth of its size, more than a reference grid can follow (over "
         "0.4 R? a soft "
         "layer on a hard core?); stay below this depth or use --grid updated");
  return 2 / (omega_ * std::sqrt(worst / bound_));
}

}  // namespace granulaw
