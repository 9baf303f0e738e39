#pragma once

#include <algorithm>
#include <concepts>
#include <iterator>

#include "solver/material/parameter.hpp"
#include "solver/material/flow_trials.hpp"

namespace granulaw::flow {

// Requirements on a flow law. Stresses are in the unit of the yield stress that the law is given, rates in
// the unit of its reference rate; strains are equivalent plastic strains, logarithmic, 0 or more. Both
// functions are defined from 0 on, positive, and never fall (a law that softens has no unique return). They
// are GRANULAW_MEMBER: kernels inline them into loops over material points, so they have no branch with a
// call.

/// A law as the materials file names it: `name` and one Parameter for each key.
template <class Law>
concept NamedLaw = requires
{
  {
    Law::name
    } -> std::convertible_to<const char*>;
  {
    *std::begin(Law::parameters)
    } -> std::convertible_to<Parameter>;
};

/// Every key is a list: the law says how the lists are kept for the kernel.
///     pack(first list, its length, second list, its length, out)
/// fills up to law_room doubles that `from` reads; returns null, or a sentence why the lists cannot be used.
template <class Law>
concept LawOfLists = NamedLaw<Law> &&
    std::ranges::all_of(Law::parameters, &Parameter::list) && std::size(Law::parameters)
== 2 && requires(const double* list, double* out)
{
  {
    Law::pack(list, 0, list, 0, out)
    } -> std::convertible_to<const char*>;
};

/// Every key is a number: `from` reads them in the order of `parameters`.
///     scale_strains(values, by)
/// changes them so that every plastic strain is `by` times as large, at the same stresses.
template <class Law>
concept LawOfNumbers = NamedLaw<Law> &&
    std::ranges::none_of(Law::parameters, &Parameter::list) && std::size(Law::parameters)
<= law_room&& requires(double* values)
{
  Law::scale_strains(values, 2.0);
};

/// Static flow stress sigma_y over the equivalent plastic strain.
///     from(yield_stress, values)   the law with its parameters as packed
///     law(ep)                      sigma_y(ep) and d(sigma_y)/d(ep); law(0) is the yield stress to 0.1 %
///     law.strain_at(stress)        a strain by which `stress`, more than the yield stress, is reached: where
///                                  the search for the plastic strain may begin; `unreached` if that is of no
///                                  help
/// and, if the parameters can contradict the yield stress,
///     misuse(yield_stress, values) null, or a sentence why they cannot be used with it
template <class Law>
concept HardeningLaw = (LawOfNumbers<Law> || LawOfLists<Law>)&&requires(const Law law, double x,
                                                                        const double* values)
{
  {
    Law::from(x, values)
    } -> std::same_as<Law>;
  {
    law(x)
    } -> std::same_as<ValueAndSlope>;
  {
    law.strain_at(x)
    } -> std::same_as<double>;
};

/// Factor on the static flow stress over the plastic strain rate: 1 at rate 0.
///     from(values)                 the law with its parameters, in the order of `parameters`
///     law(rate)                    the factor and its slope
///     law.rate_at(excess)          the rate at which the factor is 1 + excess, excess over 0; `unreached` if
///                                  that is of no help
template <class Law>
concept RateLaw = NamedLaw<Law> &&
    std::ranges::none_of(Law::parameters, &Parameter::list) && std::size(Law::parameters)
<= rate_room&& requires(const Law law, double x, const double* values)
{
  {
    Law::from(values)
    } -> std::same_as<Law>;
  {
    law(x)
    } -> std::same_as<ValueAndSlope>;
  {
    law.rate_at(x)
    } -> std::same_as<double>;
};

/// Yield surface and direction of plastic flow of a material.
///     from(values)                 the surface with its parameters, in the order of `parameters`
///     surface.dilates()            its flow changes the volume: `dilation` is filled, too
///     surface.find(trials, count, plastic_strain, moduli, shear, bulk, flow_stress, per_dt)
///                                  fills the flow of the points of a block (flow_trials.hpp); false: none
///                                  flows. shear, bulk: G and K of `moduli`, which flow_stress takes; per_dt:
///                                  1 over the time since the last update, 0: rate-independent
template <class Surface>
concept YieldSurface = std::size(Surface::parameters)
<= surface_room&& requires(const Surface surface, const double* values, kernel::FlowTrials<double>& trials,
                           const Moduli& moduli, const kernel::FlowStress<double>& flow_stress)
{
  {
    Surface::name
    } -> std::convertible_to<const char*>;
  {
    Surface::from(values)
    } -> std::same_as<Surface>;
  {
    surface.dilates()
    } -> std::same_as<bool>;
  {
    surface.find(trials, 1, values, moduli, 1.0, 1.0, flow_stress, 0.0)
    } -> std::same_as<bool>;
};

}  // namespace granulaw::flow
