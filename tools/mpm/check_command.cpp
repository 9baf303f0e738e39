// mpm check: is this file a whole, sane, admissible law, and does the solver still agree with it?
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <random>

#include "base/error.hpp"
#include "base/scales.hpp"
#include "characterise/reduction_error.hpp"
#include "claim.hpp"
#include "commands.hpp"
#include "law/law_file.hpp"
#include "law/replay.hpp"
#include "material_hash.hpp"
#include "materials_file.hpp"
#include "option_checks.hpp"
#include "solver/runs.hpp"
#include "terminal.hpp"

namespace granulaw {

namespace {

struct CheckRequest
{
  std::string law, materials;
  int impacts = 2;
  unsigned seed = 0;
};

/// Reading has checked every number; what is left is energy, and that every pair resolves.
bool admissible(const Law& law, const std::string& path)
{
  bool good = true;
  const auto examine = [&](const std::string& name, const ContactCurve& curve) {
    const double margin = curve.admissibility_margin();
    if (margin < 0)
      fmt::print("{}: NOT GOOD: a closed cycle would gain energy (margin {:.3g})\n", name, margin);
    good = good && margin >= 0;
  };
  for (const auto& [name, body] : law.bodies) examine(name, body.curve);
  for (const auto& [name, own] : law.pair_laws) examine(name, own.law.curve);
  for (const LawPair& pair : law.pairs) resolve_pair(law, pair.a, pair.b, path);
  return good;
}

/// One line: the law against a fresh impact, force and e within twice what the certificate claims. `force`,
/// `e`: relative errors; `restitution`: of the impact.
bool within_claim(const std::string& name, const Certificate& c, double velocity, double force, double e,
                  double restitution)
{
  const Claim claim = claim_of(c, restitution);
  const bool good = force <= 2 * claim.force && e <= 2 * claim.restitution;
  fmt::print(
      "{}: impact at {:.4g} m/s: F off by {:.2g} % (claimed {:.2g} %), e by {:.2g} % (claimed {:.2g} %): "
      "{}\n",
      name, velocity, 100 * force, 100 * claim.force, 100 * e, 100 * claim.restitution,
      good ? "good" : "NOT GOOD: more than twice the claim");
  return good;
}

/// The same of a pair's own law: two bodies, at the radii that it was made for, with I of `velocity`.
bool pair_impact_agrees(const Law& law, const std::string& name, double velocity)
{
  const TwoBodyLaw& own = law.pair_laws.at(name);
  const std::string a = name.substr(0, name.find(':')), b = name.substr(name.find(':') + 1);
  const LawMaterial &first = law.bodies.at(a).material, &second = law.bodies.at(b).material;
  const bool first_yields = yields_first(first, second);
  const UnlikePair pair{first_yields ? first : second, first_yields ? second : first, own.radius_ratio};
  const double wave_speed = std::sqrt(pair.yielding.e_star() / pair.yielding.density);
  const double relative = velocity * wave_speed / std::sqrt(pair.one_body_density());  // m/s
  RunSummary run;
  {
    ProgressBar bar;
    RunOptions options;
    options.progress = [&](double done) { bar.update(done, "check " + name); };
    run = run_two_bodies(pair, relative, options);
  }
  // radii in units of the yielding body's: 1 m
  const Replay replay = replay_collision(resolve_pair(law, a, b, name), pair.r_eff(),
                                         pair.m_eff() * pair.yielding.density, relative);
  return within_claim(name, own.law.certificate, relative,
                      std::abs(replay.force_max / pair.yielding.e_star() / run.force_max - 1),
                      std::abs(replay.restitution / run.restitution - 1), run.restitution);
}

/// The body whose law it is. The file keeps five numbers a material: where more determines the law, the
/// materials file that it was made from tells; nothing without one.
std::optional<CharacterisedBody> body_for(const std::string& name, const Law& law, const CheckRequest& r)
{
  const LawMaterial& m = law.bodies.at(name).material;
  const auto made_from = law.provenance.find("material_hash." + name);
  const std::string hash = made_from == law.provenance.end() ? std::string() : made_from->second;
  const Material plain{m.density, m.youngs_modulus, m.poisson_ratio, m.yield_stress, m.hardening_modulus};
  if (r.materials.empty())
    return hash.empty() || hash == hash_of(plain) ? std::optional(characterised_body_of(plain))
                                                  : std::nullopt;
  const MaterialsFile file = read_materials(r.materials);
  const bool is_particle = !file.materials.contains(name) && file.particles.contains(name);
  const CharacterisedBody characterised =
      is_particle ? characterised_body_of(file.particle(name)) : characterised_body_of(file.material(name));
  const std::string found =
      hash_of(characterised, is_particle ? file.particle(name).materials[0] : file.material(name));
  if (!hash.empty() && hash != found)
    fail(r.materials, fmt::format("'{}' is not what the law was made from", name), found, hash);
  return characterised;
}

/// A fresh impact at `velocity` (over sqrt(E*/rho)) against the law's replay of it: force and e within twice
/// what the certificate claims.
bool impact_agrees(const std::string& name, const BodyLaw& body, const CharacterisedBody& characterised,
                   double velocity)
{
  const LawMaterial& m = body.material;
  RunSummary run;
  {
    ProgressBar bar;
    RunOptions options;
    options.progress = [&](double done) { bar.update(done, "check " + name); };
    run = run_impact(characterised.particle, velocity * characterised.scale.velocity(), options).summary;
  }
  run.force_max /= characterised.scale.force();
  const Scales unit{characterised.scale.length, m.e_star(), m.density};
  const Replay replay =
      replay_on_wall(body, unit.length, characterised.mass * unit.mass(), velocity * unit.velocity());
  return within_claim(name, body.certificate, velocity * unit.velocity(),
                      std::abs(replay.force_max / unit.force() / run.force_max - 1),
                      std::abs(replay.restitution / run.restitution - 1), run.restitution);
}

void check(const CheckRequest& r)
{
  const Law law = read_law(r.law);
  if (!r.materials.empty()) read_materials(r.materials);  // said before any impact is made
  bool good = admissible(law, r.law);
  const unsigned seed = r.seed ? r.seed : std::random_device{}();
  std::mt19937 random(seed);
  int thrown = 0;
  /// Some velocities between `slow` and the end of the rate-free range, evenly in the logarithm.
  const auto throw_some = [&](double slow, const BodyLaw& body, const auto& agrees) {
    const double yield = body.material.yield_stress / body.material.e_star();
    const double fast = std::max(1.01 * slow, std::sqrt(body.certificate.damage_number_max * yield));
    std::uniform_real_distribution<double> logarithm(std::log(slow), std::log(fast));
    thrown += r.impacts;
    for (int k = 0; k < r.impacts; ++k) good = agrees(std::exp(logarithm(random))) && good;
  };
  const auto twice_onset = [](const LawMaterial& m) {
    return 2 * onset_velocity(1.0, m.yield_stress / m.e_star(), 1.0, m.poisson_ratio);
  };
  for (const auto& [name, body] : law.bodies) {
    if (!body.material.yields() || r.impacts == 0) continue;
    const std::optional<CharacterisedBody> characterised = body_for(name, law, r);
    if (!characterised) {
      fmt::print(
          "{}: no fresh impacts: its materials' numbers alone do not determine its law; name the file it was "
          "made from with --materials\n",
          name);
      continue;
    }
    double slow = twice_onset(body.material);
    if (const VelocityAxis* axis = body.curve.axis())
      slow = std::max(slow,
                      axis->speed_begin() * std::sqrt(body.material.yield_stress / body.material.e_star()));
    throw_some(slow, body, [&, &name = name, &body = body](double velocity) {
      return impact_agrees(name, body, *characterised, velocity);
    });
  }
  for (const auto& [name, own] : law.pair_laws)
    if (r.impacts > 0)
      throw_some(twice_onset(own.law.material), own.law,
                 [&, &name = name](double velocity) { return pair_impact_agrees(law, name, velocity); });
  if (!good) fail(r.law, fmt::format("the law fails its check (seed {})", seed));
  fmt::print(
      "{}: good ({} materials, pairs {}; no closed cycle gains energy; {} fresh impacts in all, seed "
      "{})\n",
      r.law, law.bodies.size(), law.pair_list(), thrown, seed);
}

}  // namespace

void add_check(CLI::App& app)
{
  const auto r = std::make_shared<CheckRequest>();
  CLI::App* command = app.add_subcommand(
      "check",
      "Is this file a whole, sane, admissible law, and does the solver still agree with it?\n"
      "Each yielding material is thrown at a wall, and each pair with its own law at each other, at random\n"
      "velocities inside the law's range; force and e must lie within twice the certificate's claim. "
      "Example: mpm check law.h5");
  command->add_option("LAW", r->law, "law file of mpm table")->required();
  command
      ->add_option("--impacts", r->impacts, "fresh impacts for each yielding material (default 2; 0: none)")
      ->check(whole_from_to(0, 1000));
  command->add_option("--materials", r->materials,
                      "materials file that the law was made from: needed for the impacts of layered, shaped, "
                      "rate-dependent and nonlinearly hardening bodies");
  command->add_option("--seed", r->seed, "seed of the velocities (default: a new one each time, printed)");
  command->callback([r] { check(*r); });
}

}  // namespace granulaw
