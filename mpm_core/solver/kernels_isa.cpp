// Compiled once for each instruction set (CMakeLists.txt), with GRANULAW_ISA_NAMESPACE and GRANULAW_ISA_NAME
// set. Nothing here may come from a shared inline function: the linker would pick one copy for all sets.
// Hence raw pointers and compiler built-ins only.
#include <type_traits>

#include "solver/flow/laws.hpp"
#include "solver/kernels.hpp"

namespace granulaw::GRANULAW_ISA_NAMESPACE {

namespace {

/// ln(1 + x) for 1 + x between about 0.2 and 5, relative error below 1e-11 there and 1e-16 for |x| < 0.3:
/// ln(1+x) = 2 ln sqrt(1+x) = 4 artanh(s), s = x/(2 + 2 sqrt(1+x) + x). Exact to rounding as x -> 0.
GRANULAW_INLINE double log_1p(double x)
{
  const double root = __builtin_sqrt(1.0 + x);
  const double s = x / (2.0 + 2.0 * root + x), q = s * s;
  double sum = 1.0 / 21.0;
  sum = sum * q + 1.0 / 19.0;
  sum = sum * q + 1.0 / 17.0;
  sum = sum * q + 1.0 / 15.0;
  sum = sum * q + 1.0 / 13.0;
  sum = sum * q + 1.0 / 11.0;
  sum = sum * q + 1.0 / 9.0;
  sum = sum * q + 1.0 / 7.0;
  sum = sum * q + 1.0 / 5.0;
  sum = sum * q + 1.0 / 3.0;
  sum = sum * q + 1.0;
  return 4.0 * s * sum;
}

/// exp(t) - 1 for the small t of one time step's plastic flow; relative error 1e-16 at |t| = 0.05, 5e-11 at
/// 0.3.
GRANULAW_INLINE double exp_m1(double t)
{
  double sum = 1.0 / 362880.0;
  sum = sum * t + 1.0 / 40320.0;
  sum = sum * t + 1.0 / 5040.0;
  sum = sum * t + 1.0 / 720.0;
  sum = sum * t + 1.0 / 120.0;
  sum = sum * t + 1.0 / 24.0;
  sum = sum * t + 1.0 / 6.0;
  sum = sum * t + 0.5;
  sum = sum * t + 1.0;
  return t * sum;
}

/// Hardening law of a body that does not yield.
struct Elastic
{
};

/// Stress update and corner forces of every material point.
///
/// Multiplicative J2 plasticity with logarithmic elastic strain: trial b = F Cp^-1 F^T, its principal
/// logarithmic strains, radial return, first Piola-Kirchhoff stress P = tau F^-T. Yield is on the Cauchy
/// stress sigma = tau/J: q(tau) <= J sigma_y. Everything is kept as difference from the identity.
/// Perfect and linear hardening have their return in closed form; other flow laws take plastic_increment.hpp.
template <class Hardening, class Rate, bool frozen>
GRANULAW_INLINE void stress_and_corner_forces(Body& body, [[maybe_unused]] const Hardening hardening_law,
                                              [[maybe_unused]] const Rate rate_law)
{
  constexpr bool yields = !std::is_same_v<Hardening, Elastic>;
  constexpr bool closed_form =
      std::is_same_v<Hardening, flow::Linear> && std::is_same_v<Rate, flow::RateIndependent>;
  [[maybe_unused]] const double per_dt = body.elapsed > 0.0 ? 1.0 / body.elapsed : 0.0;
  const int count = body.points, n = count;
  const double shear2 = 2.0 * body.moduli.shear, bulk = body.moduli.bulk;
  const double yield = body.moduli.yield, hardening = body.moduli.hardening;
  const int* __restrict corner = body.corner_p.data();
  const double* __restrict br = body.br_p.data();
  const double* __restrict bz = body.bz_p.data();
  const double* __restrict bh = body.bh_p.data();
  const double* __restrict gamma = body.hourglass_p.data();
  const double* __restrict volume = body.volume_p.data();
  const double* __restrict stiffness = body.stiffness_p.data();
  const double* __restrict ur = body.ur_i.data();
  const double* __restrict uz = body.uz_i.data();
  double* __restrict crr = body.crr_p.data();
  double* __restrict czz = body.czz_p.data();
  double* __restrict crz = body.crz_p.data();
  double* __restrict chh = body.chh_p.data();
  double* __restrict plastic_strain = body.plastic_strain_p.data();
  double* __restrict plastic_work = body.plastic_work_p.data();
  double* __restrict energy = body.elastic_energy_p.data();
  double* __restrict corner_fr = body.corner_fr.data();
  double* __restrict corner_fz = body.corner_fz.data();
  constexpr double tiny = 1e-300;

#pragma omp simd
  for (int p = 0; p < count; ++p) {
    const int n0 = corner[p], n1 = corner[n + p], n2 = corner[2 * n + p], n3 = corner[3 * n + p];
    const double r0 = ur[n0], r1 = ur[n1], r2 = ur[n2], r3 = ur[n3];
    const double z0 = uz[n0], z1 = uz[n1], z2 = uz[n2], z3 = uz[n3];
    const double br0 = br[p], br1 = br[n + p], br2 = br[2 * n + p], br3 = br[3 * n + p];
    const double bz0 = bz[p], bz1 = bz[n + p], bz2 = bz[2 * n + p], bz3 = bz[3 * n + p];
    const double bh0 = bh[p], bh1 = bh[n + p], bh2 = bh[2 * n + p], bh3 = bh[3 * n + p];

    // displacement gradient, F = 1 + h
    const double hrr = br0 * r0 + br1 * r1 + br2 * r2 + br3 * r3;
    const double hrz = bz0 * r0 + bz1 * r1 + bz2 * r2 + bz3 * r3;
    const double hzr = br0 * z0 + br1 * z1 + br2 * z2 + br3 * z3;
    const double hzz = bz0 * z0 + bz1 * z1 + bz2 * z2 + bz3 * z3;
    const double hhh = bh0 * r0 + bh1 * r1 + bh2 * r2 + bh3 * r3;
    const double frr = 1.0 + hrr, fzz = 1.0 + hzz, fhh = 1.0 + hhh;
    const double det = frr * fzz - hrz * hzr;
    const double per_det = 1.0 / det, per_fhh = 1.0 / fhh;

    // trial elastic left Cauchy-Green tensor minus identity
    double xrr = 2.0 * hrr + hrr * hrr + hrz * hrz;
    double xzz = 2.0 * hzz + hzz * hzz + hzr * hzr;
    double xrz = hrz + hzr + hrr * hzr + hrz * hzz;
    double xhh = 2.0 * hhh + hhh * hhh;
    if constexpr (yields) {
      const double c11 = crr[p], c22 = czz[p], c12 = crz[p];
      const double g11 = frr * c11 + hrz * c12, g12 = frr * c12 + hrz * c22;
      const double g21 = hzr * c11 + fzz * c12, g22 = hzr * c12 + fzz * c22;
      xrr += g11 * frr + g12 * hrz;
      xrz += g11 * hzr + g12 * fzz;
      xzz += g21 * hzr + g22 * fzz;
      xhh += fhh * fhh * chh[p];
    }

    // principal logarithmic strains; (cosine, sine) of twice the principal angle
    const double mean = 0.5 * (xrr + xzz), half = 0.5 * (xrr - xzz);
    const double radius = __builtin_sqrt(half * half + xrz * xrz);
    const double per_radius = 1.0 / (radius + tiny);
    const double cosine = half * per_radius, sine = xrz * per_radius;
    const double x1 = mean + radius, x2 = mean - radius;
    const double e1 = 0.5 * log_1p(x1), e2 = 0.5 * log_1p(x2), e3 = 0.5 * log_1p(xhh);
    const double trace = e1 + e2 + e3, third = trace * (1.0 / 3.0);
    double s1 = e1 - third, s2 = e2 - third, s3 = e3 - third;

    if constexpr (yields) {
      const double jacobian = det * fhh;
      const double q = shear2 * __builtin_sqrt(1.5 * (s1 * s1 + s2 * s2 + s3 * s3));
      double step, mean_flow;
      if constexpr (closed_form) {
        // radial return: q - 3 G dg = J (sigma_y + H dg)
        const double flow = yield + hardening * plastic_strain[p];
        const double over = q - jacobian * flow;
        step = over > 0.0 ? over / (1.5 * shear2 + jacobian * hardening) : 0.0;
        mean_flow = jacobian * (flow + 0.5 * hardening * step);
      } else {
        const double start = jacobian * hardening_law(plastic_strain[p]).value;
        const flow::PlasticIncrement increment = flow::plastic_increment(
            hardening_law, rate_law, q, jacobian, 1.5 * shear2, plastic_strain[p], per_dt);
        step = q > start ? increment.strain : 0.0;
        mean_flow = 0.5 * (start * increment.factor + q - 1.5 * shear2 * step);
      }
      const double shrink = 1.5 * shear2 * step / (q + tiny);
      if constexpr (!frozen) {
        // plastic state: b_new - b_trial carried back through F
        const double d1 = (1.0 + x1) * exp_m1(-2.0 * shrink * s1);
        const double d2 = (1.0 + x2) * exp_m1(-2.0 * shrink * s2);
        const double d3 = (1.0 + xhh) * exp_m1(-2.0 * shrink * s3);
        const double dm = 0.5 * (d1 + d2), dd = 0.5 * (d1 - d2);
        const double drr = dm + dd * cosine, dzz = dm - dd * cosine, drz = dd * sine;
        const double g11 = fzz * drr - hrz * drz, g12 = fzz * drz - hrz * dzz;
        const double g21 = -hzr * drr + frr * drz, g22 = -hzr * drz + frr * dzz;
        const double per_det2 = per_det * per_det;
        crr[p] += per_det2 * (g11 * fzz - g12 * hrz);
        crz[p] += per_det2 * (-g11 * hzr + g12 * frr);
        czz[p] += per_det2 * (-g21 * hzr + g22 * frr);
        chh[p] += per_fhh * per_fhh * d3;
        plastic_strain[p] += step;
        plastic_work[p] += volume[p] * mean_flow * step;
      }
      s1 -= shrink * s1, s2 -= shrink * s2, s3 -= shrink * s3;
    }

    // Kirchhoff stress, then P = tau F^-T
    const double pressure = bulk * trace;
    const double t1 = shear2 * s1 + pressure, t2 = shear2 * s2 + pressure, t3 = shear2 * s3 + pressure;
    const double tm = 0.5 * (t1 + t2), td = 0.5 * (t1 - t2);
    const double trr = tm + td * cosine, tzz = tm - td * cosine, trz = td * sine;
    const double prr = (trr * fzz - trz * hrz) * per_det, prz = (trz * frr - trr * hzr) * per_det;
    const double pzr = (trz * fzz - tzz * hrz) * per_det, pzz = (tzz * frr - trz * hzr) * per_det;
    const double phh = t3 * per_fhh;

    // hourglass control in total form: acts on the non-linear part of the displacement only
    const double y0 = gamma[p], y1 = gamma[n + p], y2 = gamma[2 * n + p], y3 = gamma[3 * n + p];
    const double qr = y0 * r0 + y1 * r1 + y2 * r2 + y3 * r3;
    const double qz = y0 * z0 + y1 * z1 + y2 * z2 + y3 * z3;
    const double kr = stiffness[p] * qr, kz = stiffness[p] * qz;

    const double v = volume[p];
    energy[p] = v * (0.5 * shear2 * (s1 * s1 + s2 * s2 + s3 * s3) + 0.5 * bulk * trace * trace) +
                0.5 * (kr * qr + kz * qz);
    corner_fr[p] = -v * (prr * br0 + prz * bz0 + phh * bh0) - kr * y0;
    corner_fr[n + p] = -v * (prr * br1 + prz * bz1 + phh * bh1) - kr * y1;
    corner_fr[2 * n + p] = -v * (prr * br2 + prz * bz2 + phh * bh2) - kr * y2;
    corner_fr[3 * n + p] = -v * (prr * br3 + prz * bz3 + phh * bh3) - kr * y3;
    corner_fz[p] = -v * (pzr * br0 + pzz * bz0) - kz * y0;
    corner_fz[n + p] = -v * (pzr * br1 + pzz * bz1) - kz * y1;
    corner_fz[2 * n + p] = -v * (pzr * br2 + pzz * bz2) - kz * y2;
    corner_fz[3 * n + p] = -v * (pzr * br3 + pzz * bz3) - kz * y3;
  }
}

GRANULAW_INLINE void sum_to_nodes(Body& body)
{
  const int nodes = body.nodes;
  const int* __restrict slot = body.node_slots.data();
  const double* __restrict corner_fr = body.corner_fr.data();
  const double* __restrict corner_fz = body.corner_fz.data();
  double* __restrict fr = body.fr_i.data();
  double* __restrict fz = body.fz_i.data();
#pragma omp simd
  for (int i = 0; i < nodes; ++i) {
    const int a = slot[i], b = slot[nodes + i], c = slot[2 * nodes + i], d = slot[3 * nodes + i];
    fr[i] = (corner_fr[a] + corner_fr[b]) + (corner_fr[c] + corner_fr[d]);
    fz[i] = (corner_fz[a] + corner_fz[b]) + (corner_fz[c] + corner_fz[d]);
  }
}

// One copy of the loop for each pair of a hardening and a rate law.
template <class Hardening, class Rate>
__attribute__((noinline)) void update(Body& body)
{
  const flow::Flow& laws = body.moduli.flow;
  stress_and_corner_forces<Hardening, Rate, false>(
      body, Hardening::from(body.moduli.yield, laws.hardening_values), Rate::from(laws.rate_values));
}

template <class Rate, class... Hardening>
void with_hardening(Body& body, flow::LawList<Hardening...>)
{
  int k = 0;
  ((k++ == body.moduli.flow.hardening ? update<Hardening, Rate>(body) : void()), ...);
}

template <class... Rate>
void with_rate(Body& body, flow::LawList<Rate...>)
{
  int k = 0;
  ((k++ == body.moduli.flow.rate ? with_hardening<Rate>(body, flow::HardeningLaws{}) : void()), ...);
}

void internal_force(Body& body, bool frozen)
{
  constexpr flow::Linear linear{};
  constexpr flow::RateIndependent no_rate{};
  if (!body.moduli.yields) {
    stress_and_corner_forces<Elastic, flow::RateIndependent, true>(body, {}, no_rate);
  } else if (frozen) {
    stress_and_corner_forces<flow::Linear, flow::RateIndependent, true>(body, linear, no_rate);
  } else if (body.moduli.flow.hardening == 0 && body.moduli.flow.rate == 0) {
    stress_and_corner_forces<flow::Linear, flow::RateIndependent, false>(body, linear, no_rate);
  } else {
    with_rate(body, flow::RateLaws{});
  }
  if (!frozen) body.elapsed = 0.0;
  sum_to_nodes(body);
}

void accelerate(Body& body, double dt)
{
  const int nodes = body.nodes;
  const double* __restrict w = body.inverse_mass_i.data();
  const double* __restrict fr = body.fr_i.data();
  const double* __restrict fz = body.fz_i.data();
  double* __restrict vr = body.vr_i.data();
  double* __restrict vz = body.vz_i.data();
#pragma omp simd
  for (int i = 0; i < nodes; ++i) {
    vr[i] += dt * w[i] * fr[i];
    vz[i] += dt * w[i] * fz[i];
  }
}

void move(Body& body, double dt)
{
  const int nodes = body.nodes;
  const double* __restrict vr = body.vr_i.data();
  const double* __restrict vz = body.vz_i.data();
  double* __restrict ur = body.ur_i.data();
  double* __restrict uz = body.uz_i.data();
#pragma omp simd
  for (int i = 0; i < nodes; ++i) {
    ur[i] += dt * vr[i];
    uz[i] += dt * vz[i];
  }
  body.elapsed += dt;
}

}  // namespace

extern const Kernels kernels{GRANULAW_ISA_NAME, internal_force, accelerate, move};

}  // namespace granulaw::GRANULAW_ISA_NAMESPACE
