#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <thread>

#include "base/error.hpp"
#include "base/scales.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "law/law_file.hpp"
#include "law/replay.hpp"
#include "materials_file.hpp"
#include "solver/runs.hpp"

namespace granulaw::tool {

namespace {

/// A fresh impact at a velocity that the law was not made from, against the law's replay. True if within twice
/// what the certificate claims.
bool check_impact(const std::string& name, const BodyLaw& body, double velocity)
{
  const LawMaterial& m = body.material;
  const Sphere sphere{1e-3, solver_material(m)};
  RunOptions options;
  options.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  RunSummary run;
  {
    ProgressBar bar("check " + name);
    options.progress = [&](double fraction) { bar.show(fraction); };
    run = run_impact(sphere, velocity, options).summary;
  }
  const PairLaw wall{&body.curve, PairMapping::rigid_partner(m.e_star()), &body};
  const double mass = 4.0 / 3.0 * M_PI * std::pow(sphere.radius, 3) * m.density;
  const Replay replay = replay_collision(wall, sphere.radius, mass, velocity);
  const double force = std::abs(replay.force_max / run.force_max - 1), e = std::abs(replay.restitution / run.restitution - 1);
  const Certificate& c = body.certificate;
  const double claimed_force = c.verification_error_force + c.solver_error_force;
  const double claimed_e = c.verification_error_restitution + c.solver_error_restitution;
  const bool good = force <= 2 * claimed_force && e <= 2 * claimed_e;
  fmt::print("{}: impact at {:.4g} m/s: F off by {:.2g} % (claimed {:.2g} %), e by {:.2g} % (claimed {:.2g} %): {}\n", name, velocity,
             100 * force, 100 * claimed_force, 100 * e, 100 * claimed_e, good ? "good" : "NOT WITHIN TWICE THE CLAIM");
  return good;
}

}  // namespace

void add_check(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("check", "Examine a law file: readable, admissible, and true against fresh solver runs");
  command->footer("Each yielding material is thrown at a wall at a few random velocities inside the law's range; what the\n"
                  "law then says must lie within twice its certificate's claim. Exit code 1 if anything fails.");
  auto path = std::make_shared<std::string>();
  auto count = std::make_shared<int>(2);
  auto seed = std::make_shared<unsigned>(0);
  command->add_option("law", *path, "law file")->required();
  command->add_option("--impacts", *count, "fresh impacts for each yielding material")->capture_default_str();
  command->add_option("--seed", *seed, "seed of the random velocities (default: a new one each time, printed)");
  command->callback([=] {
    const Law law = read_law(*path);
    const unsigned used = *seed ? *seed : std::random_device{}();
    fmt::print("{}: readable; seed {}\n", *path, used);
    std::mt19937 random(used);
    bool good = true;
    for (const auto& [name, body] : law.bodies) {
      if (!body.material.yields()) continue;
      const double margin = body.curve.admissibility_margin();
      fmt::print("{}: admissibility margin {:.3f}: {}\n", name, margin, margin >= 0 ? "good" : "NOT ADMISSIBLE");
      good = good && margin >= 0;
      const LawMaterial& m = body.material;
      const double slow = 2 * onset_velocity(m.e_star(), m.yield_stress, m.density, m.poisson_ratio);
      const double fast = std::max(1.01 * slow, std::sqrt(body.certificate.max_inertia * m.yield_stress / m.density));
      std::uniform_real_distribution<double> logarithm(std::log(slow), std::log(fast));
      for (int k = 0; k < *count; ++k) good = check_impact(name, body, std::exp(logarithm(random))) && good;
    }
    if (!good) fail(*path, "the law fails its check");
  });
}

}  // namespace granulaw::tool
