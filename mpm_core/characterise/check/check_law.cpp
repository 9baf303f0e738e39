#include "characterise/check/check_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "base/error.hpp"
#include "base/scales.hpp"
#include "characterise/body/law_body.hpp"
#include "characterise/body/law_material.hpp"
#include "characterise/file/law_file_plan.hpp"
#include "characterise/pair/two_body_runs.hpp"
#include "characterise/shape/shape_certificate.hpp"
#include "law/pair_names.hpp"
#include "law/replay.hpp"
#include "solver/runs.hpp"

namespace granulaw {

namespace {

/// Slowest speed of impact, over sqrt(E*/rho), that says something of the law: twice that of first yield, and
/// within its velocity axis.
double slowest_of(const BodyLaw& body)
{
  const LawMaterial& m = body.material;
  const double yield = m.yield_stress / m.e_star();
  const double slow = 2 * onset_velocity(1.0, yield, 1.0, m.poisson_ratio);
  const AxisTable* axis = body.curve.axis();
  return axis ? std::max(slow, axis->speed_begin * std::sqrt(yield)) : slow;
}

/// The body whose law it is. The law keeps five numbers a material: where more determine it, `materials` give
/// them; nothing without these.
std::optional<CharacterisedBody> body_for(const std::string& name, const Law& law, const Materials* materials)
{
  const auto made_from = law.provenance.find("material_hash." + name);
  const std::string hash = made_from == law.provenance.end() ? std::string() : made_from->second;
  if (!materials) {
    const Material plain = material_of(law.bodies.at(name).material);
    const CharacterisedBody characterised = characterised_body_of(plain);
    return hash.empty() || hash == material_hash(characterised, plain) ? std::optional(characterised) : std::nullopt;
  }
  const LawBody body = law_body(name, *materials);
  const std::optional<ShapeCertificate>& certified = law.bodies.at(name).shape;
  if (certified && (!body.shape || shape_text(*shape_of(*body.shape)) != certified->shape))
    fail(materials->source, fmt::format("'{}' has another shape than the law's certificate", name));
  if (!hash.empty() && hash != body.hash)
    fail(materials->source, fmt::format("'{}' is not what the law was made from", name), body.hash, hash);
  return body.characterised;
}

/// Law of the least unlike sizes among a pair's.
const TwoBodyLaw& least_unlike(const std::vector<TwoBodyLaw>& laws)
{
  return *std::min_element(laws.begin(), laws.end(), [](const TwoBodyLaw& a, const TwoBodyLaw& b) {
    return std::abs(a.size_share() - 0.5) < std::abs(b.size_share() - 0.5);
  });
}

class Checking
{
 public:
  Checking(const Law& law, const LawCheckRequest& request, const Progress& progress,
           const std::function<void(const FreshImpact&)>& made)
      : law_(law), request_(request), progress_(progress), made_(made), random_(request.seed)
  {
  }

  LawCheck operator()()
  {
    for (const LawPair& pair : law_.pairs) resolve_pair(law_, pair.a, pair.b, request_.source);
    for (const auto& [name, body] : law_.bodies) check_body(name, body);
    for (const auto& [name, laws] : law_.pair_laws) check_pair(name, least_unlike(laws));
    return std::move(check_);
  }

 private:
  void check_body(const std::string& name, const BodyLaw& body)
  {
    if (!body.material.yields() || request_.impacts == 0) return;
    const std::optional<CharacterisedBody> characterised = body_for(name, law_, request_.materials);
    if (!characterised) return check_.skipped.push_back(name);
    const Scales& scale = characterised->scale;
    const Scales unit{scale.length, body.material.e_star(), body.material.density};
    for (const double velocity : velocities(slowest_of(body), body)) {
      const RunSummary run =
          impact(characterised->particle, {velocity * scale.velocity()}, {}, options_of(name)).summary;
      const Replay replay =
          replay_on_wall(body, unit.length, characterised->mass * unit.mass(), velocity * unit.velocity());
      keep(name, body.bound.at(velocity / std::sqrt(body.material.yield_stress / body.material.e_star())),
           velocity * unit.velocity(), run, run.force_max / scale.force(), replay, unit.force());
    }
  }

  /// At the radii that the pair's law was made for, in units of the yielding body.
  void check_pair(const std::string& name, const TwoBodyLaw& own)
  {
    if (!own.law.material.yields()) return;
    const auto [a, b] = split_pair(name);
    const LawMaterial &of_a = law_.bodies.at(a).material, &of_b = law_.bodies.at(b).material;
    const UnlikePair pair = unlike_pair(of_a, of_b, own.radius_ratio);
    const PairLaw law = yields_first(of_a, of_b) ? resolve_pair(law_, a, b, name, 1.0, own.radius_ratio)
                                                 : resolve_pair(law_, b, a, name, 1.0, own.radius_ratio);
    const LawMaterial& yielding = pair.yielding;
    for (const double velocity : velocities(slowest_of(own.law) / pair.axis_speed_ratio(), own.law)) {
      const double relative =
          velocity * std::sqrt(yielding.e_star() / yielding.density) * pair.mapping().sqrt_lambda;  // m/s
      const RunSummary run = run_two_bodies(pair, relative, options_of(name));
      const Replay replay = replay_collision(law, pair.r_eff(), pair.m_eff() * yielding.density, relative);
      const double v = law.axis_speed(pair.r_eff(), pair.m_eff() * yielding.density, relative);
      keep(name, own.law.bound.at(v), relative, run, run.force_max, replay, yielding.e_star());
    }
  }

  /// So many as wanted, over sqrt(E*/rho), from `slow` to the end of the law's rate-independent range.
  std::vector<double> velocities(double slow, const BodyLaw& body)
  {
    const double yield = body.material.yield_stress / body.material.e_star();
    const double fast = std::max(1.01 * slow, std::sqrt(body.certificate.damage_number_max * yield));
    std::uniform_real_distribution<double> logarithm(std::log(slow), std::log(fast));
    std::vector<double> drawn(static_cast<std::size_t>(request_.impacts));
    for (double& velocity : drawn) velocity = std::exp(logarithm(random_));
    return drawn;
  }

  RunOptions options_of(const std::string& name) const
  {
    RunOptions options;
    if (progress_) options.progress = [this, name](double done) { progress_(done, "check " + name); };
    return options;
  }

  /// `force`: of the run, in units of `unit`, N.
  void keep(const std::string& name, const ErrorBound& bound, double velocity, const RunSummary& run,
            double force, const Replay& replay, double unit)
  {
    FreshImpact found{name, velocity, std::abs(replay.force_max / unit / force - 1),
                      std::abs(replay.restitution / run.restitution - 1), 0, bound};
    found.restitution_bound = found.bound.restitution_at(run.restitution) / run.restitution;
    if (made_) made_(found);
    check_.impacts.push_back(std::move(found));
  }

  const Law& law_;
  const LawCheckRequest& request_;
  const Progress& progress_;
  const std::function<void(const FreshImpact&)>& made_;
  std::mt19937 random_;
  LawCheck check_;
};

}  // namespace

bool LawCheck::agrees() const
{
  return std::all_of(impacts.begin(), impacts.end(), [](const FreshImpact& found) { return found.agrees(); });
}

LawCheck check_law(const Law& law, const LawCheckRequest& request, const Progress& progress,
                   const std::function<void(const FreshImpact&)>& made)
{
  if (request.impacts < 0) fail("impacts", "cannot be used", std::to_string(request.impacts), "0 or more");
  return Checking(law, request, progress, made)();
}

}  // namespace granulaw
