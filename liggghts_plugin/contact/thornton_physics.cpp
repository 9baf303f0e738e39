#include "liggghts_plugin/contact/thornton_physics.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"
#include "base/number_in.hpp"
#include "base/scales.hpp"
#include "law/law.hpp"
#include "liggghts_plugin/deck/session.hpp"
#include "liggghts_plugin/engine/liggghts.hpp"

namespace granulaw::plugin {

namespace {

VectorProperty* create_yield_stress(PropertyRegistry& registry, const char* caller, bool)
{
  return MODEL_PARAMS::createPerTypeProperty(registry, "yieldStress", caller);
}

}  // namespace

double yield_pressure_of(const Options& options)
{
  const auto& words = options.own_words("yieldPressure");
  return words.empty() ? customary_yield_pressure : number_in(words[0]).value();
}

void ThorntonPhysics::prepare(LAMMPS_NS::LAMMPS*, PropertyRegistry& registry, const Setup& setup,
                              const Types& types)
{
  registry.registerProperty("yieldStress", &create_yield_stress);
  const double* yield_stress = registry.getVectorProperty("yieldStress", setup.where.c_str())->data;
  e_star_.assign(static_cast<std::size_t>(types.count + 1), 0.0);
  yield_stress_ = e_star_;
  stretch_ = setup.options.stretch.value_or(1.0);
  factor_ = yield_pressure_of(setup.options);
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

Thornton ThorntonPhysics::resolve(int i, int j, bool rigid, const std::string&) const
{
  if (rigid) return {e_star_[i], factor_ * yield_stress_[i], stretch_};
  return {1.0 / (1.0 / e_star_[i] + 1.0 / e_star_[j]), factor_ * std::min(yield_stress_[i], yield_stress_[j]), stretch_};
}

PairInfo ThorntonPhysics::describe(const Contact& contact, const PairKey& key) const
{
  PairInfo info{.a = "-",
                .b = key.kind == PairKey::rigid_wall ? wall_name : "-",
                .law = name,
                .kind = "closed form",
                .note = fmt::format("p_y = {:g} Y, error bound not stated", factor_)};
  info.stiffness_ratio = factor_ * contact.e_star / contact.yield_pressure;
  info.overlap_limit = std::numeric_limits<double>::infinity();
  return info;
}

}  // namespace granulaw::plugin
