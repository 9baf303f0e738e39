#include "characterise/pair/corrected_law.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "atlas/departure.hpp"
#include "atlas/overlap_at_work.hpp"
#include "base/larger.hpp"
#include "characterise/pair/two_body_runs.hpp"
#include "characterise/run/build_runs.hpp"
#include "characterise/run/refinement.hpp"
#include "characterise/run/resolution_choice.hpp"
#include "law/contact_law.hpp"
#include "law/radiation.hpp"
#include "law/replay.hpp"

namespace granulaw {

namespace {

/// An impact of the two bodies beside the composed law's replay at its speed. Waves and the yielding body's inertia are
/// in both.
struct Beside
{
  static constexpr std::size_t peak = 0;         // ln of the largest force, run over law
  static constexpr std::size_t force = 1;        // ln of the loading force at the same overlap, run over law
  static constexpr std::size_t dissipation = 2;  // -ln(W_u/W_L), run less law
  static constexpr std::size_t residual = 3;     // -ln(1 - delta_r/delta_m), run less law
  static constexpr std::size_t reach = 4;        // ln of the largest overlap, run over law
  static constexpr std::size_t along = 5;        // from here on: `force` at each fraction of the overlap

  double speed, overlap;         // sqrt(I) of the law's axis; in the rule's coordinates
  AtReversal run;                // its largest force, its e
  std::array<double, along + LawShape::VelocityEffect::shares> part{};
};

/// ln(F_run/F_law) of the loading at the same overlap, by the fraction of the overlap that both reach.
class ForceBeside
{
 public:
  ForceBeside(const ContactRecord& run, const Replay& law, double length, double force)
  {
    const double reach = std::min(run.depth, law.delta_max / length);
    std::size_t k = 0;
    for (const ContactRecord::Sample& sample : run.loading) {
      if (sample.x > reach || sample.force <= 0) continue;
      while (k + 2 < law.samples.size() && law.samples[k + 1].delta / length < sample.x) ++k;
      const Replay::Sample &a = law.samples[k], &b = law.samples[k + 1];
      const double place = (sample.x * length - a.delta) / (b.delta - a.delta);
      const double of_law = a.force + place * (b.force - a.force);
      if (of_law > 0) logs_.push_back({sample.x / reach, std::log(sample.force * force / of_law)});
    }
  }
  /// Takes away what the grid and vibrations add.
  double mean(double from, double to) const
  {
    double sum = 0;
    int count = 0;
    for (const auto& [share, log] : logs_)
      if (share >= from && share <= to) sum += log, ++count;
    return count > 0 ? sum / count : 0;
  }

 private:
  std::vector<std::pair<double, double>> logs_;
};

/// The impacts of the two bodies at one ratio of radii, and what they say that the composed law, their guide, is off by.
class PairImpacts
{
 public:
  PairImpacts(const UnlikePair& pair, const ComposedShape& composed, const BuildOptions& options, Farm& farm);
  /// Impacts until each is predicted by the others.
  void sample();
  /// Notes what the corrected law is off by at the impacts, and near the onset of yield, where little is
  /// corrected.
  void compare_with(const TwoBodyLaw& corrected);

  double size_share() const { return 1 / (1 + pair_.radius_ratio); }
  const ComposedShape& composed() const { return composed_; }
  /// The law less the composed one, node by node, and at its speeds.
  LawShape departure() const;
  /// sqrt(I) of the yielding body in the deepest impact.
  double fastest() const { return impacts_.back().speed / composed_.speed_ratio; }
  double sampling_error() const { return sampling_error_; }
  void certify(Certificate& certificate) const;
  const BuildRuns& runs() const { return runs_; }

 private:
  double onset() const { return composed_.shape.onset; }
  double energy() const { return energy_unit(body_.mass, body_.yield); }
  double speed_to(double overlap) const { return std::sqrt(slow_.work(overlap) / energy()); }
  double deepest() const;
  RunJob job(double overlap, int cells) const;
  Replay replay(const BodyLaw& law, double speed) const;
  Beside beside_guide(double overlap, const RunResult& run) const;
  Departure::Function function(std::size_t part, const Beside* left_out = nullptr) const;
  std::vector<LeftOutRun> left_out() const;

  UnlikePair pair_;
  ComposedShape composed_;
  BodyLaw guide_;
  ContactLaw slow_;  // of the composed law
  CharacterisedBody body_;
  BuildOptions options_;
  PairFarm farm_;
  RunSource source_;
  BuildRuns runs_{options_};
  int cells_ = first_resolution;
  std::vector<Beside> impacts_;  // ascending overlap
  CellsError solver_error_;
  AtReversal verification_error_;
  double sampling_error_ = 0;
};

PairImpacts::PairImpacts(const UnlikePair& pair, const ComposedShape& composed, const BuildOptions& options, Farm& farm)
    : pair_(pair),
      composed_(composed),
      guide_(law_of(composed, options).law),
      slow_(composed.shape, composed.end),
      body_(yielding_body(pair)),
      options_(options),
      farm_(farm, pair),
      source_(two_body_runs(pair))
{
  options_.farm = &farm_;
}

/// Overlap of the deepest impact: near the end of the law, or as fast as it goes without ringing, which no cells
/// of a cheap run resolve in two bodies, or as deep as no body is squeezed flat.
double PairImpacts::deepest() const
{
  constexpr double near_end = 0.98;  // by the logarithm of the overlap: an impact may reach further than planned
  const double fastest =
      std::min(ringing, options_.fastest > 0 ? options_.fastest * composed_.speed_ratio : slow_speed);
  return std::min({onset() * std::pow(composed_.end / onset(), near_end), deepest_of_two_bodies(pair_),
                   slow_.overlap_at_work(energy() * fastest * fastest)});
}

RunJob PairImpacts::job(double overlap, int cells) const
{
  constexpr int grids = 2;  // shifted against each other
  return impact_job(body_, speed_to(overlap) * std::sqrt(body_.yield), cells, grids, source_);
}

Replay PairImpacts::replay(const BodyLaw& law, double speed) const
{
  const PairLaw pair{{&law.curve, pair_.mapping(), radiation(pair_.yielding, 1.0, pair_.partner, pair_.radius_ratio)},
                     &law};
  return replay_collision(pair, pair_.r_eff(), pair_.m_eff() * pair_.yielding.density,
                          fastest_of_law(pair_, speed * speed));
}

/// A run at the speed that belongs to `overlap`; it reaches one nearby.
Beside PairImpacts::beside_guide(double overlap, const RunResult& run) const
{
  constexpr double upper = 0.8;      // fraction of the overlap from which the mean is taken
  constexpr double resolved = 0.08;  // below, the contact spans too few cells
  constexpr double half = 0.5 / (LawShape::VelocityEffect::shares - 1);
  const ContactRecord record = contact_record_of(run);
  Beside impact{speed_to(overlap), record.depth, {record.peak, run.summary.restitution}};
  const Replay law = replay(guide_, impact.speed);
  const double length = pair_.mapping().length(pair_.r_eff()), force = pair_.mapping().force(pair_.r_eff());
  const ForceBeside loading(record, law, length, force);
  impact.part[Beside::peak] = std::log(record.peak * force / law.force_max);
  impact.part[Beside::force] = loading.mean(upper, 1);
  impact.part[Beside::dissipation] = -2 * std::log(run.summary.restitution / law.restitution);
  impact.part[Beside::residual] =
      -std::log((1 - record.residual / record.depth) / (1 - law.delta_residual / law.delta_max));
  impact.part[Beside::reach] = std::log(record.depth * length / law.delta_max);
  for (std::size_t k = 0; k < LawShape::VelocityEffect::shares; ++k) {
    const double share = std::max(resolved, 2 * half * static_cast<double>(k));
    impact.part[Beside::along + k] = loading.mean(share - half, share + half);
  }
  // a fast impact's force peaks before its reversal, where the law has the peak
  if (record.reversal_force > 0) impact.part.back() += std::log(record.peak / record.reversal_force);
  return impact;
}

/// One part by overlap/onset, by all impacts but one.
Departure::Function PairImpacts::function(std::size_t part, const Beside* left_out) const
{
  std::vector<Departure::Point> points;
  for (const Beside& impact : impacts_)
    if (&impact != left_out) points.push_back({impact.overlap / onset(), impact.part[part]});
  return Departure::Function(points);
}

std::vector<LeftOutRun> PairImpacts::left_out() const
{
  std::vector<LeftOutRun> runs;
  for (const Beside& impact : impacts_) {
    const auto missed = [&](std::size_t part) {
      return function(part, &impact).at(impact.overlap / onset()) - impact.part[part];
    };
    runs.push_back({std::log(impact.overlap), impact.overlap, impact.run, {}});
    if (&impact != &impacts_.back())  // the deepest would be extrapolated
      runs.back().predicted = {impact.run.force * std::exp(missed(Beside::peak)),
                               impact.run.restitution * std::exp(-0.5 * missed(Beside::dissipation))};
  }
  return runs;
}

void PairImpacts::sample()
{
  constexpr double shallower = 0.7;  // of the overlap, where a run fails
  double last = deepest();
  while (runs_.make({job(last, coarse_partner(first_resolution))}, 0.2).front().failed() && last > 3 * onset())
    last *= shallower;
  const auto error_of = [&](const RunResult& fine, const RunResult& coarse) {
    const Beside a = beside_guide(last, fine), b = beside_guide(last, coarse);
    impacts_ = {a};  // in the end that of the cells which are enough
    const double ratio = static_cast<double>(fine.summary.resolution) / coarse.summary.resolution;
    const auto left = [&](std::size_t part, double power) {
      return rule_of_revolution.left(std::abs(std::expm1(power * (b.part[part] - a.part[part]))), ratio);
    };
    return CellsError{left(Beside::peak, 1), left(Beside::dissipation, 0.5)};
  };
  solver_error_ =
      choose_resolutions({{[&](int n) { return job(last, n); }, &cells_, error_of}}, {}, options_.tolerance, runs_)
          .error;
  std::vector<double> overlaps;
  for (const double place : {0.4, 0.7}) overlaps.push_back(onset() * std::pow(last / onset(), place));
  while (!overlaps.empty()) {
    std::vector<RunJob> jobs;
    for (const double x : overlaps) jobs.push_back(job(x, cells_));
    const auto outcomes = runs_.make_needed(jobs, 0.9, "an impact of the two bodies");
    for (std::size_t k = 0; k < jobs.size(); ++k) impacts_.push_back(beside_guide(overlaps[k], outcomes[k].result));
    std::sort(impacts_.begin(), impacts_.end(), [](const Beside& a, const Beside& b) { return a.overlap < b.overlap; });
    overlaps = bisections(left_out(), options_.tolerance);
    for (double& x : overlaps) x = std::exp(x);
  }
  const std::vector<LeftOutRun> runs = left_out();
  verification_error_ = largest_errors(runs);
  sampling_error_ = largest_miss(runs);
}

void PairImpacts::compare_with(const TwoBodyLaw& corrected)
{
  std::vector<Beside> all = impacts_;
  const double shallow = nearest_to_onset * onset();
  const RunOutcome run = runs_.make_needed({job(shallow, cells_)}, 1.0, "an impact to the onset of yield").front();
  all.push_back(beside_guide(shallow, run.result));
  for (const Beside& impact : all) {
    const Replay law = replay(corrected.law, impact.speed);
    const double force = std::abs(law.force_max / (impact.run.force * pair_.mapping().force(pair_.r_eff())) - 1),
                 e = std::abs(law.restitution / impact.run.restitution - 1);
    verification_error_ = {larger(verification_error_.force, force), larger(verification_error_.restitution, e)};
    sampling_error_ = larger(sampling_error_, counted(force, e, impact.run.restitution));
  }
}

/// The departure of the force near the peaks corrects the slow law; the rest of it along an impact is inertia, of which
/// a composed law has the yielding body's alone: a soft partner's is larger.
LawShape PairImpacts::departure() const
{
  const Departure::Function force = function(Beside::force), residual = function(Beside::residual),
                            dissipation = function(Beside::dissipation), reach = function(Beside::reach);
  LawShape shape = LawShape::zero(onset(), composed_.end);
  for (std::size_t node = 1; node < LawShape::nodes; ++node) {
    const double over_onset = shape.overlap(node) / onset();
    shape.force_reduction[node] = -force.at(over_onset);
    shape.residual[node] = residual.at(over_onset);
    shape.dissipation[node] = dissipation.at(over_onset);
  }
  shape.velocity_effects = composed_.shape.velocity_effects;
  for (LawShape::VelocityEffect& effect : shape.velocity_effects) {
    const double over_onset = effect.speed * std::exp(effect.log_overlap) / onset();
    effect = {effect.speed, reach.at(over_onset), 0, 0, effect.force};
    for (std::size_t k = 0; k < effect.force.size(); ++k) {
      const double share = static_cast<double>(k) / (LawShape::VelocityEffect::shares - 1);
      effect.force[k] = function(Beside::along + k).at(over_onset) - force.at(share * over_onset);
    }
  }
  return shape;
}

void PairImpacts::certify(Certificate& c) const
{
  c.verification_error_force = larger(c.verification_error_force, verification_error_.force);
  c.verification_error_restitution = larger(c.verification_error_restitution, verification_error_.restitution);
  c.verification_impacts += static_cast<double>(impacts_.size()) - 1;  // the deepest is not left out
  c.solver_error_force = larger(c.solver_error_force, solver_error_.force);
  c.solver_error_restitution = larger(c.solver_error_restitution, solver_error_.restitution);
}

/// Ascending ratios at which impacts are made.
std::vector<double> sampled_ratios(std::span<const double> ratios)
{
  std::vector<double> chosen;
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  for (const double ratio : ratios) {
    if (ratio == 0 || std::isinf(ratio)) continue;
    smallest = std::min(smallest, ratio);
    largest = larger(largest, ratio);
  }
  if (largest > 0) chosen = {smallest, std::clamp(1.0, smallest, largest), largest};
  for (const double ratio : ratios)
    if (std::isinf(ratio)) chosen.push_back(ratio);
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

/// Impacts of the ratios beside this fraction of sizes, each with its weight: linear between them. They ascend in
/// their ratio.
struct Neighbour
{
  const PairImpacts* impacts;
  double weight;
};
std::vector<Neighbour> neighbours_of(const std::vector<std::unique_ptr<PairImpacts>>& all, double size_share)
{
  std::size_t k = 0;
  while (k < all.size() && all[k]->size_share() > size_share) ++k;
  if (k == 0 || k == all.size()) return {{all[k == 0 ? 0 : k - 1].get(), 1}};
  const double high = all[k]->size_share(), low = all[k - 1]->size_share();
  if (high == size_share) return {{all[k].get(), 1}};
  const double share = (size_share - low) / (high - low);
  return {{all[k - 1].get(), 1 - share}, {all[k].get(), share}};
}

/// An impact's force at fractions of its overlap: to the peak at its reversal, before no more, so that it rises by at
/// least a part of what the slow law does.
void make_rise(LawShape::VelocityEffect& effect, const LawShape& slow)
{
  constexpr double least = 0.3;  // of the slow law's rise between two fractions; cubics between them miss less
  const double overlap = effect.speed * std::exp(effect.log_overlap);
  const Spline reduction = slow.by_q(&LawShape::force_reduction);
  const auto log_force = [&](std::size_t share) {
    const double x = std::min(overlap, slow.end) * static_cast<double>(share) / (LawShape::VelocityEffect::shares - 1);
    return 1.5 * std::log(x) + std::log(slow.elastic.force_ratio(std::pow(x, 0.25))) - reduction.value(slow.q(x));
  };
  for (std::size_t k = effect.force.size() - 1; k-- > 1;)
    effect.force[k] = std::min(effect.force[k], effect.force[k + 1] + (1 - least) * (log_force(k + 1) - log_force(k)));
  effect.force[0] = std::min(effect.force[0], effect.force[1]);
}

TwoBodyLaw corrected(ComposedShape composed, const std::vector<Neighbour>& neighbours, const LawRange& range)
{
  double fastest = std::numeric_limits<double>::infinity();
  for (const auto& [impacts, weight] : neighbours) {
    composed.shape.add(weight, impacts->departure());
    fastest = std::min(fastest, impacts->fastest());
  }
  for (LawShape::VelocityEffect& effect : composed.shape.velocity_effects) make_rise(effect, composed.shape);
  composed.stated.solver = 0;  // but that of the impacts (certify)
  composed.damage_number_max = std::max(composed.damage_number_max, fastest * fastest);
  return law_of(composed, range);
}

}  // namespace

CorrectedLaws corrected_laws(const UnlikePair& pair, const PairBody& yielding, const PairBody& partner,
                             std::span<const double> ratios, const BuildOptions& options)
{
  check(options);
  ThreadFarm alone(1);
  Farm& farm = options.farm ? *options.farm : alone;
  const auto composed = [&](double ratio) { return compose_shape(*options.atlas, yielding, partner, ratio, options); };
  CorrectedLaws made;
  std::vector<std::unique_ptr<PairImpacts>> impacts;  // which stay where they are: jobs refer to them
  for (const double ratio : sampled_ratios(ratios)) {
    UnlikePair at_ratio = pair;
    at_ratio.radius_ratio = ratio;
    PairImpacts& own = *impacts.emplace_back(std::make_unique<PairImpacts>(at_ratio, composed(ratio), options, farm));
    own.sample();
    own.compare_with(corrected(own.composed(), {{&own, 1}}, options));
    made.runs += own.runs().count();
    made.holes.insert(made.holes.end(), own.runs().holes().begin(), own.runs().holes().end());
    made.sampling_error = larger(made.sampling_error, own.sampling_error());
  }
  for (const double ratio : ratios) {
    const std::vector<Neighbour> neighbours = neighbours_of(impacts, 1 / (1 + ratio));
    TwoBodyLaw& law = made.laws.emplace_back(corrected(composed(ratio), neighbours, options));
    for (const Neighbour& neighbour : neighbours) neighbour.impacts->certify(law.law.certificate);
    law.law.state();
    leave_out_axis(law, pair.partner, options.tolerance);
  }
  return made;
}

}  // namespace granulaw
