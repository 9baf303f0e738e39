// mpm check: is this file a whole, sane, admissible law, and does the solver still agree with it?
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <random>

#include "base/error.hpp"
#include "base/scales.hpp"
#include "characterise/body/law_body.hpp"
#include "characterise/body/law_material.hpp"
#include "characterise/file/law_file_plan.hpp"
#include "characterise/pair/reduction_error.hpp"
#include "characterise/shape/shape_certificate.hpp"
#include "command.hpp"
#include "law/error_bound.hpp"
#include "law/law_file.hpp"
#include "law/pair_names.hpp"
#include "law/replay.hpp"
#include "material_file/materials_file.hpp"
#include "option_checks.hpp"
#include "percent.hpp"
#include "shape_output.hpp"
#include "solver/runs.hpp"
#include "solver/shape/rotation.hpp"
#include "terminal.hpp"

namespace granulaw {

namespace of_check {

struct CheckRequest
{
  std::string law, materials;
  int impacts = 2;
  unsigned seed = 0;
};

/// One line: the law against a fresh impact, force and e within twice the certificate's bound. `force`, `e`:
/// relative errors; `restitution`: of the impact.
bool within_bound(const std::string& name, const Certificate& c, double velocity, double force, double e,
                  double restitution)
{
  const ErrorBound bound = bound_of(c);
  const double bound_e = bound.restitution_at(restitution) / restitution;
  const bool good = force <= 2 * bound.force && e <= 2 * bound_e;
  fmt::print("{}: impact at {:.4g} m/s: F off by {} (bound {}), e by {} (bound {}): {}\n", name, velocity,
             percent(force), percent(bound.force), percent(e), percent(bound_e),
             good ? "good" : "NOT GOOD: more than twice the bound");
  return good;
}

/// The run, with a bar.
RunSummary shown(const std::string& name, const std::function<RunSummary(const RunOptions&)>& run)
{
  ProgressBar bar;
  RunOptions options;
  options.progress = [&](double done) { bar.update(done, "check " + name); };
  return run(options);
}

/// That law of the pair.
PairLaw pair_law(const Law& law, const std::string& name, const TwoBodyLaw& own)
{
  const auto [a, b] = split_pair(name);
  const bool a_yields = yields_first(law.bodies.at(a).material, law.bodies.at(b).material);
  return a_yields ? resolve_pair(law, a, b, name, 1.0, own.radius_ratio)
                  : resolve_pair(law, b, a, name, 1.0, own.radius_ratio);
}

/// A fresh impact of a pair that has its own law: two bodies, at the radii that it was made for. `velocity`:
/// the yielding body's share of the approach, over its sqrt(E*/rho).
bool pair_impact_agrees(const Law& law, const std::string& name, const TwoBodyLaw& own, double velocity)
{
  const auto [a, b] = split_pair(name);
  const UnlikePair pair = unlike_pair(law.bodies.at(a).material, law.bodies.at(b).material, own.radius_ratio);
  const double wave_speed = std::sqrt(pair.yielding.e_star() / pair.yielding.density);
  const double relative = velocity * wave_speed * pair.mapping().sqrt_lambda;  // m/s
  const RunSummary run =
      shown(name, [&](const RunOptions& options) { return run_two_bodies(pair, relative, options); });
  // radii in units of the yielding body's: 1 m
  const Replay replay = replay_collision(pair_law(law, name, own), pair.r_eff(),
                                         pair.m_eff() * pair.yielding.density, relative);
  return within_bound(name, own.law.certificate, relative,
                      std::abs(replay.force_max / pair.yielding.e_star() / run.force_max - 1),
                      std::abs(replay.restitution / run.restitution - 1), run.restitution);
}

/// The body whose law it is. The file keeps five numbers a material: where more determines the law, the
/// materials file that it was made from gives; nothing without one.
std::optional<CharacterisedBody> body_for(const std::string& name, const Law& law, const CheckRequest& r)
{
  const auto made_from = law.provenance.find("material_hash." + name);
  const std::string hash = made_from == law.provenance.end() ? std::string() : made_from->second;
  if (r.materials.empty()) {
    const Material plain = material_of(law.bodies.at(name).material);
    const CharacterisedBody characterised = characterised_body_of(plain);
    return hash.empty() || hash == material_hash(characterised, plain) ? std::optional(characterised)
                                                                       : std::nullopt;
  }
  const LawBody body = law_body(name, read_materials(r.materials));
  const std::optional<ShapeCertificate>& certified = law.bodies.at(name).shape;
  if (certified && (!body.shape || shape_text(*shape_of(*body.shape)) != certified->shape))
    fail(r.materials, fmt::format("'{}' has another shape than the law's certificate", name));
  if (!hash.empty() && hash != body.hash)
    fail(r.materials, fmt::format("'{}' is not what the law was made from", name), body.hash, hash);
  return body.characterised;
}

/// A fresh impact at `velocity` (over sqrt(E*/rho)) against the law's replay of it: force and e within twice
/// the certificate's bound.
bool impact_agrees(const std::string& name, const BodyLaw& body, const CharacterisedBody& characterised,
                   double velocity)
{
  const LawMaterial& m = body.material;
  const RunSummary run = shown(name, [&](const RunOptions& options) {
    return impact(characterised.particle, {velocity * characterised.scale.velocity()}, {}, options).summary;
  });
  const double run_force = run.force_max / characterised.scale.force();
  const Scales unit{characterised.scale.length, m.e_star(), m.density};
  const Replay replay =
      replay_on_wall(body, unit.length, characterised.mass * unit.mass(), velocity * unit.velocity());
  return within_bound(name, body.certificate, velocity * unit.velocity(),
                      std::abs(replay.force_max / unit.force() / run_force - 1),
                      std::abs(replay.restitution / run.restitution - 1), run.restitution);
}

/// Slowest velocity, over sqrt(E*/rho), at which an impact gives something of the law: twice the onset's, and
/// within its velocity axis.
double slowest_of(const BodyLaw& body)
{
  const LawMaterial& m = body.material;
  const double yield = m.yield_stress / m.e_star();
  const double slow = 2 * onset_velocity(1.0, yield, 1.0, m.poisson_ratio);
  const AxisTable* axis = body.curve.axis();
  return axis ? std::max(slow, axis->speed_begin * std::sqrt(yield)) : slow;
}

/// Random impacts of one check.
class Throws
{
 public:
  Throws(unsigned seed, int each) : random_(seed), each_(each) {}

  /// Some velocities between `slow` and the end of the law's rate-independent range, evenly in the logarithm.
  /// True if `agrees` says so of all.
  bool agree(double slow, const BodyLaw& body, const std::function<bool(double)>& agrees)
  {
    const double yield = body.material.yield_stress / body.material.e_star();
    const double fast = std::max(1.01 * slow, std::sqrt(body.certificate.damage_number_max * yield));
    std::uniform_real_distribution<double> logarithm(std::log(slow), std::log(fast));
    bool good = true;
    for (int k = 0; k < each_; ++k) good = agrees(std::exp(logarithm(random_))) && good;
    count_ += each_;
    return good;
  }
  int count() const { return count_; }

 private:
  std::mt19937 random_;
  int each_, count_ = 0;
};

bool bodies_agree(const Law& law, const CheckRequest& r, Throws& throws)
{
  bool good = true;
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
    good = throws.agree(slowest_of(body), body, [&, &name = name, &body = body](double velocity) {
      return impact_agrees(name, body, *characterised, velocity);
    }) && good;
  }
  return good;
}

/// Law of the least unlike sizes among a pair's.
const TwoBodyLaw& least_unlike(const std::vector<TwoBodyLaw>& laws)
{
  return *std::min_element(laws.begin(), laws.end(), [](const TwoBodyLaw& a, const TwoBodyLaw& b) {
    return std::abs(a.size_share() - 0.5) < std::abs(b.size_share() - 0.5);
  });
}

bool pairs_agree(const Law& law, Throws& throws)
{
  bool good = true;
  for (const auto& [name, laws] : law.pair_laws) {
    const TwoBodyLaw& own = least_unlike(laws);
    if (!own.law.material.yields()) continue;
    const auto [a, b] = split_pair(name);
    const UnlikePair pair =
        unlike_pair(law.bodies.at(a).material, law.bodies.at(b).material, own.radius_ratio);
    const double slowest = slowest_of(own.law) / pair.axis_speed_ratio();
    good = throws.agree(slowest, own.law, [&, &name = name](double velocity) {
      return pair_impact_agrees(law, name, own, velocity);
    }) && good;
  }
  return good;
}

void check(const CheckRequest& r)
{
  const Law law = read_law(r.law);
  if (!r.materials.empty()) read_materials(r.materials);  // said before any impact is made
  const unsigned seed = r.seed ? r.seed : std::random_device{}();
  Throws throws(seed, r.impacts);
  for (const LawPair& pair : law.pairs) resolve_pair(law, pair.a, pair.b, r.law);
  const bool bodies = bodies_agree(law, r, throws);
  const bool pairs = pairs_agree(law, throws);
  for (const auto& [name, body] : law.bodies)
    if (body.shape) print_shape(name, *body.shape);
  if (!bodies || !pairs) fail(r.law, fmt::format("the law fails its check (seed {})", seed));
  fmt::print(
      "{}: good ({} materials, pairs {}; no closed cycle gains energy; {} fresh impacts in all, seed "
      "{})\n",
      r.law, law.bodies.size(), law.pair_list(), throws.count(), seed);
}

void define(Options& command)
{
  const auto r = std::make_shared<CheckRequest>();
  command.add_option("LAW", r->law, "law file of mpm table")->required();
  command
      .add_option("--impacts", r->impacts, "fresh impacts for each yielding material (default 2; 0: none)")
      ->check(whole_from_to(0, 1000));
  command.add_option("--materials", r->materials,
                     "materials file that the law was made from: needed for the impacts of layered, shaped, "
                     "rate-dependent and nonlinearly hardening bodies");
  command.add_option("--seed", r->seed, "seed of the velocities (default: a new one each time, printed)");
  command.callback([r] { check(*r); });
}

}  // namespace of_check

extern const Command check_command{
    "check",
    "Checks that a law file is complete, conserves energy, and agrees with new solver runs.\n"
    "The runs are impacts at random velocities within the range of the law. They are of each yielding\n"
    "material on a wall, and of the two bodies of each pair with a pair law. Force and e must lie within "
    "twice the error bound.\n"
    "Example: mpm check law.h5",
    of_check::define};

}  // namespace granulaw
