#pragma once

#include "solver/kernel_math.hpp"

// Symmetric tensors of three dimensions, for loops over material points that vectorise. As with the flow
// laws, every function must be always_inline (flow/parts.hpp).

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

/// Of b = 1 + x. With m = 1 + tr(x)/3 and d the deviator of x, b = m + d:
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

}  // namespace granulaw::kernel
