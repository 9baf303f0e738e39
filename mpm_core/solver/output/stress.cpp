#include "solver/output/stress.hpp"

#include <cmath>

#include "solver/kernels.hpp"

namespace granulaw {

double CauchyStress::von_mises() const
{
  const double mean = (rr + zz + hh) / 3, dr = rr - mean, dz = zz - mean, dh = hh - mean;
  return std::sqrt(1.5 * (dr * dr + dz * dz + dh * dh + 2 * rz * rz));
}

namespace {

/// Of a point of the `updated` grid, which keeps its Kirchhoff stress.
CauchyStress stress_of_moving_point(const Body& body, int p)
{
  const MovingPoints& m = *body.moving;
  // elastic left Cauchy-Green tensor b = 1 + c; plastic flow keeps the volume: J^2 = det b
  const double j2 =
      ((1 + body.crr_p[p]) * (1 + body.czz_p[p]) - body.crz_p[p] * body.crz_p[p]) * (1 + body.chh_p[p]);
  const double per_j = 1 / std::sqrt(j2);
  return {m.trr[p] * per_j, m.tzz[p] * per_j, m.trz[p] * per_j, m.thh[p] * per_j};
}

/// An axisymmetric displacement gradient, F = 1 + h.
struct DisplacementGradient
{
  double rr = 0, rz = 0, zr = 0, zz = 0, hh = 0;
};

DisplacementGradient gradient_at(const Body& body, int p)
{
  DisplacementGradient h;
  for (int k = 0; k < body.corners; ++k) {
    const std::size_t at = std::size_t(k) * body.points + p;
    const int i = body.corner_p[at];
    h.rr += body.br_p[at] * body.ur_i[i], h.rz += body.bz_p[at] * body.ur_i[i];
    h.zr += body.br_p[at] * body.uz_i[i], h.zz += body.bz_p[at] * body.uz_i[i];
    h.hh += body.bh_p[at] * body.ur_i[i];
  }
  return h;
}

/// Of a point that keeps its plastic state, from the displacements.
CauchyStress stress_of_point(const Body& body, const Moduli& moduli, int p)
{
  const DisplacementGradient h = gradient_at(body, p);
  const double frr = 1 + h.rr, fzz = 1 + h.zz, fhh = 1 + h.hh;
  const double jacobian = (frr * fzz - h.rz * h.zr) * fhh;
  // elastic left Cauchy-Green tensor F Cp^-1 F^T minus identity; differences keep small strains exact
  const double crr = body.crr_p[p], czz = body.czz_p[p], crz = body.crz_p[p];
  const double grr = frr * crr + h.rz * crz, grz = frr * crz + h.rz * czz;
  const double gzr = h.zr * crr + fzz * crz, gzz = h.zr * crz + fzz * czz;
  const double xrr = 2 * h.rr + h.rr * h.rr + h.rz * h.rz + grr * frr + grz * h.rz;
  const double xzz = 2 * h.zz + h.zz * h.zz + h.zr * h.zr + gzr * h.zr + gzz * fzz;
  const double xrz = h.rz + h.zr + h.rr * h.zr + h.rz * h.zz + grr * h.zr + grz * fzz;
  const double xhh = 2 * h.hh + h.hh * h.hh + fhh * fhh * body.chh_p[p];
  // principal logarithmic strains, Kirchhoff stress tau = 2 G dev(e) + K tr(e)
  const double mean = 0.5 * (xrr + xzz), half = 0.5 * (xrr - xzz), radius = std::hypot(half, xrz);
  const double e1 = 0.5 * std::log1p(mean + radius), e2 = 0.5 * std::log1p(mean - radius),
               e3 = 0.5 * std::log1p(xhh);
  const double trace = e1 + e2 + e3, shear2 = 2 * moduli.shear;
  const double tau1 = shear2 * (e1 - trace / 3) + moduli.bulk * trace;
  const double tau2 = shear2 * (e2 - trace / 3) + moduli.bulk * trace;
  const double tau3 = shear2 * (e3 - trace / 3) + moduli.bulk * trace;
  const double cosine = radius > 0 ? half / radius : 1, sine = radius > 0 ? xrz / radius : 0;
  const double tm = 0.5 * (tau1 + tau2), td = 0.5 * (tau1 - tau2);
  return {(tm + td * cosine) / jacobian, (tm - td * cosine) / jacobian, td * sine / jacobian,
          tau3 / jacobian};
}

}  // namespace

std::vector<CauchyStress> cauchy_stress(const Body& body)
{
  std::vector<CauchyStress> stress(static_cast<std::size_t>(body.points));
  for (const Region& region : body.regions)
    for (int p = region.begin; p < region.end; ++p)
      stress[static_cast<std::size_t>(p)] =
          body.moving ? stress_of_moving_point(body, p) : stress_of_point(body, region.moduli, p);
  return stress;
}

PointState point_state_now(const Body& body)
{
  Body copy = body;
  copy.fetch_state();
  copy.single = {};
  if (!copy.moving) kernels().internal_force(copy, false);
  return {cauchy_stress(copy), std::move(copy.plastic_strain_p)};
}

}  // namespace granulaw
