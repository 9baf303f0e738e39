#pragma once

#include "solver/material/stress_update.hpp"

// Deformation and stress of axisymmetric points by their principal axes, for loops over material points that
// vectorise. As with the flow laws, every function must be always_inline (material/parameter.hpp).

namespace granulaw::kernel {

/// The dimension of update_stress (stress_update.hpp): r, z and the hoop direction h.
template <class Real>
struct Axisymmetric
{
  using Number = Real;
  static constexpr int components = 4;  ///< of the plastic state: rr zz rz hh
  static constexpr int kept = 8;        ///< numbers of a trial strain

  struct alignas(64) Block
  {
    using Values = Real[block_points];
    Values hrr, hrz, hzr, hzz, hhh;  ///< displacement gradient, F = 1 + h
    Values prr, prz, pzr, pzz, phh;  ///< first Piola-Kirchhoff stress
    Values qr, qz;                   ///< four corners: hourglass amplitudes
  };
  struct Gradient
  {
    Real rr, rz, zr, zz, hh;
  };
  struct Symmetric
  {
    Real rr, zz, rz, hh;
  };
  /// Elastic strain of a point.
  struct Strain
  {
    Real x1, x2, xhh;   ///< principal values of the elastic left Cauchy-Green tensor minus identity
    Real cosine, sine;  ///< of twice the angle of its principal axes
    Real s1, s2, s3;    ///< deviators of the principal logarithmic strains
    Real trace;         ///< and their sum
  };

  static GRANULAW_MEMBER Gradient gradient(const Block& b, int p)
  {
    return {b.hrr[p], b.hrz[p], b.hzr[p], b.hzz[p], b.hhh[p]};
  }
  /// det F
  static GRANULAW_MEMBER Real determinant(const Gradient h)
  {
    constexpr Real one = 1;
    return ((one + h.rr) * (one + h.zz) - h.rz * h.zr) * (one + h.hh);
  }
  /// F F^T - 1
  static GRANULAW_MEMBER Symmetric stretched(const Gradient h)
  {
    return {Real(2) * h.rr + h.rr * h.rr + h.rz * h.rz, Real(2) * h.zz + h.zz * h.zz + h.zr * h.zr,
            h.rz + h.zr + h.rr * h.zr + h.rz * h.zz, Real(2) * h.hh + h.hh * h.hh};
  }
  /// x += F c F^T
  static GRANULAW_MEMBER void add_pushed(Symmetric& x, const Gradient h, const Symmetric c)
  {
    constexpr Real one = 1;
    const Real frr = one + h.rr, fzz = one + h.zz, fhh = one + h.hh;
    const Real g11 = frr * c.rr + h.rz * c.rz, g12 = frr * c.rz + h.rz * c.zz;
    const Real g21 = h.zr * c.rr + fzz * c.rz, g22 = h.zr * c.rz + fzz * c.zz;
    x.rr += g11 * frr + g12 * h.rz;
    x.rz += g11 * h.zr + g12 * fzz;
    x.zz += g21 * h.zr + g22 * fzz;
    x.hh += fhh * fhh * c.hh;
  }
  /// Logarithmic strain of 1 + x.
  static GRANULAW_MEMBER Strain logarithm(const Symmetric x)
  {
    const Real mean = Real(0.5) * (x.rr + x.zz), half = Real(0.5) * (x.rr - x.zz);
    const Real radius = root_of(half * half + x.rz * x.rz);
    const Real per_radius = Real(1) / (radius + tiny<Real>);
    Strain e;
    e.cosine = half * per_radius, e.sine = x.rz * per_radius;
    e.x1 = mean + radius, e.x2 = mean - radius, e.xhh = x.hh;
    const Real e1 = Real(0.5) * log_1p(e.x1), e2 = Real(0.5) * log_1p(e.x2), e3 = Real(0.5) * log_1p(e.xhh);
    e.trace = e1 + e2 + e3;
    const Real third = e.trace * Real(1.0 / 3.0);
    e.s1 = e1 - third, e.s2 = e2 - third, e.s3 = e3 - third;
    return e;
  }
  /// Deviator : deviator.
  static GRANULAW_MEMBER Real square(const Strain& e) { return e.s1 * e.s1 + e.s2 * e.s2 + e.s3 * e.s3; }
  /// The deviator less `share` of it.
  static GRANULAW_MEMBER void shrink(Strain& e, Real share)
  {
    e.s1 -= share * e.s1, e.s2 -= share * e.s2, e.s3 -= share * e.s3;
  }

  template <bool flows>
  static GRANULAW_MEMBER void put(Real (&to)[kept][block_points], int p, const Symmetric&, const Strain& e)
  {
    to[0][p] = e.s1, to[1][p] = e.s2, to[2][p] = e.s3, to[3][p] = e.cosine, to[4][p] = e.sine;
    if constexpr (flows) to[5][p] = e.x1, to[6][p] = e.x2, to[7][p] = e.xhh;
  }
  static GRANULAW_MEMBER Strain strain(const Real (&from)[kept][block_points], int p, Real trace)
  {
    return {from[5][p], from[6][p], from[7][p], from[3][p], from[4][p],
            from[0][p], from[1][p], from[2][p], trace};
  }

  static GRANULAW_MEMBER Symmetric state(Real* const __restrict (&c)[components], int p)
  {
    return {c[0][p], c[1][p], c[2][p], c[3][p]};
  }
  /// c += F^-1 [b (exp(by e + volume) - 1)] F^-T: the plastic state after the flow from the trial strain e.
  template <bool dilates>
  static GRANULAW_MEMBER void add_pulled_back_flow(Real* const __restrict (&c)[components], int p,
                                                   const Real (&)[kept][block_points], const Gradient h,
                                                   const Strain& e, Real by, [[maybe_unused]] Real volume)
  {
    constexpr Real one = 1;
    const Real frr = one + h.rr, fzz = one + h.zz, fhh = one + h.hh;
    const Real per_det = one / (frr * fzz - h.rz * h.zr), per_fhh = one / fhh;
    Real v1 = by * e.s1, v2 = by * e.s2, v3 = by * e.s3;
    if constexpr (dilates) v1 += volume, v2 += volume, v3 += volume;
    const Real d1 = (one + e.x1) * exp_m1(v1), d2 = (one + e.x2) * exp_m1(v2);
    const Real d3 = (one + e.xhh) * exp_m1(v3);
    const Real dm = Real(0.5) * (d1 + d2), dd = Real(0.5) * (d1 - d2);
    const Real drr = dm + dd * e.cosine, dzz = dm - dd * e.cosine, drz = dd * e.sine;
    const Real g11 = fzz * drr - h.rz * drz, g12 = fzz * drz - h.rz * dzz;
    const Real g21 = -h.zr * drr + frr * drz, g22 = -h.zr * drz + frr * dzz;
    const Real per_det2 = per_det * per_det;
    c[0][p] += per_det2 * (g11 * fzz - g12 * h.rz);
    c[2][p] += per_det2 * (-g11 * h.zr + g12 * frr);
    c[1][p] += per_det2 * (-g21 * h.zr + g22 * frr);
    c[3][p] += per_fhh * per_fhh * d3;
  }
  /// tau/J of tau = shear2 e + pressure.
  static GRANULAW_MEMBER CauchyStress cauchy_stress(const Gradient h, const Strain& e, Real shear2,
                                                    Real pressure)
  {
    const Real per_j = Real(1) / determinant(h), t3 = shear2 * e.s3 + pressure;
    const Real tm = Real(0.5) * shear2 * (e.s1 + e.s2) + pressure, td = Real(0.5) * shear2 * (e.s1 - e.s2);
    return {(tm + td * e.cosine) * per_j, t3 * per_j, (tm - td * e.cosine) * per_j, 0,
            td * e.sine * per_j,          0};
  }
  /// First Piola-Kirchhoff stress P = tau F^-T of tau = shear2 e + pressure.
  static GRANULAW_MEMBER void put_stress(Block& block, int p, const Gradient h, const Strain& e, Real shear2,
                                         Real pressure, Real /*volume*/)
  {
    constexpr Real one = 1;
    const Real frr = one + h.rr, fzz = one + h.zz, fhh = one + h.hh;
    const Real per_det = one / (frr * fzz - h.rz * h.zr), per_fhh = one / fhh;
    const Real t1 = shear2 * e.s1 + pressure, t2 = shear2 * e.s2 + pressure, t3 = shear2 * e.s3 + pressure;
    const Real tm = Real(0.5) * (t1 + t2), td = Real(0.5) * (t1 - t2);
    const Real trr = tm + td * e.cosine, tzz = tm - td * e.cosine, trz = td * e.sine;
    block.prr[p] = (trr * fzz - trz * h.rz) * per_det, block.prz[p] = (trz * frr - trr * h.zr) * per_det;
    block.pzr[p] = (trz * fzz - tzz * h.rz) * per_det, block.pzz[p] = (tzz * frr - trz * h.zr) * per_det;
    block.phh[p] = t3 * per_fhh;
  }
};

}  // namespace granulaw::kernel
