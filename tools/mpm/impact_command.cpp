// mpm impact: one collision by the solver, with a wall or another particle.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "base/error.hpp"
#include "base/scales.hpp"
#include "characterise/body/law_material.hpp"
#include "body_impact.hpp"
#include "command.hpp"
#include "impact_body_options.hpp"
#include "law/damage_number.hpp"
#include "material_file/plausible.hpp"
#include "run_report.hpp"
#include "solver/run/axisymmetric_setup.hpp"
#include "solver/runs.hpp"

namespace granulaw {

namespace of_impact {

struct ImpactRequest
{
  RunRequest run;
  double velocity = 0;  // m/s
  std::optional<double> friction, tangential_velocity, spin;
  std::vector<double> orientation;
  ImpactBody body;
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
  if (!(velocity > 0 && std::isfinite(velocity))) fail("--velocity", "cannot be used", fmt::format("{:g} m/s", velocity), "over 0");
  if (velocity > 0.5 * wave_speed)
    fail("--velocity", "is beyond what an impact of a particle can be resolved for", fmt::format("{:g} m/s", velocity),
        fmt::format("up to half the wave speed sqrt(E*/rho), {:.4g} m/s", 0.5 * wave_speed));
  if (velocity < slowest * wave_speed)
    fail("--velocity", "is too slow to be resolved (Hertz's law holds there)", fmt::format("{:g} m/s", velocity),
        fmt::format("{:g} times the wave speed sqrt(E*/rho) or more, {:.4g} m/s", slowest, slowest * wave_speed));
  check_plausible("impact", "velocity", "--velocity", velocity);
}

/// Damage number of the body that yields first; 0: neither does.
double damage_number_of(const Meeting& m, double velocity)
{
  const LawMaterial own = law_material("particle", m.particle.materials.front());
  const Material* other = m.partner.particle ? &m.partner.particle->materials.front() : m.partner.wall ? &*m.partner.wall : nullptr;
  if (!other) return own.yields() ? damage_number(own, PairMapping::rigid_partner(own.e_star()), velocity) : 0.0;
  const LawMaterial partner = law_material("partner", *other);
  const bool own_yields = yields_first(own, partner);
  const LawMaterial &yielding = own_yields ? own : partner, &second = own_yields ? partner : own;
  if (!yielding.yields()) return 0.0;
  return damage_number(yielding, PairMapping::deformable_partner(yielding.e_star(), second.e_star()), velocity);
}

/// The body's mass and compliance: those of the command, else those of the particle's file.
ImpactBody body_of(const ImpactRequest& r, const Particle& particle)
{
  const ImpactBody &asked = r.body, &known = particle.impact_body;
  return {asked.mass > 0 ? asked.mass : known.mass, asked.compliance > 0 ? asked.compliance : known.compliance};
}

/// An impact at `velocity` by a body that gives way: at a lower speed without it, where the work of loading and what
/// the body stores are the energy that came. A share of the energy that hardly changes with the speed: two or three runs.
/// Overlap, e and work hold the body's part, samples those of the contact alone.
RunResult compliant_impact(const Meeting& m, Approach thrown, double compliance, const RunOptions& options)
{
  constexpr double settled = 1e-4;  // of the speed; e follows it by less
  const double velocity = thrown.velocity;
  for (int run = 0; run < 6; ++run) {
    RunResult result = granulaw::impact(m.particle, thrown, m.partner, options);
    RunSummary& s = result.summary;
    const double stored = 0.5 * compliance * s.force_max * s.force_max, share = stored / s.work_load;
    const double next = velocity / std::sqrt(1 + share);
    if (std::abs(next / thrown.velocity - 1) > settled) {
      thrown.velocity = next;
      continue;
    }
    s.restitution = std::sqrt((s.restitution * s.restitution + share) / (1 + share));
    s.work_load += stored, s.work_unload += stored, s.delta_max += compliance * s.force_max;
    return result;
  }
  fail("--impact-body-compliance", "the speed of the contact has not settled in six runs");
}

void impact(ImpactRequest r)
{
  check_oblique(r);
  r.run.check();
  Meeting m = read_meeting(r.run);
  const ImpactBody body = body_of(r, m.particle);
  if (body.compliance > 0 && !(r.run.checkpoint.empty() && r.run.fields.empty()))
    fail("--impact-body-compliance", "takes several runs, which go with neither --checkpoint nor --fields");
  const double damage_number = damage_number_of(m, r.velocity);
  m.particle = fixed_to(std::move(m.particle), body, "--impact-body-mass");
  check_velocity(r.velocity, scales_of(m.particle).velocity());
  print_setting(r.run, m.particle, r.velocity, damage_number);
  const RunIdentity asked{{"command", "impact"}, {"--velocity", fmt::format("{}", r.velocity)}};
  const Approach thrown = throw_of(r);
  const auto run = [&](const RunOptions& options) {
    return body.compliance > 0 ? compliant_impact(m, thrown, body.compliance, options) : granulaw::impact(m.particle, thrown, m.partner, options);
  };
  if (in_three_dimensions(r.run, m.particle)) {
    if (body.mass > 0 || body.compliance > 0)
      fail("--grid", "an impact body turns with its sphere, which is not computed: head-on impacts of a body of revolution have it");
    RunIdentity oblique = asked;
    oblique.emplace_back("--friction", fmt::format("{}", thrown.friction));
    oblique.emplace_back("--tangential-velocity", fmt::format("{}", thrown.tangential_velocity));
    oblique.emplace_back("--spin", fmt::format("{}", thrown.spin));
    oblique.emplace_back("--orientation", fmt::format("{}", fmt::join(thrown.orientation, ",")));
    CentreMotion centre{thrown.velocity, thrown.tangential_velocity};
    return run_and_report(
        r.run, m, oblique, false, [&](const RunOptions& options) { return body_impact(m.particle, thrown, m.partner, options, centre); }, centre);
  }
  run_and_report(r.run, m, asked, false, run);
}

void define(Options& command)
{
  const auto r = std::make_shared<ImpactRequest>();
  r->run.add_to(command);
  command.add_option("--velocity", r->velocity, "approach speed, m/s").required();
  command
      .add_option("--orientation", r->orientation,
          "three dimensions: X,Y,Z, the direction in the body's frame that points at the wall. The body's axis nearest to it leans towards +x of the wall")
      .list()
      .expected(3);
  command.add_option("--friction", r->friction, "three dimensions: Coulomb's coefficient of the wall, 0 to 10");
  command.add_option("--tangential-velocity", r->tangential_velocity, "three dimensions: velocity along +x of the wall, m/s");
  command.add_option("--spin", r->spin, "three dimensions: rad/s about +y of the wall, forward as of a body that rolls along +x");
  define_impact_body(command, r->body, "the particle");
  command.callback([r] { impact(*r); });
}

}  // namespace of_impact

extern const Command impact_command{"impact",
    "A particle hits a wall, or another particle: e, force, overlap, contact time.\n"
    "Example: mpm impact materials.toml --particle grain --velocity 1.0 -o trace.csv",
    of_impact::define};

}  // namespace granulaw
