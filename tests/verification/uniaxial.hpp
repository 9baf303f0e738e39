#pragma once

#include <functional>
#include <string>
#include <vector>

#include "solver/material/material.hpp"

/// One material point in uniaxial compression, as in a testing machine: a cylinder squeezed along its axis,
/// its side free of stress. True (Cauchy) stress against true (logarithmic) strain, compression positive, E*
/// = 1.
namespace granulaw::verification {

struct StressStrain
{
  double strain, stress, plastic_strain;
};

/// The solver's kernel, to the strain `last` in equal steps, at the strain rate `rate` (c*/R; 0:
/// rate-independent).
std::vector<StressStrain> compress(const Material& material, double last, int steps, double rate = 0);

/// A law written out again, independent of the solver's own: stress(ep) and, for rate-dependent materials,
/// the plastic strain rate at which the flow stress is g > 1 times that.
struct WrittenLaw
{
  std::string name;
  Material material;
  std::function<double(double ep)> stress;
  std::function<double(double g)> rate;  ///< empty: rate-independent
};
std::vector<WrittenLaw> hardening_laws_written_out();
std::vector<WrittenLaw> rate_laws_written_out();

/// The integrated equation. With Hencky's elasticity the elastic strain x = t - ep of uniaxial stress gives
/// the Kirchhoff stress E x and J = exp(-(1 - 2 nu) x), so the Cauchy stress is E x exp((1 - 2 nu) x). The
/// law says that this is stress(ep); with rate dependence, that ep grows as the law's rate at the ratio of
/// the two.
StressStrain exact(const WrittenLaw& law, double strain, double rate = 0);

}  // namespace granulaw::verification
