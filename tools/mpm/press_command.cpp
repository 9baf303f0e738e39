// mpm press: one slow press and unloading by the solver, onto a wall or another particle.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "base/error.hpp"
#include "command.hpp"
#include "option_checks.hpp"
#include "run_and_report.hpp"
#include "run_report.hpp"

namespace granulaw {

namespace {

struct PressRequest
{
  RunRequest run;
  double depth = 0;  // over R
  std::string support = "free";
  std::optional<double> ramp;  // R/c*
};

/// Shallowest press, over R: a contact of about 1e-4 R. The time step goes with its cells, so smaller ones
/// take days.
constexpr double shallowest = 1e-8;

void check(const PressRequest& r)
{
  r.run.check();
  if (r.support != "free" && r.support != "midplane")
    fail("--support", "unknown support", r.support, "free, midplane");
}

void check_numbers(const PressRequest& r)
{
  require(r.depth >= shallowest && r.depth <= 0.8, "--depth",
          fmt::format("{:g} (a share of the radius)", r.depth), fmt::format("{:g} to 0.8", shallowest));
  if (r.ramp)
    require(*r.ramp >= 1 && *r.ramp <= 1e6, "--ramp", fmt::format("{:g} R/c*", *r.ramp), "1 to 1e6");
}

PressPlan plan_of(const PressRequest& r, const Particle& particle)
{
  PressPlan plan;
  plan.ramp = r.ramp.value_or(0);
  plan.depth = r.depth * particle.radius;
  plan.support = r.support == "free" ? Support::free : Support::midplane;
  return plan;
}

void press(const PressRequest& r)
{
  check(r);
  const Meeting m = read_meeting(r.run);
  check_numbers(r);
  const PressPlan plan = plan_of(r, m.particle);
  print_setting(r.run, m.particle, 0);
  const RunIdentity asked{{"command", "press"},
                          {"--depth", fmt::format("{}", r.depth)},
                          {"--support", r.support},
                          {"--ramp", fmt::format("{}", r.ramp.value_or(0))}};
  run_and_report(r.run, m, asked, true,
                 [&](const RunOptions& options) { return run_press(m.particle, plan, options, m.partner); });
}

void define(CLI::App& command)
{
  const auto r = std::make_shared<PressRequest>();
  r->run.add_to(command);
  command.add_option("--depth", r->depth, "deepest overlap, as a share of the radius")->required();
  command.add_option("--support", r->support,
                     "free (as in a collision) or midplane (as in finite-element references)");
  command.add_option("--ramp", r->ramp,
                     "loading time in R/c*, c* = sqrt(E*/rho), 1 to 1e6 (default: long enough for the "
                     "rate-free law, 60 or more where the material yields)");
  command.callback([r] { press(*r); });
}

}  // namespace

extern const Command press_command{
    "press",
    "A particle is pressed slowly onto a wall, or another particle, and taken off again: the rate-free law.\n"
    "Example: mpm press materials.toml --particle grain --depth 0.02 --support midplane -o trace.csv",
    define};

}  // namespace granulaw
