#include "liggghts_plugin/thornton_physics.hpp"

#include "base/scales.hpp"

namespace granulaw::plugin {

namespace {

VectorProperty* create_yield_stress(PropertyRegistry& registry, const char* caller, bool)
{
  return MODEL_PARAMS::createPerTypeProperty(registry, "yieldStress", caller);
}

}  // namespace

double ThorntonContact::dissipated(double r_eff, double delta_max) const
{
  const double d_y = law.yield_overlap(r_eff);
  if (delta_max <= d_y) return 0.0;
  const double hertz = 4.0 / 3.0 * law.e_star, f_y = hertz * std::sqrt(r_eff * d_y) * d_y;
  const double k_p = M_PI * law.yield_pressure * r_eff, plastic = delta_max - d_y;
  const double f_m = f_y + k_p * plastic;
  const double loading = 0.4 * f_y * d_y + plastic * (f_y + 0.5 * k_p * plastic);
  // unloading: 2/5 F_m (d_m - d_p) with d_m - d_p = 3 F_m/(4 E* sqrt A), A = (2 F_m + F_y)/(2 pi p_y)
  const double area = (2.0 * f_m + f_y) / (2.0 * M_PI * law.yield_pressure);
  return loading - 0.4 * f_m * f_m / (hertz * std::sqrt(area));
}

void ThorntonPhysics::prepare(LAMMPS_NS::LAMMPS*, PropertyRegistry& registry, const Setup& setup,
                              const Types& types)
{
  registry.registerProperty("yieldStress", &create_yield_stress);
  const double* yield_stress = registry.getVectorProperty("yieldStress", setup.where.c_str())->data;
  e_star_.assign(static_cast<std::size_t>(types.count + 1), 0.0);
  yield_stress_ = e_star_;
  per_stretch_ = 1.0 / setup.options.stretch.value_or(1.0);
  for (int t = 1; t <= types.count; ++t) {
    if (std::isnan(types.youngs_modulus[t])) continue;
    if (!(yield_stress[t] > 0))
      fail(setup.where, fmt::format("yieldStress of type {} is out of range", t),
           fmt::format("{:.6g} Pa", yield_stress[t] * types.units.pressure()), "over 0");
    e_star_[t] =
        plane_strain_modulus(types.youngs_modulus[t], types.poisson_ratio[t]) / types.units.pressure();
    yield_stress_[t] = yield_stress[t];
  }
}

ThorntonContact ThorntonPhysics::resolve(int i, int j, bool rigid, const std::string&) const
{
  if (rigid) return {ThorntonPair{e_star_[i], 1.6 * yield_stress_[i]}, per_stretch_};
  return {ThorntonPair{1.0 / (1.0 / e_star_[i] + 1.0 / e_star_[j]),
                       1.6 * std::min(yield_stress_[i], yield_stress_[j])},
          per_stretch_};
}

}  // namespace granulaw::plugin
