#include "solver/time_step.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "solver/kernels.hpp"

namespace granulaw {

double advance(Body& body, PlaneContact& contact, Drive& drive, double time, double dt)
{
  const Kernels& k = kernels();
  k.internal_force(body, false);                     // points to grid: stresses, internal forces
  k.accelerate(body, dt);                            // grid update
  for (const int i : body.axis) body.vr_i[i] = 0;    // symmetry
  const double impulse = contact.correct(body, dt);  // contact: no node ends below the plane
  drive.apply(body, time, dt, impulse > 0);          // what holds or throws the body
  k.move(body, dt);                                  // grid to points: displacements, kept for good
  return impulse;
}

namespace {

/// Sum of squared gradients over the corners: a cell's own bound on omega^2 is c^2 times this, up to a factor
/// common to all cells.
double cell_bound(const Body& body, int p)
{
  double sum = 0;
  for (int k = 0; k < 4; ++k) {
    const std::size_t at = std::size_t(k) * body.points + p;
    sum += body.br_p[at] * body.br_p[at] + body.bz_p[at] * body.bz_p[at];
  }
  return sum;
}

}  // namespace

StableStep::StableStep(Body& body)
{
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
  double worst = bound_;
  const int n = body.points;
  for (int p = 0; p < n; ++p) {
    double hrr = 0, hrz = 0, hzr = 0, hzz = 0, hhh = 0;
    for (int k = 0; k < 4; ++k) {
      const std::size_t at = std::size_t(k) * n + p;
      const int i = body.corner_p[at];
      hrr += body.br_p[at] * body.ur_i[i], hrz += body.bz_p[at] * body.ur_i[i];
      hzr += body.br_p[at] * body.uz_i[i], hzz += body.bz_p[at] * body.uz_i[i];
      hhh += body.bh_p[at] * body.ur_i[i];
    }
    // largest eigenvalue of F^-1 F^-T = 1/(smallest of F^T F); 2 x 2
    const double frr = 1 + hrr, fzz = 1 + hzz;
    const double a = frr * frr + hzr * hzr, b = hrz * hrz + fzz * fzz, c = frr * hrz + hzr * fzz;
    const double smallest = 0.5 * (a + b) - std::sqrt(0.25 * (a - b) * (a - b) + c * c);
    worst = std::max(worst, cell_bound(body, p) / std::max(smallest, 1e-12));
  }
  return 2 / (omega_ * std::sqrt(worst / bound_));
}

}  // namespace granulaw
