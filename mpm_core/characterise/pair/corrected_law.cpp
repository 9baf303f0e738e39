#include "characterise/pair/corrected_law.hpp"

#include "characterise/run/request.hpp"

#include <algorithm>
#include <array>
#include <boost/math/interpolators/makima.hpp>
#include <cmath>
#include <deque>
#include <limits>

#include "base/error.hpp"
#include "base/larger.hpp"
#include "characterise/run/build_runs.hpp"
#include "atlas/overlap_at_work.hpp"
#include "characterise/run/refinement.hpp"
#include "characterise/run/resolution_choice.hpp"
#include "characterise/pair/two_body_runs.hpp"
#include "law/radiation.hpp"
#include "law/replay.hpp"
#include "solver/run/accuracy.hpp"

namespace granulaw {

namespace {

/// Departure of an impact of the two bodies from the composed law at the same speed, at its place
/// ln(overlap/onset)/ln(end/onset).
struct PairDeparture
{
  static constexpr std::size_t peak = 0;         // ln of the largest force, run over law
  static constexpr std::size_t force = 1;        // ln of the loading force at the same overlap, run over law
  static constexpr std::size_t dissipation = 2;  // -ln(W_u/W_L), run less law
  static constexpr std::size_t residual = 3;     // -ln(1 - delta_r/delta_m), run less law
  static constexpr std::size_t reach = 4;        // ln of the largest overlap, run over law
  static constexpr std::size_t along = 5;        // from here on: `force` at each fraction of the overlap

  double place = 0;
  std::array<double, along + LawShape::VelocityEffect::shares> part{};
};

/// One part of the departures as a function of the place: 0 up to the onset, which it leaves with slope 0, so
/// it is interpolated as an even function; beyond the last impact it keeps its value.
double at(const std::vector<PairDeparture>& departures, std::size_t part, double place)
{
  if (place <= 0) return 0;
  if (place >= departures.back().place) return departures.back().part[part];
  std::vector<double> places{0}, values{0};
  for (const PairDeparture& d : departures)
    for (const double side : {-1.0, 1.0}) {
      const auto where = side < 0 ? places.begin() : places.end();
      values.insert(values.begin() + (where - places.begin()), d.part[part]);
      places.insert(where, side * d.place);
    }
  if (departures.size() == 1) {  // makima needs four
    places.push_back(2 * places.back());
    values.push_back(values.back());
  }
  return boost::math::interpolators::makima(std::move(places), std::move(values))(place);
}

/// The range of a law that keeps its velocity axis down to a tenth of the tolerance. By the yielding body's damage
/// number a shallow law has none, but the inertia of a soft partner counts there.
LawRange with_axis(LawRange range)
{
  range.tolerance *= 0.1;
  return range;
}

/// The impacts of the two bodies at one ratio of radii, beside the composed law.
class PairImpacts
{
 public:
  PairImpacts(const UnlikePair& pair, ComposedShape composed, const BuildOptions& options, Farm& farm)
      : pair_(pair),
        composed_(std::move(composed)),
        guide_(law_of(composed_, with_axis(options))),
        body_(yielding_body(pair)),
        options_(options),
        farm_(farm, pair),
        source_(two_body_runs(pair))
  {
    options_.farm = &farm_;
  }

  /// Impacts until each is predicted by the others, or there are enough of them.
  void sample();

  double radius_ratio() const { return pair_.radius_ratio; }
  const ComposedShape& composed() const { return composed_; }
  /// sqrt(I) of the yielding body in the deepest impact.
  double fastest() const { return runs_taken_.back().speed / composed_.speed_ratio; }
  /// Takes what the corrected law misses of the impacts themselves, where its force was made to rise.
  void compare_with(const TwoBodyLaw& corrected);
  const std::vector<PairDeparture>& departures() const { return departures_; }
  const CellsError& solver_error() const { return solver_error_; }
  /// Leave-one-out error: of F, of e (both relative), and the larger of the two on the scale of the
  /// tolerance.
  struct Miss
  {
    double force = 0, restitution = 0, counted = 0;
  };
  Miss largest_miss() const;
  static Miss larger_of_each(const Miss& a, const Miss& b)
  {
    return {larger(a.force, b.force), larger(a.restitution, b.restitution), larger(a.counted, b.counted)};
  }
  std::size_t count() const { return runs_.count(); }
  const std::vector<std::string>& holes() const { return runs_.holes(); }

 private:
  double overlap_at(double place) const { return onset() * std::pow(composed_.end / onset(), place); }
  double place_of(double overlap) const
  {
    return std::log(overlap / onset()) / std::log(composed_.end / onset());
  }
  double onset() const { return composed_.body.onset; }
  double speed_to(double overlap) const;
  double last_place() const;
  RunJob job(double place, int cells) const;
  void begin();
  void check_onset();
  PairDeparture departure(double place, const RunResult& run) const;
  void take(double place, const RunResult& run);
  Replay replay(const TwoBodyLaw& two, double speed) const;
  Miss miss(std::size_t left_out) const;
  std::vector<double> bisections() const;

  UnlikePair pair_;
  ComposedShape composed_;
  TwoBodyLaw guide_;
  CharacterisedBody body_;
  BuildOptions options_;
  PairFarm farm_;
  RunSource source_;
  BuildRuns runs_{options_};
  std::vector<PairDeparture> departures_;  // ascending place
  struct Taken
  {
    double speed, force, restitution;
  };
  std::vector<Taken> runs_taken_;  // of the departures
  int cells_ = first_resolution;
  Miss at_onset_;
  Miss of_law_;  // of the corrected law at the impacts themselves
  CellsError solver_error_;
};

constexpr int grids = 2;  // shifted against each other

/// sqrt(I) of the impact whose energy is the law's loading work up to this overlap.
double PairImpacts::speed_to(double overlap) const
{
  return std::sqrt(guide_.law.curve.work(overlap) / energy_unit(body_.mass, body_.yield));
}

/// Place of the deepest impact: at the end of the law, or as fast as it goes without ringing, which no cells
/// of a cheap run resolve in two bodies, or as deep as no body is squeezed flat.
double PairImpacts::last_place() const
{
  const double fastest =
      std::min(ringing, options_.fastest > 0 ? options_.fastest * composed_.speed_ratio : slow_speed);
  const double flattest = deepest_of_two_bodies(pair_);
  const auto reached = [&](double place) {
    return overlap_at(place) <= flattest && speed_to(overlap_at(place)) <= fastest;
  };
  double low = 0.1, high = 0.98;
  if (reached(high)) return high;
  for (int round = 0; round < 30; ++round) {
    const double middle = 0.5 * (low + high);
    (reached(middle) ? low : high) = middle;
  }
  return low;
}

RunJob PairImpacts::job(double place, int cells) const
{
  const double velocity = speed_to(overlap_at(place)) * std::sqrt(body_.yield);
  return impact_job(body_, velocity, cells, grids, source_);
}

Replay PairImpacts::replay(const TwoBodyLaw& two, double speed) const
{
  const PairLaw law{{&two.law.curve, pair_.mapping(),
                     radiation(pair_.yielding, 1.0, pair_.partner, pair_.radius_ratio)},
                    &two.law};
  return replay_collision(law, pair_.r_eff(), pair_.m_eff() * pair_.yielding.density,
                          fastest_of_law(pair_, speed * speed));
}

/// ln(F_run/F_law) of the loading at the same overlap, as a mean over a range of the overlap that both reach. The
/// upper part is the peak's; means take away what the grid and vibrations add.
class ForceDeparture
{
 public:
  ForceDeparture(const ContactRecord& run, const Replay& law, double length, double force)
      : reach_(std::min(run.depth, law.delta_max / length))
  {
    std::size_t k = 0;
    for (const ContactRecord::Sample& sample : run.loading) {
      if (sample.x > reach_ || sample.force <= 0) continue;
      while (k + 2 < law.samples.size() && law.samples[k + 1].delta / length < sample.x) ++k;
      const Replay::Sample &a = law.samples[k], &b = law.samples[k + 1];
      const double place = (sample.x * length - a.delta) / (b.delta - a.delta);
      const double of_law = a.force + place * (b.force - a.force);
      if (of_law > 0) logs_.push_back({sample.x, std::log(sample.force * force / of_law)});
    }
  }
  double mean(double from, double to) const  // fractions of the overlap
  {
    double sum = 0;
    int count = 0;
    for (const auto& [x, log] : logs_)
      if (x >= from * reach_ && x <= to * reach_) sum += log, ++count;
    return count > 0 ? sum / count : 0;
  }

 private:
  double reach_;
  std::vector<std::pair<double, double>> logs_;
};

/// PairDeparture of a run at the speed that belongs to `place`; it reaches one nearby.
PairDeparture PairImpacts::departure(double place, const RunResult& run) const
{
  constexpr double upper = 0.8;      // fraction of the overlap from which the mean is taken
  constexpr double resolved = 0.08;  // below, the contact spans too few cells
  constexpr double half = 0.5 / (LawShape::VelocityEffect::shares - 1);
  const ContactRecord record = contact_record_of(run);
  const Replay law = replay(guide_, speed_to(overlap_at(place)));
  const double length = pair_.mapping().length(pair_.r_eff()), force = pair_.mapping().force(pair_.r_eff());
  const ForceDeparture loading(record, law, length, force);
  using D = PairDeparture;
  D d;
  d.place = place_of(record.depth);
  d.part[D::peak] = std::log(record.peak * force / law.force_max);
  d.part[D::force] = loading.mean(upper, 1);
  d.part[D::dissipation] = -2 * std::log(run.summary.restitution / law.restitution);
  d.part[D::residual] = -std::log((1 - record.residual / record.depth) / (1 - law.delta_residual / law.delta_max));
  d.part[D::reach] = std::log(record.depth * length / law.delta_max);
  for (std::size_t k = 0; k < LawShape::VelocityEffect::shares; ++k) {
    const double share = std::max(resolved, 2 * half * static_cast<double>(k));
    d.part[D::along + k] = loading.mean(share - half, share + half);
  }
  // a fast impact's force peaks before its reversal, where the law has the peak
  if (record.reversal_force > 0) d.part.back() += std::log(record.peak / record.reversal_force);
  return d;
}

void PairImpacts::take(double place, const RunResult& run)
{
  const PairDeparture d = departure(place, run);
  const auto where =
      std::upper_bound(departures_.begin(), departures_.end(), d.place,
                       [](double value, const PairDeparture& other) { return value < other.place; });
  runs_taken_.insert(runs_taken_.begin() + (where - departures_.begin()),
                     {speed_to(overlap_at(place)), contact_record_of(run).peak, run.summary.restitution});
  departures_.insert(where, d);
}

PairImpacts::Miss PairImpacts::miss(std::size_t left_out) const
{
  std::vector<PairDeparture> others = departures_;
  const PairDeparture d = others[left_out];
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(left_out));
  const auto missed = [&](std::size_t part) { return at(others, part, d.place) - d.part[part]; };
  const double force = std::abs(std::expm1(missed(PairDeparture::peak)));
  const double e = std::abs(std::expm1(0.5 * missed(PairDeparture::dissipation)));
  return {force, e, counted(force, e, runs_taken_[left_out].restitution)};
}

PairImpacts::Miss PairImpacts::largest_miss() const
{
  Miss largest = larger_of_each(at_onset_, of_law_);
  for (std::size_t k = 0; k + 1 < departures_.size(); ++k)  // the deepest would be extrapolated
    largest = larger_of_each(largest, miss(k));
  return largest;
}

void PairImpacts::compare_with(const TwoBodyLaw& corrected)
{
  const double unit = pair_.mapping().force(pair_.r_eff());
  for (const Taken& run : runs_taken_) {
    const Replay law = replay(corrected, run.speed);
    const double force = std::abs(law.force_max / (run.force * unit) - 1),
                 e = std::abs(law.restitution / run.restitution - 1);
    of_law_ = larger_of_each(of_law_, {force, e, counted(force, e, run.restitution)});
  }
}

/// Places half-way between each impact that is missed and its neighbours.
std::vector<double> PairImpacts::bisections() const
{
  std::vector<double> places;
  for (std::size_t k = 0; k + 1 < departures_.size(); ++k) {
    if (miss(k).counted <= options_.tolerance) continue;
    const double here = departures_[k].place;
    if (k > 0) places.push_back(0.5 * (departures_[k - 1].place + here));
    places.push_back(0.5 * (here + departures_[k + 1].place));
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

/// Error of the cells of what is taken from a run.
CellsError index_between(const PairDeparture& fine, const PairDeparture& coarse, double cell_ratio)
{
  const auto change = [&](std::size_t part) { return coarse.part[part] - fine.part[part]; };
  return {rule_of_revolution.left(std::abs(std::expm1(change(PairDeparture::peak))), cell_ratio),
          rule_of_revolution.left(std::abs(std::expm1(0.5 * change(PairDeparture::dissipation))), cell_ratio)};
}

/// The first three impacts, with cells so many that they are known within the tolerance, or the most; the
/// deepest as deep as the solver follows it.
void PairImpacts::begin()
{
  constexpr double shallower = 0.7;  // of the overlap, where a run failed
  constexpr double shallowest = 0.3;
  double last = last_place();
  for (int cells = first_resolution; cells < last_resolution; cells = finer_rung(cells)) {
    cells_ = cells;
    const int coarse_cells = coarse_partner(cells);
    std::vector<RunOutcome> outcomes;
    const auto failed = [&] {
      return std::any_of(outcomes.begin(), outcomes.end(), [](const RunOutcome& o) { return o.failed(); });
    };
    for (bool first = true; first || failed(); first = false) {
      if (!first) last = place_of(shallower * overlap_at(last));
      if (last < shallowest) fail("an impact of the two bodies", outcomes.back().error);
      outcomes = runs_.make(
          {job(0.4 * last, cells), job(0.7 * last, cells), job(last, cells), job(last, coarse_cells)}, 0.7);
    }
    departures_.clear();
    runs_taken_.clear();
    take(0.4 * last, outcomes[0].result);
    take(0.7 * last, outcomes[1].result);
    take(last, outcomes[2].result);
    solver_error_ = index_between(departures_.back(), departure(last, outcomes[3].result),
                                  static_cast<double>(cells) / coarse_cells);
    const double error =
        counted(solver_error_.force, solver_error_.restitution, runs_taken_.back().restitution);
    if (error <= options_.tolerance) return;
  }
}

/// An impact to the onset of yield, up to which nothing is corrected: what the law is off by there.
void PairImpacts::check_onset()
{
  constexpr double barely = 0.02;  // a place: the overlap is the onset's, as good as
  const RunOutcome outcome =
      runs_.make_needed({job(barely, cells_)}, 0.8, "an impact to the onset of yield").front();
  const PairDeparture d = departure(barely, outcome.result);
  const double force = std::abs(std::expm1(d.part[PairDeparture::peak])),
               e = std::abs(std::expm1(0.5 * d.part[PairDeparture::dissipation]));
  at_onset_ = {force, e, counted(force, e, outcome.result.summary.restitution)};
}

void PairImpacts::sample()
{
  constexpr std::size_t most = 9;
  begin();
  check_onset();
  for (std::vector<double> places = bisections(); !places.empty(); places = bisections()) {
    if (departures_.size() + places.size() > most) return;
    std::vector<RunJob> jobs;
    for (const double place : places) jobs.push_back(job(place, cells_));
    const std::vector<RunOutcome> outcomes = runs_.make_needed(jobs, 1.0, "an impact of the two bodies");
    for (std::size_t k = 0; k < places.size(); ++k) take(places[k], outcomes[k].result);
  }
}

/// The impacts' departures at any ratio of radii, linear in the fraction of sizes between those that were
/// made.
class Correction
{
 public:
  explicit Correction(const std::deque<PairImpacts>& impacts) : impacts_(impacts) {}

  double at(double size_share, std::size_t part, double place) const
  {
    const auto [low, high, share] = between(size_share);
    const double first = granulaw::at(impacts_[low].departures(), part, place);
    const double second = granulaw::at(impacts_[high].departures(), part, place);
    return first + share * (second - first);
  }

  /// Impacts of the ratios between which it lies.
  std::vector<const PairImpacts*> neighbours(double size_share) const
  {
    const Between b = between(size_share);
    if (b.low == b.high) return {&impacts_[b.low]};
    return {&impacts_[b.low], &impacts_[b.high]};
  }

 private:
  struct Between
  {
    std::size_t low, high;
    double share;
  };
  static double share_of(const PairImpacts& impacts) { return 1 / (1 + impacts.radius_ratio()); }

  /// Impacts descend in their fraction of sizes.
  Between between(double size_share) const
  {
    std::size_t k = 0;
    while (k < impacts_.size() && share_of(impacts_[k]) > size_share) ++k;
    if (k == 0) return {0, 0, 0};
    if (k == impacts_.size()) return {k - 1, k - 1, 0};
    const double low = share_of(impacts_[k - 1]), high = share_of(impacts_[k]);
    if (high == size_share) return {k, k, 0};
    return {k - 1, k, (size_share - low) / (high - low)};
  }

  const std::deque<PairImpacts>& impacts_;
};

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

/// The departure of the force near the peaks corrects the slow law; the rest of it along an impact is inertia, of which
/// a composed law has the yielding body's alone: a soft partner's is larger.
void correct(ComposedShape& composed, const Correction& correction)
{
  using D = PairDeparture;
  const double size_share = 1 / (1 + composed.radius_ratio);
  LawShape& shape = composed.shape;
  composed.stated.solver = 0;  // but that of the impacts (certify)
  const auto place_of = [&](double x) { return std::log(x / shape.onset) / std::log(shape.end / shape.onset); };
  for (std::size_t node = 1; node < LawShape::nodes; ++node) {
    const double place = static_cast<double>(node) / (LawShape::nodes - 1);
    shape.force_reduction[node] -= correction.at(size_share, D::force, place);
    shape.dissipation[node] += correction.at(size_share, D::dissipation, place);
    shape.residual[node] += correction.at(size_share, D::residual, place);
  }
  for (LawShape::VelocityEffect& effect : shape.velocity_effects) {
    const double overlap = effect.speed * std::exp(effect.log_overlap), place = place_of(overlap);
    effect.log_overlap += correction.at(size_share, D::reach, place);
    for (std::size_t k = 0; k < effect.force.size(); ++k) {
      const double share = static_cast<double>(k) / (LawShape::VelocityEffect::shares - 1);
      effect.force[k] += correction.at(size_share, D::along + k, place);
      if (k > 0) effect.force[k] -= correction.at(size_share, D::force, place_of(share * overlap));
    }
    make_rise(effect, shape);
  }
}

void certify(Certificate& c, const std::vector<const PairImpacts*>& neighbours)
{
  for (const PairImpacts* impacts : neighbours) {
    const PairImpacts::Miss miss = impacts->largest_miss();
    c.verification_error_force = larger(c.verification_error_force, miss.force);
    c.verification_error_restitution = larger(c.verification_error_restitution, miss.restitution);
    c.verification_impacts += static_cast<double>(impacts->departures().size()) - 1;
    c.solver_error_force = larger(c.solver_error_force, impacts->solver_error().force);
    c.solver_error_restitution = larger(c.solver_error_restitution, impacts->solver_error().restitution);
  }
}

}  // namespace

CorrectedLaws corrected_laws(const UnlikePair& pair, const PairBody& yielding, const PairBody& partner,
                             std::span<const double> ratios, const BuildOptions& options)
{
  check(options);
  ThreadFarm alone(1);
  Farm& farm = options.farm ? *options.farm : alone;
  CorrectedLaws made;
  std::deque<PairImpacts> impacts;  // which stay where they are: jobs refer to them
  const std::vector<double> sampled = sampled_ratios(ratios);
  for (const double ratio : sampled) {
    UnlikePair at_ratio = pair;
    at_ratio.radius_ratio = ratio;
    impacts.emplace_back(at_ratio, compose_shape(*options.atlas, yielding, partner, ratio, options), options,
                         farm);
    impacts.back().sample();
    made.runs += impacts.back().count();
    made.holes.insert(made.holes.end(), impacts.back().holes().begin(), impacts.back().holes().end());
  }
  const Correction correction(impacts);
  const LawRange range = with_axis(options);
  for (PairImpacts& of_ratio : impacts) {
    ComposedShape composed = of_ratio.composed();
    correct(composed, correction);
    of_ratio.compare_with(law_of(composed, range));
    made.sampling_error = larger(made.sampling_error, of_ratio.largest_miss().counted);
  }
  for (const double ratio : ratios) {
    ComposedShape composed = compose_shape(*options.atlas, yielding, partner, ratio, options);
    correct(composed, correction);
    const std::vector<const PairImpacts*> neighbours = correction.neighbours(1 / (1 + ratio));
    double fastest = std::numeric_limits<double>::infinity();  // of the impacts beside it
    for (const PairImpacts* beside : neighbours) fastest = std::min(fastest, beside->fastest());
    composed.damage_number_max = std::max(composed.damage_number_max, fastest * fastest);
    made.laws.push_back(law_of(composed, range));
    certify(made.laws.back().law.certificate, neighbours);
  }
  return made;
}

}  // namespace granulaw
