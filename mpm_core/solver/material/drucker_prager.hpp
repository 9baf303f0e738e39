#pragma once

#include "solver/material/parameter.hpp"
#include "solver/material/flow_trials.hpp"

namespace granulaw::flow {

/// Drucker and Prager (1952), the cone through the compressive meridian of Mohr and Coulomb's:
///
///     q <= J d + t p,    d = (1 - t/3) sigma_y(ep),    t = 6 sin(f)/(3 - sin f),    dilation s ep,  s alike
///
/// p: pressure, f: friction angle, s: of the dilatancy angle. sigma_y is the flow stress in uniaxial
/// compression, ep the equivalent plastic shear. Friction 0 is von Mises.
///
/// On the flank q - t p falls by 3 G + K t s per unit of ep: the scalar equation of von Mises. Where that
/// flow is more than takes all shear away, the stress returns to the apex p = -J d/t.
struct DruckerPrager
{
  static constexpr const char* name = "drucker-prager";
  static constexpr Parameter parameters[] = {{"friction_angle", Quantity::angle, 0, 75},
                                             {"dilatancy_angle", Quantity::angle, 0, 75}};

  double friction, dilatancy;  ///< t, s

  static const char* misuse(const double* v)
  {
    return v[1] > v[0] ? "'dilatancy_angle' is larger than 'friction_angle': the flow would create energy"
                       : nullptr;
  }
  /// Surface from the angles' sines, as flow_of() leaves them.
  static GRANULAW_MEMBER DruckerPrager from(const double* v) { return {slope(v[0]), slope(v[1])}; }
  GRANULAW_MEMBER bool dilates() const { return friction > 0.0; }
  template <class Real>
  GRANULAW_MEMBER bool find(kernel::FlowTrials<Real>& trials, int count, const Real* plastic_strain,
                            const Moduli& m, double shear, double bulk,
                            const kernel::FlowStress<Real>& flow_stress, double per_dt) const
  {
    const double scale = 1.0 - friction / 3.0, shear3 = 3.0 * shear;
    const Real t = Real(friction), s = Real(dilatancy), k = Real(bulk);
#pragma omp simd
    for (int p = 0; p < count; ++p) trials.trial[p] = trials.q[p] + t * k * trials.trace[p];
    if (!flow_stress.find(trials, trials.trial, count, plastic_strain, m, scale,
                          shear3 + bulk * friction * dilatancy, per_dt))
      return false;
    int beyond = 0;
#pragma omp simd reduction(+ : beyond)
    for (int p = 0; p < count; ++p) {
      const Real flank = trials.strain[p];
      beyond += Real(shear3) * flank > trials.q[p] ? 1 : 0;
      trials.dilation[p] = s * flank;
      trials.stress[p] -= t * k * (trials.trace[p] - s * flank);
    }
    if (beyond == 0 || friction == 0.0) return true;
    for (int p = 0; p < count; ++p) {
      if (!(Real(shear3) * trials.strain[p] > trials.q[p])) continue;
      const double all = double(trials.q[p]) / shear3;
      const double tension = double(trials.jacobian[p]) * scale *
                             flow_stress.at(m, double(plastic_strain[p]) + all, all * per_dt) / friction;
      trials.strain[p] = Real(all), trials.stress[p] = Real(0);
      trials.dilation[p] = trials.trace[p] - Real(tension / bulk);
    }
    return true;
  }

 private:
  /// 6 sin(a)/(3 - sin a)
  static GRANULAW_MEMBER double slope(double sine)
  {
    return 6.0 * sine / (3.0 - sine);
  }
};

}  // namespace granulaw::flow
