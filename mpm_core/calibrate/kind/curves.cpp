// Curves of force against displacement: between two platens, on a flat, under an indenter.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/scales.hpp"
#include "calibrate/condense.hpp"
#include "calibrate/kind/composed.hpp"
#include "calibrate/kind/kind.hpp"
#include "calibrate/misfit.hpp"
#include "calibrate/noise.hpp"

namespace granulaw {

namespace {

/// A contact's slow law, the units that bring it to a measured curve, and its errors (sd).
struct CurveModel
{
  const Curve& curve;
  double length, force;   ///< m, N
  double force_error;     ///< relative
  double recovery_error;  ///< of the unloading, over the largest overlap less the residual
};

/// Unloading from `top` where the overlap is this fraction of the recovery, the largest overlap less the
/// residual, above the residual.
double unloading_force(const Reversal& top, double share)
{
  const double u = std::min(share, 1.0);
  return share > 0 ? top.force_at(u, std::sqrt(u)) : 0.0;
}

Prediction predict_curve(const Measurement& m, const CurveModel& model, const MachineState& machine)
{
  // of ln overlap and of the recovery: of finite-element curves and of presses, as their rows depart from a
  // fit
  constexpr double loading_length = 0.2, unloading_length = 0.2;
  constexpr double span = 4.6;        // ln 100: of the overlap, over which the errors were measured
  constexpr double roughness = 1e-3;  // of the largest force: contact curves of the atlas are no smoother
  Prediction p;
  p.errors.resize(m.kind->smooth_errors);
  const double unit = m.kind->contacts * model.length;
  const auto overlap = [&](const Datum& d) {
    return (d.x - machine.offset - machine.compliance * d.y) / unit;
  };
  const std::vector<Unloading> unloadings = m.unloadings();
  const auto reversal_point = [&](std::size_t k) {
    const std::size_t first = unloadings[k].first;
    return std::max(overlap(m.data[first]), overlap(m.data[first - 1])) +
           std::max(0.0, k < machine.beyond.size() ? machine.beyond[k] : 0.0) / unit;
  };
  double x_m = 1e-12;
  for (const Datum& d : m.data) x_m = std::max(x_m, overlap(d));
  for (std::size_t k = 0; k < unloadings.size(); ++k) x_m = std::max(x_m, reversal_point(k));
  const double rough = roughness * m.largest_y();
  // The checks' errors are each one curve's: smooth. Unloading is off by a fraction of what it recovers,
  // however far the press went.
  const double factor_error = model.force_error, recovery_error = model.recovery_error;
  double reached = 0;
  Reversal top;
  auto unloading = unloadings.begin();
  for (std::size_t k = 0; k < m.data.size(); ++k) {
    if (unloading != unloadings.end() && k == unloading->first) {
      reached = std::max(reached, reversal_point(static_cast<std::size_t>(unloading - unloadings.begin())));
      top = model.curve.reversal(reached);
    }
    const bool within = unloading != unloadings.end() && k >= unloading->first;
    if (within && k + 1 == unloading->last) ++unloading;
    const double x = overlap(m.data[k]), relative = std::log(std::max(x / x_m, 1e-3));
    double force = 0, stretched = 0, steep = 0, polynomial = 1, place = relative / loading_length;
    if ((within || x < reached) && reached > model.curve.onset()) {
      const double share = (x - top.residual()) / (reached - top.residual());
      force = unloading_force(top, share);
      stretched = unloading_force(top, 1 - (1 - share) / (1 - recovery_error)) - force;
      steep =
          0.5 * (unloading_force(top, share + recovery_error) - unloading_force(top, share - recovery_error));
      place = std::log(reached / x_m) / loading_length - (1 - std::clamp(share, 0.0, 1.0)) / unloading_length;
    } else if (x > 0) {
      force = model.curve.loading(x).force;
      polynomial = 1 + 2 * relative / span;
    }
    p.values.push_back(model.force * force);
    double shape[3];
    legendre(polynomial, shape);
    for (std::size_t j = 0; j < 3; ++j)
      p.errors[j].push_back(model.force * force * factor_error / std::sqrt(3.0) * shape[j]);
    p.errors[3].push_back(model.force * stretched);
    p.scatter.push_back(
        std::hypot(rough_share * model.force * std::hypot(force * factor_error, steep), rough));
    p.place.push_back(place);
  }
  return p;
}

Prediction predict_platens(const Measurement& m, const Trial& t)
{
  const AtlasErrors& atlas = t.laws.errors();
  const double unit = 4.0 / 3.0 * t.material.e_star() * m.radius * m.radius;
  return predict_curve(m, {t.laws.midplane(), m.radius, unit, atlas.midplane_force, atlas.recovery},
                       t.machine);
}

Prediction predict_flat(const Measurement& m, const Trial& t)
{
  const AtlasErrors& atlas = t.laws.errors();
  const double unit = 4.0 / 3.0 * t.material.e_star() * m.radius * m.radius;
  return predict_curve(m, {t.laws.free(), m.radius, unit, atlas.force, atlas.recovery}, t.machine);
}

Prediction predict_indenter(const Measurement& m, const Trial& t)
{
  const ComposedModel::IndenterLaw& law = t.composed->law(t.material);
  const AtlasErrors& atlas = t.laws.errors();
  // composed laws were held against runs, whose own error comes on top
  const double error = std::hypot(t.composed->error(law.specimen).force, atlas.solver);
  Prediction p = predict_curve(m, {law.curve, law.length, law.force, error, atlas.recovery}, t.machine);
  p.beyond = std::log(m.largest_x() / (law.length * law.curve.end()));
  return p;
}

Reach curve_reach(const Measurement& m, const Trial& t)
{
  const LawMaterial& specimen = t.material;
  const double e_star =
      m.counterpart ? 1 / (1 / specimen.e_star() + 1 / m.counterpart->e_star()) : specimen.e_star();
  Reach r;
  r.overlap = (m.largest_x() - t.machine.offset) / m.effective_radius() / m.kind->contacts;
  r.overlap_over_onset = r.overlap / onset_overlap(e_star, specimen.yield_stress, specimen.poisson_ratio);
  return r;
}

void curve_starts(const Measurement& m, const LawMaterial&, std::vector<double>& likely)
{
  // a mean pressure of 2.8 Y over 2 pi R delta
  const double overlap = m.largest_x() / m.kind->contacts;
  const double middle = m.largest_y() / (2 * M_PI * m.effective_radius() * overlap * 2.8);
  for (const double factor : {0.4, 0.7, 1.0, 1.5, 3.0, 10.0}) likely.push_back(factor * middle);
}

/// Work of some rows of a curve between two displacements, by trapezes.
double work_of(const std::vector<Datum>& rows, double low, double high)
{
  double work = 0;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const Datum &a = rows[k - 1], &b = rows[k];
    if (a.x == b.x) continue;
    const auto force = [&](double x) { return a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x); };
    const double from = std::clamp(a.x, low, high), to = std::clamp(b.x, low, high);
    work += 0.5 * (force(from) + force(to)) * (to - from);
  }
  return std::abs(work);
}

/// No contact gives back more work than it took: rows that say so stand in the wrong order.
void check_order(const Measurement& m)
{
  constexpr double noise = 0.1;  // of the work: trapezes of few rows, and their noise
  const auto top = m.data.begin() + static_cast<std::ptrdiff_t>(m.reversal());
  const std::vector<Datum> loading(m.data.begin(), top + 1), unloading(top, m.data.end());
  if (unloading.size() < 3) return;
  const double low = std::max(loading.front().x, unloading.back().x), high = top->x;
  const double taken = work_of(loading, low, high), given = work_of(unloading, low, high);
  if (given > (1 + noise) * taken)
    fail(m.source, "unloading gives back more work than loading took, as if the rows stood in reverse order",
         fmt::format("{:.3g} J of {:.3g} J", given, taken), "loading rows first, then unloading rows");
}

void check_rows(const Measurement& m)
{
  if (m.data.size() < 5)
    fail(m.source, "a curve of force needs more rows", std::to_string(m.data.size()), "5 or more");
  const bool is_still =
      std::all_of(m.data.begin(), m.data.end(), [&](const Datum& d) { return d.x == m.data.front().x; });
  if (is_still) fail(m.source, "the displacement is the same in all rows");
  if (!(m.largest_y() > 0)) fail(m.source, "no force is over 0: pushing is positive");
  if (m.reversal() < 4)
    fail(m.source, "loading rows come first, then unloading rows: the largest displacement stands in row",
         std::to_string(m.reversal() + 1), "the fifth or a later one");
  check_order(m);
}

/// Overlap of one contact over R* at which the kind's law ends.
double deepest(const Measurement& m)
{
  if (m.indenter_radius == 0) return m.kind->contacts > 1 ? MidplaneShapes::depth : Atlas::depth;
  // where an elastic contact would be as wide as composed laws go, 0.9 of the smaller radius; others are
  // wider
  const double widest_touch = 0.9 * std::min(m.radius, m.indenter_radius) / m.effective_radius();
  return std::min(Atlas::depth, widest_touch * widest_touch);
}

void check_depth(const Measurement& m, const CalibrationRequest&, const Atlas&)
{
  const double end = m.kind->deepest(m);
  // some of it may be offset
  if (m.largest_overlap() > 1.3 * end)
    fail(m.source,
         "the curve goes deeper than the atlas covers: overlap of one contact over its effective radius",
         fmt::format("{:.3g}", m.largest_overlap()), fmt::format("up to {:g}", end));
}

/// The data that load a curve further than before.
std::vector<std::size_t> loading_data(const Measurement& m)
{
  std::vector<std::size_t> all;
  std::size_t next = 0;
  const auto add_until = [&](std::size_t end) {
    for (; next < end; ++next) all.push_back(next);
  };
  for (const Unloading& u : m.unloadings()) add_until(u.first), next = u.last;
  add_until(m.data.size());
  return all;
}

/// Noise of a curve: its scatter. Noise that neighbouring data share, as of a filter or of a saw-tooth that
/// many rows resolve, shows in means over longer stretches of the loading only: the largest counts.
void complete(Measurement& m, double)
{
  condense(m);
  if (std::all_of(m.data.begin(), m.data.end(), [](const Datum& d) { return d.sd > 0; })) return;
  std::vector<ForceScatter> found{scatter_of(m)};
  Measurement loading = m;
  loading.data.clear();
  for (const std::size_t k : loading_data(m)) loading.data.push_back(m.data[k]), loading.data.back().rows = 1;
  for (const double width : {2.0, 4.0}) {
    Measurement means = loading;
    condense(means, width);
    found.push_back(scatter_of_means(means));
    found.back().averages = false;
  }
  for (Datum& d : m.data)
    for (const ForceScatter& scatter : found) d.sd = std::max(d.sd, scatter.at(d.y, d.rows));
}

/// Loading in even steps, and half as many rows that unload to half of the displacement, at a lower force.
std::vector<Datum> planned(double displacement)
{
  constexpr int rows = 60;
  std::vector<Datum> data;
  for (int k = 1; k <= rows; ++k) data.push_back({displacement * k / rows, 1, 1, k});
  for (int k = rows / 2; k > 0; --k)
    data.push_back({displacement * (0.5 + k / (rows + 2.0)), 0.5, 1, 2 * rows - k});
  return data;
}

void look_for_a_drop(Inspection& i)
{
  constexpr double least_drop = 0.03, clear = 4;  // of the largest force so far; standard deviations
  constexpr double at_rest = 0.002;               // of the displacement
  const std::vector<Datum>& data = i.measurement.data;
  const std::vector<std::size_t> loading = loading_data(i.measurement);
  double peak = 0, peak_at = 0, sd = 0;
  for (std::size_t n = 0; n < loading.size(); ++n) {
    const Datum& d = data[loading[n]];
    if (d.y > peak) peak = d.y, peak_at = d.x, sd = d.sd;
    const bool stays = n + 1 >= loading.size() || data[loading[n + 1]].y < peak - clear * sd;
    if (!(peak - d.y > least_drop * peak + clear * std::hypot(sd, d.sd) && stays)) continue;
    const double share = 100 * (peak - d.y) / peak;
    if (d.x - peak_at < at_rest * i.measurement.largest_x())
      return i.say(
          "relaxation",
          fmt::format(
              "the force falls by {:.2g} % at rest, at {:.4g} m: the particle relaxes, and no law here "
              "depends on time",
              share, peak_at));
    return i.say("fracture",
                 fmt::format("the force falls by {:.2g} % on loading, after {:.4g} m: the particle softens, "
                             "as by fracture; rows beyond do not describe a contact",
                             share, peak_at));
  }
}

void look_at_unloading(Inspection& i)
{
  const std::vector<Datum>& data = i.measurement.data;
  double difference = 0, weights = 0;
  for (const Unloading& u : i.measurement.unloadings())
    for (std::size_t k = u.first; k < u.last; ++k)
      difference += data[k].y - i.comparison.with_errors[k], weights += 1;
  if (weights < 4) return;
  const double mean = difference / weights / i.measurement.largest_y();
  if (std::abs(mean) > 0.03)
    i.say("unloading",
          fmt::format("unloading lies {} the fit by {:.1f} % of the largest force: {}",
                      mean > 0 ? "above" : "below", 100 * std::abs(mean),
                      mean > 0 ? "a machine that gives way, or E is lower than the loading says"
                               : "time-dependent recovery, or E is higher than the loading says"));
}

/// The loading data from a tenth of the largest predicted force on.
std::vector<std::size_t> clear_loading_data(const Inspection& i)
{
  const std::vector<double>& predicted = i.comparison.predicted;
  std::vector<std::size_t> all = loading_data(i.measurement);
  double largest = 0;
  for (const std::size_t k : all) largest = std::max(largest, predicted[k]);
  std::erase_if(all, [&](std::size_t k) { return !(predicted[k] >= 0.1 * largest); });
  return all;
}

/// The loading against the logarithm of the force.
void look_at_loading(Inspection& i)
{
  const std::vector<double>& predicted = i.comparison.predicted;
  const std::vector<std::size_t> data = clear_loading_data(i);
  if (data.size() < 8) return;
  double largest = 0;
  for (const std::size_t k : data) largest = std::max(largest, predicted[k]);
  Differences d;
  for (const std::size_t k : data) i.add_to(d, k, 1 + 2 * std::log(predicted[k] / largest) / std::log(10.0));
  const Factors f = legendre_factors(d);
  const double model = i.model_error();
  if (f.seen(2, model))
    i.say("curve bends",
          fmt::format("the force bends {} on loading than the fit ({:.1f} %): {}",
                      f.value[2] > 0 ? "up more" : "down more", 150 * std::abs(f.value[2]),
                      f.value[2] > 0
                          ? "hardening that grows with strain, or a solid ground beneath the particle"
                          : "hardening that saturates (Voce, Swift) where the fit's is linear, or damage"));
  else if (f.seen(1, model))
    i.say("curve grows",
          fmt::format("the force grows {} on loading than the fit's ({:+.1f} % from a tenth to all of it): "
                      "another flow law, or a particle that is no sphere",
                      f.value[1] > 0 ? "faster" : "slower", 200 * f.value[1]));
  look_at_unloading(i);
}

/// The fit takes more of the model's own error than the atlas certifies.
void look_at_model_errors(Inspection& i)
{
  struct Pattern
  {
    const char *name, *above, *below;
  };
  static constexpr Pattern patterns[] = {
      {"curve level", "the force lies above the fit", "the force lies below the fit"},
      {"curve grows", "the force grows faster on loading than the fit",
       "the force grows slower on loading than the fit"},
      {"curve bends", "the force bends up more on loading than the fit",
       "the force bends down more on loading than the fit"},
      {"unloading", "the dent is deeper than the fit's", "the dent is shallower than the fit's"}};
  const std::vector<double> taken = i.model_errors();
  const auto most = std::max_element(taken.begin(), taken.end(),
                                     [](double a, double b) { return std::abs(a) < std::abs(b); });
  if (std::abs(*most) < clear_by_stated) return;
  const Pattern& p = patterns[most - taken.begin()];
  i.say(p.name, fmt::format("{} by {:.2g} standard deviations of the model's own error: another flow law "
                            "(hardening that is not fitted, a rate), or what is held fixed is wrong",
                            *most > 0 ? p.above : p.below, std::abs(*most)));
}

/// A misfit that neither the fit nor the model's own error explains, and that no other name fits.
void look_for_long_runs(Inspection& i)
{
  constexpr double clear = 4;  // standard deviations
  constexpr double most =
      2;  // of the model's own error: of eight lengths of it, its rms is known to a quarter
  std::vector<double> left;
  double squares = 0, allowed = 0;
  for (const std::size_t k : clear_loading_data(i)) {
    const double predicted = i.comparison.predicted[k];
    left.push_back((i.measurement.data[k].y - i.comparison.with_errors[k]) / predicted);
    squares += left.back() * left.back(), allowed += std::pow(i.comparison.sd[k] / predicted, 2);
  }
  if (left.size() < 8 || !(missing_runs(left) > clear && squares > most * most * allowed)) return;
  i.say("long runs",
        fmt::format("the differences from the fit keep their sign over long stretches (rms {:.2g} % of "
                    "the force): systematic, though of no known pattern",
                    100 * std::sqrt(squares / static_cast<double>(left.size()))));
}

void inspect(Inspection& i)
{
  look_for_a_drop(i);
  look_at_loading(i);
  if (i.found.empty()) look_at_model_errors(i);
  if (i.found.empty()) look_for_long_runs(i);
  for (const std::string& sentence : i.measurement.set_aside) i.say("cycle", sentence);
}

constexpr Kind curves(Kind k)
{
  k.x = {.quantity = "displacement", .unit = "m", .above = -std::numeric_limits<double>::infinity()};
  k.y = {.quantity = "force", .unit = "N", .above = -1e9, .allowed = "a force, pushing is positive"};
  k.has_machine = true, k.shows = Kind::Shows::slow, k.smooth_errors = 4;
  k.reach = curve_reach, k.starts = curve_starts, k.inspect = inspect, k.planned = planned,
  k.deepest = deepest;
  k.check_rows = check_rows, k.check_request = check_depth, k.complete = complete;
  k.tells_strength = [](const Measurement& m, std::size_t row, double) {
    const std::vector<std::size_t> loading = loading_data(m);
    return std::binary_search(loading.begin(), loading.end(), row);
  };
  return k;
}

}  // namespace

extern const Kind platens_kind =
    curves({.name = "platens",
            .word = "platens",
            .help = "a sphere between two plates, displacement of one towards the other; loading rows, then "
                    "unloading rows",
            .contacts = 2,
            .predict = predict_platens,
            .model_error = [](const AtlasErrors& e) { return e.midplane_force; }});
extern const Kind flat_kind = curves({.name = "flat",
                                      .word = "flat",
                                      .help = "one contact, displacement of the sphere's middle",
                                      .predict = predict_flat});
extern const Kind indenter_kind =
    curves({.name = "sphere",
            .word = "sphere",
            .help = "a spherical indenter, its displacement towards the specimen's middle",
            .counterpart = Kind::Counterpart::indenter,
            .predict = predict_indenter});

}  // namespace granulaw
