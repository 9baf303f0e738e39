#pragma once

#include "solver/material/stress_update.hpp"

// Symmetric tensors of three dimensions, and deformation and stress of points without principal axes, for
// loops over material points that vectorise. As with the flow laws, every function must be always_inline
// (material/parameter.hpp).

namespace granulaw::kernel {

/// A symmetric tensor.
template <class Real>
struct Symmetric
{
  Real xx, yy, zz, xy, xz, yz;
};

template <class Real>
GRANULAW_INLINE Real trace_of(const Symmetric<Real>& a)
{
  return a.xx + a.yy + a.zz;
}
template <class Real>
GRANULAW_INLINE Real determinant_of(const Symmetric<Real>& a)
{
  return a.xx * (a.yy * a.zz - a.yz * a.yz) - a.xy * (a.xy * a.zz - a.yz * a.xz) +
         a.xz * (a.xy * a.yz - a.yy * a.xz);
}
/// a : a
template <class Real>
GRANULAW_INLINE Real square_of(const Symmetric<Real>& a)
{
  return a.xx * a.xx + a.yy * a.yy + a.zz * a.zz + Real(2) * (a.xy * a.xy + a.xz * a.xz + a.yz * a.yz);
}
/// a b of two tensors that commute.
template <class Real>
GRANULAW_INLINE Symmetric<Real> product(const Symmetric<Real>& a, const Symmetric<Real>& b)
{
  return {a.xx * b.xx + a.xy * b.xy + a.xz * b.xz, a.xy * b.xy + a.yy * b.yy + a.yz * b.yz,
          a.xz * b.xz + a.yz * b.yz + a.zz * b.zz, a.xx * b.xy + a.xy * b.yy + a.xz * b.yz,
          a.xx * b.xz + a.xy * b.yz + a.xz * b.zz, a.xy * b.xz + a.yy * b.yz + a.yz * b.zz};
}
/// p 1 + q a + r b
template <class Real>
GRANULAW_INLINE Symmetric<Real> combination(Real p, Real q, const Symmetric<Real>& a, Real r,
                                            const Symmetric<Real>& b)
{
  return {p + q * a.xx + r * b.xx, p + q * a.yy + r * b.yy, p + q * a.zz + r * b.zz,
          q * a.xy + r * b.xy,     q * a.xz + r * b.xz,     q * a.yz + r * b.yz};
}

/// Logarithmic strain e = ln(b)/2 of a positive b: its deviator and its trace.
template <class Real>
struct LogarithmicStrain
{
  Symmetric<Real> deviator;
  Real trace;
};

/// Logarithm ln(b)/2 of b = 1 + x. With m = 1 + tr(x)/3 and d the deviator of x, b = m + d:
///
///     ln(b)/2 = ln(m)/2 + artanh(s),    s = d (d + 2 m)^-1 = (I3 + w^2 d - w d^2)/(w^3 + w I2 + I3),  w = 2
///     m,
///
/// I2, I3 the invariants of d (Cayley-Hamilton: d^3 + I2 d - I3 = 0). The series of artanh(s)/s in s^2 is
/// summed in the basis 1, s^2, s^4 by the characteristic polynomial of s^2. Its eight terms leave 1e-18 of it
/// at deviatoric strains of 0.1, 1e-11 at 0.27, 1e-8 at 0.4; no principal axes are needed, and small strains
/// are exact to rounding.
template <class Real>
GRANULAW_INLINE LogarithmicStrain<Real> logarithmic_strain(const Symmetric<Real>& x)
{
  const Real mean = trace_of(x) * (Real(1) / Real(3));
  const Symmetric<Real> d{x.xx - mean, x.yy - mean, x.zz - mean, x.xy, x.xz, x.yz};
  const Symmetric<Real> d2 = product(d, d);
  const Real second = -Real(0.5) * trace_of(d2), third = determinant_of(d), w = Real(2) + Real(2) * mean;
  const Real per = Real(1) / (w * (w * w + second) + third);
  const Symmetric<Real> s = combination(third * per, w * w * per, d, -w * per, d2);
  const Symmetric<Real> z = product(s, s);
  const Real j1 = trace_of(s), j2 = Real(0.5) * (j1 * j1 - trace_of(z)), j3 = determinant_of(s);
  const Real k1 = j1 * j1 - Real(2) * j2, k2 = j2 * j2 - Real(2) * j1 * j3,
             k3 = j3 * j3;  // invariants of s^2
  Real p = Real(1) / Real(15), q = Real(0), r = Real(0);
#pragma GCC unroll 7
  for (int n = 6; n >= 0; --n) {
    const Real pn = Real(1) / (Real(2 * n + 1)) + r * k3, qn = p - r * k2, rn = q + r * k1;
    p = pn, q = qn, r = rn;
  }
  // artanh(s) = p s + q s^3 + r s^5, and s^3 = j3 - j2 s + j1 s^2
  const Real one = q * j3 + r * (j1 * j1 * j3 - j2 * j3);
  const Real first = p - q * j2 + r * (j1 * j3 - j1 * j1 * j2 + j2 * j2);
  const Real square = q * j1 + r * (j1 * j1 * j1 - Real(2) * j1 * j2 + j3);
  const Symmetric<Real> g = combination(one, first, s, square, z);
  const Real trace = trace_of(g), part = trace * (Real(1) / Real(3));
  return {{g.xx - part, g.yy - part, g.zz - part, g.xy, g.xz, g.yz}, Real(1.5) * log_1p(mean) + trace};
}

/// exp(a) - 1 of a small tensor without trace, such as one time step's plastic flow; eight terms.
template <class Real>
GRANULAW_INLINE Symmetric<Real> exponential_m1(const Symmetric<Real>& a)
{
  const Symmetric<Real> square = product(a, a);
  const Real second = -Real(0.5) * trace_of(square), third = determinant_of(a);
  // sum of a^n/(n + 1)! in the basis 1, a, a^2, with a^3 = third - second a
  constexpr Real per_factorial[] = {Real(1),       Real(1) / 2,   Real(1) / 6,   Real(1) / 24,
                                    Real(1) / 120, Real(1) / 720, Real(1) / 5040};
  Real p = Real(1) / 40320, q = Real(0), r = Real(0);
#pragma GCC unroll 7
  for (int n = 6; n >= 0; --n) {
    const Real pn = per_factorial[n] + r * third, qn = p - r * second, rn = q;
    p = pn, q = qn, r = rn;
  }
  return combination(r * third, p - r * second, a, q, square);
}

/// F = 1 + h, its adjugate F^-1 det F, and its determinant.
template <class Real>
struct Deformation
{
  Real f[3][3], adjugate[3][3], determinant;
};

/// a s a^T
template <class Real>
GRANULAW_INLINE Symmetric<Real> pushed(const Real (&a)[3][3], const Symmetric<Real>& s)
{
  Real t[3][3];
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    t[i][0] = a[i][0] * s.xx + a[i][1] * s.xy + a[i][2] * s.xz;
    t[i][1] = a[i][0] * s.xy + a[i][1] * s.yy + a[i][2] * s.yz;
    t[i][2] = a[i][0] * s.xz + a[i][1] * s.yz + a[i][2] * s.zz;
  }
  const auto entry = [&](int i, int j) __attribute__((always_inline))
  {
    return t[i][0] * a[j][0] + t[i][1] * a[j][1] + t[i][2] * a[j][2];
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)};
}

/// The dimension of update_stress (stress_update.hpp): x, y and z.
template <class Real>
struct Spatial
{
  using Number = Real;
  static constexpr int components = 6;  ///< of the plastic state: xx yy zz xy xz yz
  static constexpr int kept = 12;       ///< numbers of a trial strain

  struct alignas(64) Block
  {
    /// [3 i + j]: component i, derivative by x_j. Displacement gradient, F = 1 + h; after the stress update
    /// first Piola-Kirchhoff stress times volume.
    Real h[9][block_points];
  };
  struct Gradient
  {
    Real h[3][3];
    Deformation<Real> d;
  };
  using Symmetric = kernel::Symmetric<Real>;
  using Strain = LogarithmicStrain<Real>;

  static GRANULAW_MEMBER Deformation<Real> deformation(const Block& block, int p)
  {
    Deformation<Real> d;
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
      for (int j = 0; j < 3; ++j) d.f[i][j] = block.h[3 * i + j][p] + (i == j ? Real(1) : Real(0));
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
      for (int j = 0; j < 3; ++j) {
        const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, e = (j + 2) % 3;
        d.adjugate[j][i] = d.f[a][c] * d.f[b][e] - d.f[a][e] * d.f[b][c];
      }
    d.determinant =
        d.f[0][0] * d.adjugate[0][0] + d.f[0][1] * d.adjugate[1][0] + d.f[0][2] * d.adjugate[2][0];
    return d;
  }
  static GRANULAW_MEMBER Gradient gradient(const Block& block, int p)
  {
    Gradient g;
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
      for (int j = 0; j < 3; ++j) g.h[i][j] = block.h[3 * i + j][p];
    g.d = deformation(block, p);
    return g;
  }
  /// det F
  static GRANULAW_MEMBER Real determinant(const Gradient& g)
  {
    return g.d.determinant;
  }
  /// F F^T - 1 = h + h^T + h h^T
  static GRANULAW_MEMBER Symmetric stretched(const Gradient& g)
  {
    const auto entry = [&](int i, int j) __attribute__((always_inline))
    {
      return g.h[i][j] + g.h[j][i] + g.h[i][0] * g.h[j][0] + g.h[i][1] * g.h[j][1] + g.h[i][2] * g.h[j][2];
    };
    return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)};
  }
  /// x += F c F^T
  static GRANULAW_MEMBER void add_pushed(Symmetric& x, const Gradient& g, const Symmetric& c)
  {
    const Symmetric y = pushed(g.d.f, c);
    x.xx += y.xx, x.yy += y.yy, x.zz += y.zz, x.xy += y.xy, x.xz += y.xz, x.yz += y.yz;
  }
  /// Logarithmic strain of 1 + x.
  static GRANULAW_MEMBER Strain logarithm(const Symmetric& x)
  {
    return logarithmic_strain(x);
  }
  /// Deviator : deviator.
  static GRANULAW_MEMBER Real square(const Strain& e)
  {
    return square_of(e.deviator);
  }
  /// The deviator less `share` of it.
  static GRANULAW_MEMBER void shrink(Strain& e, Real share)
  {
    const Real keep = Real(1) - share;
    Symmetric& d = e.deviator;
    d.xx *= keep, d.yy *= keep, d.zz *= keep, d.xy *= keep, d.xz *= keep, d.yz *= keep;
  }

  template <bool flows>
  static GRANULAW_MEMBER void put(Real (&to)[kept][block_points], int p, const Symmetric& x, const Strain& e)
  {
    const Symmetric& d = e.deviator;
    to[0][p] = d.xx, to[1][p] = d.yy, to[2][p] = d.zz, to[3][p] = d.xy, to[4][p] = d.xz, to[5][p] = d.yz;
    if constexpr (flows)
      to[6][p] = x.xx, to[7][p] = x.yy, to[8][p] = x.zz, to[9][p] = x.xy, to[10][p] = x.xz, to[11][p] = x.yz;
  }
  static GRANULAW_MEMBER Strain strain(const Real (&from)[kept][block_points], int p, Real trace)
  {
    return {{from[0][p], from[1][p], from[2][p], from[3][p], from[4][p], from[5][p]}, trace};
  }

  static GRANULAW_MEMBER Symmetric state(Real* const __restrict (&c)[components], int p)
  {
    return {c[0][p], c[1][p], c[2][p], c[3][p], c[4][p], c[5][p]};
  }
  /// c += F^-1 [b (exp(by e + volume) - 1)] F^-T: the plastic state after the flow from the trial strain e.
  template <bool dilates>
  static GRANULAW_MEMBER void add_pulled_back_flow(Real* const __restrict (&c)[components], int p,
                                                   const Real (&trial)[kept][block_points], const Gradient& g,
                                                   const Strain& strain, Real by,
                                                   [[maybe_unused]] Real volume)
  {
    const Symmetric& e = strain.deviator;
    Symmetric change =
        exponential_m1<Real>({by * e.xx, by * e.yy, by * e.zz, by * e.xy, by * e.xz, by * e.yz});
    if constexpr (dilates) {
      const Real more = exp_m1(volume), all = Real(1) + more;
      change = {all * change.xx + more, all * change.yy + more, all * change.zz + more,
                all * change.xy,        all * change.xz,        all * change.yz};
    }
    const Symmetric b{trial[6][p] + Real(1), trial[7][p] + Real(1), trial[8][p] + Real(1),
                      trial[9][p],           trial[10][p],          trial[11][p]};
    const Symmetric d = pushed(g.d.adjugate, product(b, change));
    const Real per_det = Real(1) / g.d.determinant, per_det2 = per_det * per_det;
    c[0][p] += per_det2 * d.xx, c[1][p] += per_det2 * d.yy, c[2][p] += per_det2 * d.zz;
    c[3][p] += per_det2 * d.xy, c[4][p] += per_det2 * d.xz, c[5][p] += per_det2 * d.yz;
  }
  /// tau/J of tau = shear2 e + pressure.
  static GRANULAW_MEMBER CauchyStress cauchy_stress(const Gradient& g, const Strain& strain, Real shear2,
                                                    Real pressure)
  {
    const Symmetric& e = strain.deviator;
    const Real per_j = Real(1) / g.d.determinant, s = shear2 * per_j, p = pressure * per_j;
    return {s * e.xx + p, s * e.yy + p, s * e.zz + p, s * e.xy, s * e.xz, s * e.yz};
  }
  /// First Piola-Kirchhoff stress P = tau F^-T of tau = shear2 e + pressure, times volume.
  static GRANULAW_MEMBER void put_stress(Block& block, int p, const Gradient& g, const Strain& strain,
                                         Real shear2, Real pressure, Real volume)
  {
    const Symmetric& e = strain.deviator;
    const Real per_det = Real(1) / g.d.determinant, scale = volume * per_det;
    const Real tau[3][3] = {{shear2 * e.xx + pressure, shear2 * e.xy, shear2 * e.xz},
                            {shear2 * e.xy, shear2 * e.yy + pressure, shear2 * e.yz},
                            {shear2 * e.xz, shear2 * e.yz, shear2 * e.zz + pressure}};
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
      for (int j = 0; j < 3; ++j)
        block.h[3 * i + j][p] = scale * (tau[i][0] * g.d.adjugate[j][0] + tau[i][1] * g.d.adjugate[j][1] +
                                         tau[i][2] * g.d.adjugate[j][2]);
  }
};

}  // namespace granulaw::kernel
