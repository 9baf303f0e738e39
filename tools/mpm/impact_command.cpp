// mpm impact: one collision by the solver, with a wall or another particle.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "base/error.hpp"
#include "base/scales.hpp"
#include "command.hpp"
#include "run_and_report.hpp"
#include "run_report.hpp"
#include "solver/run/scene_builder.hpp"
#include "solver/runs.hpp"

namespace granulaw {

namespace {

struct ImpactRequest
{
  RunRequest run;
  double velocity = 0;  // m/s
  std::optional<double> friction, tangential_velocity, spin;
  std::vector<double> orientation;
};

/// Options that only three dimensions know send the run there.
void check_oblique(ImpactRequest& r)
{
  if (!r.orientation.empty()) require_three_dimensions(r.run, "--orientation");
  if (r.friction) require_three_dimensions(r.run, "--friction");
  if (r.tangential_velocity) require_three_dimensions(r.run, "--tangential-velocity");
  if (r.spin) require_three_dimensions(r.run, "--spin");
}

Approach throw_of(const ImpactRequest& r)
{
  Approach thrown;
  thrown.velocity = r.velocity;
  thrown.friction = r.friction.value_or(0);
  thrown.tangential_velocity = r.tangential_velocity.value_or(0);
  thrown.spin = r.spin.value_or(0);
  if (!r.orientation.empty()) thrown.orientation = {r.orientation[0], r.orientation[1], r.orientation[2]};
  return thrown;
}

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

void impact(ImpactRequest r)
{
  check_oblique(r);
  r.run.check();
  const Meeting m = read_meeting(r.run);
  check_velocity(r.velocity, scales_of(m.particle).velocity());
  print_setting(r.run, m.particle, r.velocity);
  const RunIdentity asked{{"command", "impact"}, {"--velocity", fmt::format("{}", r.velocity)}};
  const Approach thrown = throw_of(r);
  const auto run = [&](const RunOptions& options) {
    return granulaw::impact(m.particle, thrown, m.partner, options);
  };
  if (in_three_dimensions(r.run, m.particle)) {
    RunIdentity oblique = asked;
    oblique.emplace_back("--friction", fmt::format("{}", thrown.friction));
    oblique.emplace_back("--tangential-velocity", fmt::format("{}", thrown.tangential_velocity));
    oblique.emplace_back("--spin", fmt::format("{}", thrown.spin));
    oblique.emplace_back("--orientation", fmt::format("{}", fmt::join(thrown.orientation, ",")));
    return run_and_report(r.run, m, oblique, false, run);
  }
  run_and_report(r.run, m, asked, false, run);
}

void define(CLI::App& command)
{
  const auto r = std::make_shared<ImpactRequest>();
  r->run.add_to(command);
  command.add_option("--velocity", r->velocity, "approach speed, m/s")->required();
  command
      .add_option(
          "--orientation", r->orientation,
          "three dimensions: X,Y,Z, the direction in the body's own frame that points at the wall; the "
          "body's axis nearest to it leans towards +x of the wall")
      ->delimiter(',')
      ->expected(3);
  command.add_option("--friction", r->friction,
                     "three dimensions: Coulomb's coefficient of the wall, 0 to 10");
  command.add_option("--tangential-velocity", r->tangential_velocity,
                     "three dimensions: velocity along +x of the wall, m/s");
  command.add_option(
      "--spin", r->spin,
      "three dimensions: rad/s about +y of the wall, forward as of a body that rolls along +x");
  command.callback([r] { impact(*r); });
}

}  // namespace

extern const Command impact_command{
    "impact",
    "A particle hits a wall, or another particle: e, force, overlap, contact time.\n"
    "Example: mpm impact materials.toml --particle grain --velocity 1.0 -o trace.csv",
    define};

}  // namespace granulaw
