// mpm impact: one collision by the solver, with a wall or another particle.
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "base/error.hpp"
#include "base/scales.hpp"
#include "command.hpp"
#include "run_and_report.hpp"
#include "run_report.hpp"
#include "solver/run/scene_builder.hpp"

namespace granulaw {

namespace {

struct ImpactRequest
{
  RunRequest run;
  double velocity = 0;  // m/s
};

/// Slowest impact, over the wave speed c* = sqrt(E*/rho): a contact of about 1e-4 R. The time step goes with
/// its cells, so slower ones take days. Elastic there up to E*/Y = 15 000.
constexpr double slowest = 1e-10;

/// `velocity` and `wave_speed` in m/s. Beyond half the wave speed the solver refuses, too.
void check_velocity(double velocity, double wave_speed)
{
  if (!(velocity > 0 && std::isfinite(velocity)))
    fail("--velocity", "cannot be used", fmt::format("{:g} m/s", velocity), "over 0");
  if (velocity > 0.5 * wave_speed)
    fail("--velocity", "is beyond what an impact of a particle can be resolved for",
         fmt::format("{:g} m/s", velocity),
         fmt::format("up to half the wave speed sqrt(E*/rho), {:.4g} m/s", 0.5 * wave_speed));
  if (velocity < slowest * wave_speed)
    fail("--velocity", "is too slow to be resolved (Hertz's law holds there)",
         fmt::format("{:g} m/s", velocity),
         fmt::format("{:g} times the wave speed sqrt(E*/rho) or more, {:.4g} m/s", slowest,
                     slowest * wave_speed));
}

void impact(const ImpactRequest& r)
{
  r.run.check();
  const Meeting m = read_meeting(r.run);
  check_velocity(r.velocity, scales_of(m.particle).velocity());
  print_setting(r.run, m.particle, r.velocity);
  const RunIdentity asked{{"command", "impact"}, {"--velocity", fmt::format("{}", r.velocity)}};
  run_and_report(r.run, m, asked, false, [&](const RunOptions& options) {
    return run_impact(m.particle, r.velocity, options, m.partner);
  });
}

void define(CLI::App& command)
{
  const auto r = std::make_shared<ImpactRequest>();
  r->run.add_to(command);
  command.add_option("--velocity", r->velocity, "approach speed, m/s")->required();
  command.callback([r] { impact(*r); });
}

}  // namespace

extern const Command impact_command{
    "impact",
    "A particle hits a wall, or another particle: e, force, overlap, contact time.\n"
    "Example: mpm impact materials.toml --particle grain --velocity 1.0 -o trace.csv",
    define};

}  // namespace granulaw
