#pragma once

#include <functional>
#include <string>

#include "characterise/farm.hpp"
#include "characterise/fit_curve.hpp"
#include "law/law.hpp"

namespace granulaw {

/// Where the runs come from: the solver, or a test's own model.
struct RunSource
{
  std::function<RunResult(const Sphere&, const PressPlan&, const RunOptions&)> press =
      [](const Sphere& s, const PressPlan& plan, const RunOptions& o) { return run_press(s, plan, o); };
  std::function<RunResult(const Sphere&, double, const RunOptions&)> impact =
      [](const Sphere& s, double velocity, const RunOptions& o) { return run_impact(s, velocity, o); };
};

struct BuildOptions
{
  double depth = 0.1;  ///< overlap/R that the law must reach; beyond 0.1 no single pair law exists (DESIGN 4)
  double tolerance = 0;  ///< of force and e, relative; the resolution is raised until the two-resolution
                         ///< estimate of a press meets it; 0: the default resolution
  Farm* farm = nullptr;  ///< makes the runs; none: this thread
  Progress progress;     ///< may throw to stop
};

/// Law of one material on a rigid wall, by the material point method. Everything runs in R = rho = E* = 1.
///
/// Free impacts from the onset of yield to I = rho V^2/Y = largest_inertia give loading force, residual
/// overlap and e up to their own overlaps; slow presses with free support carry on from there to `depth`,
/// keeping their ratio to the deepest impact; one elastic press gives the finite-sphere correction. The fit
/// is fit_curve.hpp's. Impacts between the sampled ones check it. Why impacts and not presses where both
/// exist: at I = 0.002 a slow press has 1 % more force and 1.7 % more e than the impact that reaches the same
/// overlap (E*/Y = 100, measured; 0.05 % at I = 2e-5), and free collisions are what the law is for. The
/// certificate states the difference. Throws Error if the law is not admissible.
BodyLaw build_law(const LawMaterial& material, const BuildOptions& options, const RunSource& source = {});

/// Largest I = rho V^2/Y that a rate-free law is used for: above it e would be over 1 % too high (DESIGN 4).
inline constexpr double largest_inertia = 0.002;

}  // namespace granulaw
