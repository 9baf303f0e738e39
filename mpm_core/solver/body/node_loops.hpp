#pragma once

#include "solver/body/body.hpp"

// The nodes of a step, the same for every grid. Included by the files that are compiled once for each
// instruction set, under their rules (axisymmetric_isa.cpp).

namespace granulaw {

/// v_i += dt f_i/m_i; the axis and mirrors hold their nodes (1/m is 0 there).
static void accelerate(Body& body, double dt)
{
  const long count = long(body.v_i.values.size());
  const double* __restrict w = body.reference().inverse_mass_i.values.data();
  const double* __restrict f = body.f_i.values.data();
  double* __restrict v = body.v_i.values.data();
#pragma omp simd
  for (long i = 0; i < count; ++i) v[i] += dt * w[i] * f[i];
}

/// u_i += dt v_i
static void move(Body& body, double dt)
{
  const long count = long(body.v_i.values.size());
  const double* __restrict v = body.v_i.values.data();
  double* __restrict u = body.u_i.values.data();
#pragma omp simd
  for (long i = 0; i < count; ++i) u[i] += dt * v[i];
  body.elapsed += dt;
}

}  // namespace granulaw
