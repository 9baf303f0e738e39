#include "solver/stress.hpp"

#include <cmath>

#include "solver/kernels.hpp"

namespace granulaw {

double CauchyStress::von_mises() const
{
  const double mean = (rr + zz + hh) / 3, dr = rr - mean, dz = zz - mean, dh = hh - mean;
  return std::sqrt(1.5 * (dr * dr + dz * dz + dh * dh + 2 * rz * rz));
}

std::vector<CauchyStress> cauchy_stress(const Body& body)
{
  std::vector<CauchyStress> stress(static_cast<std::size_t>(body.points));
  for (const Region& region : body.regions)
    for (int p = region.begin; p < region.end; ++p) {
      if (body.moving) {
        const MovingPoints& m = *body.moving;
        // elastic left Cauchy-Green tensor b = 1 + c; plastic flow keeps the volume: J^2 = det b
        const double j2 =
            ((1 + body.crr_p[p]) * (1 + body.czz_p[p]) - body.crz_p[p] * body.crz_p[p]) * (1 + body.chh_p[p]);
        const double per_j = 1 / std::sqrt(j2);
        stress[p] = {m.trr[p] * per_j, m.tzz[p] * per_j, m.trz[p] * per_j, m.thh[p] * per_j};
        continue;
      }
      // displacement gradient, F = 1 + h
      double hrr = 0, hrz = 0, hzr = 0, hzz = 0, hhh = 0;
      for (int k = 0; k < body.corners; ++k) {
        const std::size_t at = std::size_t(k) * body.points + p;
        const int i = body.corner_p[at];
        hrr += body.br_p[at] * body.ur_i[i], hrz += body.bz_p[at] * body.ur_i[i];
        hzr += body.br_p[at] * body.uz_i[i], hzz += body.bz_p[at] * body.uz_i[i];
        hhh += body.bh_p[at] * body.ur_i[i];
      }
      const double frr = 1 + hrr, fzz = 1 + hzz, fhh = 1 + hhh;
      const double jacobian = (frr * fzz - hrz * hzr) * fhh;
      // elastic left Cauchy-Green tensor F Cp^-1 F^T minus identity; differences keep small strains exact
      const double crr = body.crr_p[p], czz = body.czz_p[p], crz = body.crz_p[p];
      const double grr = frr * crr + hrz * crz, grz = frr * crz + hrz * czz;
      const double gzr = hzr * crr + fzz * crz, gzz = hzr * crz + fzz * czz;
      const double xrr = 2 * hrr + hrr * hrr + hrz * hrz + grr * frr + grz * hrz;
      const double xzz = 2 * hzz + hzz * hzz + hzr * hzr + gzr * hzr + gzz * fzz;
      const double xrz = hrz + hzr + hrr * hzr + hrz * hzz + grr * hzr + grz * fzz;
      const double xhh = 2 * hhh + hhh * hhh + fhh * fhh * body.chh_p[p];
      // principal logarithmic strains, Kirchhoff stress tau = 2 G dev(e) + K tr(e)
      const double mean = 0.5 * (xrr + xzz), half = 0.5 * (xrr - xzz), radius = std::hypot(half, xrz);
      const double e1 = 0.5 * std::log1p(mean + radius), e2 = 0.5 * std::log1p(mean - radius),
                   e3 = 0.5 * std::log1p(xhh);
      const double trace = e1 + e2 + e3, shear2 = 2 * region.moduli.shear;
      const double tau1 = shear2 * (e1 - trace / 3) + region.moduli.bulk * trace;
      const double tau2 = shear2 * (e2 - trace / 3) + region.moduli.bulk * trace;
      const double tau3 = shear2 * (e3 - trace / 3) + region.moduli.bulk * trace;
      const double cosine = radius > 0 ? half / radius : 1, sine = radius > 0 ? xrz / radius : 0;
      const double tm = 0.5 * (tau1 + tau2), td = 0.5 * (tau1 - tau2);
      stress[static_cast<std::size_t>(p)] = {(tm + td * cosine) / jacobian, (tm - td * cosine) / jacobian,
                                             td * sine / jacobian, tau3 / jacobian};
    }
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
