// Compiled once for each instruction set, as body/axisymmetric_isa.cpp, under the same rules: the flow stress of every
// hardening law with every rate law, and every yield surface, for all dimensions.
#include "solver/material/laws.hpp"
#include "solver/material/flow_stress.hpp"
#include "solver/material/yielding.hpp"

namespace granulaw::GRANULAW_ISA_NAMESPACE {

namespace {

using namespace flow;
using kernel::FlowStress;
using kernel::FlowTrials;
using kernel::Yielding;

template <class Hardening>
GRANULAW_INLINE Hardening hardening_of(const Moduli& m)
{
  if constexpr (std::is_same_v<Hardening, Linear>)
    return {m.yield, m.hardening};
  else
    return Hardening::from(m.yield, m.flow.hardening_values);
}

template <class Real, class Hardening, class Rate>
bool find(FlowTrials<Real>& trials, const Real* trial, int count, const Real* plastic_strain, const Moduli& m,
          double scale, double stiffness, double per_dt)
{
  return find_flow(trials, trial, count, plastic_strain, scaled(hardening_of<Hardening>(m), scale),
                   Rate::from(m.flow.rate_values), stiffness, per_dt);
}

template <class Hardening, class Rate>
double flow_stress_at(const Moduli& m, double plastic_strain, double rate)
{
  return hardening_of<Hardening>(m)(plastic_strain).value * Rate::from(m.flow.rate_values)(rate).value;
}

template <class Real, class Rate, class... Hardening>
GRANULAW_INLINE void choose_hardening(const Moduli& m, FlowStress<Real>& out, LawList<Hardening...>)
{
  int k = 0;
  ((k++ == m.flow.hardening ? void(out = {find<Real, Hardening, Rate>, flow_stress_at<Hardening, Rate>})
                            : void()),
   ...);
}

template <class Real, class... Rate>
GRANULAW_INLINE void choose_rate(const Moduli& m, FlowStress<Real>& out, LawList<Rate...>)
{
  int k = 0;
  ((k++ == m.flow.rate ? choose_hardening<Real, Rate>(m, out, HardeningLaws{}) : void()), ...);
}

template <class Real, class Surface>
bool find_on(FlowTrials<Real>& trials, int count, const Real* plastic_strain, const Moduli& m,
             const FlowStress<Real>& flow_stress, double per_dt)
{
  return Surface::from(m.flow.surface_values)
      .find(trials, count, plastic_strain, m, m.shear, m.bulk, flow_stress, per_dt);
}

template <class Real, class... Surface>
GRANULAW_INLINE void choose_surface(const Moduli& m, Yielding<Real>& out, LawList<Surface...>)
{
  int k = 0;
  ((k++ == m.flow.surface ? void((out.find = find_on<Real, Surface>,
                                  out.dilates = Surface::from(m.flow.surface_values).dilates()))
                          : void()),
   ...);
}

template <class Real>
GRANULAW_INLINE Yielding<Real> yielding_of(const Moduli& m)
{
  Yielding<Real> out{nullptr, {}, false, m.yields};
  if (!m.yields) return out;
  choose_rate(m, out.flow_stress, RateLaws{});
  choose_surface(m, out, YieldSurfaces{});
  return out;
}

}  // namespace

Yielding<double> yielding_in_double(const Moduli& m)
{
  return yielding_of<double>(m);
}

Yielding<float> yielding_in_float(const Moduli& m)
{
  return yielding_of<float>(m);
}

}  // namespace granulaw::GRANULAW_ISA_NAMESPACE
