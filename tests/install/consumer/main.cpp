// Uses each installed library once.
#include <cmath>

#include "base/error.hpp"
#include "base/scales.hpp"
#include "characterise/build/build_law.hpp"
#include "contact/curve.hpp"
#include "law/law_file.hpp"
#include "solver/runs.hpp"

/// The reader, with the HDF5 that the package links.
bool refuses_a_missing_law()
{
  try {
    granulaw::read_law("none.h5");
  } catch (const granulaw::Error&) {
    return true;
  }
  return false;
}

int main()
{
  const granulaw::Particle sphere =
      granulaw::Particle::sphere(1e-3, {.density = 1000, .youngs_modulus = 0.91e9, .poisson_ratio = 0.3});
  granulaw::RunOptions options;
  options.resolution = 8;
  options.shifted_grids = 1;
  const double e = granulaw::impact(sphere, {1.0}, {}, options).summary.restitution;
  granulaw::BuildOptions request;
  request.depth = 0.02, request.tolerance = 0.1;
  const granulaw::Curve curve = granulaw::build_law("elastic", sphere, request).law.curve;
  return std::abs(e - 1) < 0.01 && curve.loading(0.01).force > 0 && refuses_a_missing_law() ? 0 : 1;
}
