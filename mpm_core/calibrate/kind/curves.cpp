// Curves of force against displacement: between two platens, on a flat, under an indenter.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/scales.hpp"
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
  Prediction p;
  p.errors.resize(m.kind->smooth_errors);
  const auto overlap = [&](const Datum& d) {
    return (d.x - machine.offset - machine.compliance * d.y) / m.kind->contacts / model.length;
  };
  const std::size_t loading = m.loading_rows();
  double x_m = 0;
  for (const Datum& d : m.data) x_m = std::max(x_m, overlap(d));
  x_m += std::max(0.0, machine.beyond) / m.kind->contacts / model.length;
  const Reversal top = model.curve.reversal(std::max(x_m, 1e-12));
  // The checks' errors are each one curve's: smooth. Unloading is off by a fraction of what it recovers,
  // however far the press went.
  const double factor_error = model.force_error, recovery_error = model.recovery_error,
               recovery = x_m - top.residual();
  constexpr double span = 4.6;  // ln 100: of the overlap, over which the errors were measured
  for (std::size_t k = 0; k < m.data.size(); ++k) {
    const double x = overlap(m.data[k]);
    const bool unloads = k >= loading && x_m > model.curve.onset();
    double force = 0, stretched = 0, steep = 0, place = 1;
    if (unloads) {
      const double share = (x - top.residual()) / recovery;
      force = unloading_force(top, share);
      stretched = unloading_force(top, 1 - (1 - share) / (1 - recovery_error)) - force;
      steep =
          0.5 * (unloading_force(top, share + recovery_error) - unloading_force(top, share - recovery_error));
    } else if (x > 0) {
      force = model.curve.loading(x).force;
      place = 1 + 2 * std::log(x / x_m) / span;
    }
    p.values.push_back(model.force * force);
    double shape[3];
    legendre(place, shape);
    for (std::size_t j = 0; j < 3; ++j)
      p.errors[j].push_back(model.force * force * factor_error / std::sqrt(3.0) * shape[j]);
    p.errors[3].push_back(model.force * stretched);
    p.scatter.push_back(rough_share * model.force * std::hypot(force * factor_error, steep));
  }
  return p;
}

Prediction predict_platens(const Measurement& m, const Trial& t)
{
  const AtlasErrors atlas = errors_of(*t.laws.atlas(), t.laws.material().stiffness);
  const double unit = 4.0 / 3.0 * t.material.e_star() * m.radius * m.radius;
  return predict_curve(m, {t.laws.midplane(), m.radius, unit, atlas.midplane_force, atlas.recovery},
                       t.machine);
}

Prediction predict_flat(const Measurement& m, const Trial& t)
{
  const AtlasErrors atlas = errors_of(*t.laws.atlas(), t.laws.material().stiffness);
  const double unit = 4.0 / 3.0 * t.material.e_star() * m.radius * m.radius;
  return predict_curve(m, {t.laws.free(), m.radius, unit, atlas.force, atlas.recovery}, t.machine);
}

Prediction predict_indenter(const Measurement& m, const Trial& t)
{
  const ComposedModel::IndenterLaw& law = t.composed->law(t.material);
  const AtlasErrors atlas = errors_of(*t.laws.atlas(), MaterialRatios::of(t.material).stiffness);
  // composed laws were held against runs, whose own error comes on top
  const double error = std::hypot(t.composed->error(law.specimen).force, atlas.solver);
  Prediction p = predict_curve(m, {law.curve, law.length, law.force, error, atlas.recovery}, t.machine);
  p.beyond = std::log(m.largest_x() / (law.length * law.curve.end()));
  return p;
}

Reach reach(const Measurement& m, const Trial& t)
{
  const LawMaterial& specimen = t.material;
  const double e_star =
      m.counterpart ? 1 / (1 / specimen.e_star() + 1 / m.counterpart->e_star()) : specimen.e_star();
  Reach r;
  r.overlap = (m.largest_x() - t.machine.offset) / m.effective_radius() / m.kind->contacts;
  r.overlap_over_onset = r.overlap / onset_overlap(e_star, specimen.yield_stress, specimen.poisson_ratio);
  return r;
}

void starts(const Measurement& m, const LawMaterial&, std::vector<double>& likely)
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

/// Noise of a curve: its scatter, and 0.1 % of its largest force at least. Contact curves of the atlas are no
/// smoother.
void complete(Measurement& m, double)
{
  if (std::all_of(m.data.begin(), m.data.end(), [](const Datum& d) { return d.sd > 0; })) return;
  const ForceScatter scatter = scatter_of(m);
  const double floor = 1e-3 * m.largest_y();
  for (Datum& d : m.data) d.sd = std::max(floor, scatter.at(d.y));
}

/// Loading in even steps, and half as many rows that unload to half of the displacement.
std::vector<Datum> planned(double displacement)
{
  constexpr int rows = 60;
  std::vector<Datum> data;
  for (int k = 1; k <= rows; ++k) data.push_back({displacement * k / rows, 1, 1, k});
  for (int k = rows / 2; k > 0; --k)
    data.push_back({displacement * (0.5 + k / (rows + 2.0)), 1, 1, 2 * rows - k});
  return data;
}

void look_for_a_drop(Inspection& i)
{
  constexpr double least_drop = 0.03, clear = 4;  // of the largest force so far; standard deviations
  const std::vector<Datum>& data = i.measurement.data;
  const std::size_t loading = i.measurement.loading_rows();
  double peak = 0, peak_at = 0, sd = 0;
  for (std::size_t k = 0; k < loading; ++k) {
    const Datum& d = data[k];
    if (d.y > peak) peak = d.y, peak_at = d.x, sd = d.sd;
    const bool stays = k + 1 >= loading || data[k + 1].y < peak - clear * sd;
    if (peak - d.y > least_drop * peak + clear * std::hypot(sd, d.sd) && stays)
      return i.say(
          "fracture",
          fmt::format("the force falls by {:.2g} % on loading, after {:.4g} m: the particle softens, "
                      "as by fracture; rows beyond do not describe a contact",
                      100 * (peak - d.y) / peak, peak_at));
  }
}

void look_at_unloading(Inspection& i)
{
  const std::vector<Datum>& data = i.measurement.data;
  const std::size_t loading = i.measurement.loading_rows();
  double difference = 0, weights = 0, largest = data[loading - 1].y;
  for (std::size_t k = loading; k < data.size(); ++k)
    difference += data[k].y - i.comparison.with_errors[k], weights += 1;
  if (weights < 4 || !(largest > 0)) return;
  const double mean = difference / weights / largest;
  if (std::abs(mean) > 0.03)
    i.say("unloading",
          fmt::format("unloading lies {} the fit by {:.1f} % of the largest force: {}",
                      mean > 0 ? "above" : "below", 100 * std::abs(mean),
                      mean > 0 ? "a machine that gives way, or E is lower than the loading says"
                               : "time-dependent recovery, or E is higher than the loading says"));
}

/// The loading against the logarithm of the force, from a tenth of the largest on.
void look_at_loading(Inspection& i)
{
  const std::size_t loading = i.measurement.loading_rows();
  const std::vector<double>& predicted = i.comparison.predicted;
  const double largest = std::max(
      0.0, *std::max_element(predicted.begin(), predicted.begin() + static_cast<std::ptrdiff_t>(loading)));
  Differences d;
  for (std::size_t k = 0; k < loading; ++k)
    if (predicted[k] >= 0.1 * largest)
      i.add_to(d, k, 1 + 2 * std::log(predicted[k] / largest) / std::log(10.0));
  if (d.place.size() < 8) return;
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
  const std::vector<double>& predicted = i.comparison.predicted;
  const double largest = *std::max_element(predicted.begin(), predicted.end());
  std::vector<double> left;
  double squares = 0;
  for (std::size_t k = 0; k < i.measurement.loading_rows(); ++k)
    if (predicted[k] >= 0.1 * largest) {
      left.push_back((i.measurement.data[k].y - i.comparison.with_errors[k]) / predicted[k]);
      squares += left.back() * left.back();
    }
  const double rms = std::sqrt(squares / static_cast<double>(left.size()));
  if (left.size() < 8 || !(missing_runs(left) > clear && rms > i.model_error())) return;
  i.say("long runs",
        fmt::format("the differences from the fit keep their sign over long stretches (rms {:.2g} % of "
                    "the force): systematic, though of no known pattern",
                    100 * rms));
}

void inspect(Inspection& i)
{
  look_for_a_drop(i);
  look_at_loading(i);
  if (i.found.empty()) look_at_model_errors(i);
  if (i.found.empty()) look_for_long_runs(i);
}

constexpr Kind curves(Kind k)
{
  k.x = {.quantity = "displacement", .unit = "m", .above = -std::numeric_limits<double>::infinity()};
  k.y = {.quantity = "force", .unit = "N", .above = -1e9, .allowed = "a force, pushing is positive"};
  k.has_machine = true, k.shows = Kind::Shows::slow, k.smooth_errors = 4;
  k.reach = reach, k.starts = starts, k.inspect = inspect, k.planned = planned, k.deepest = deepest;
  k.check_rows = check_rows, k.check_request = check_depth, k.complete = complete;
  k.tells_strength = [](const Measurement& m, std::size_t row, double) { return row < m.loading_rows(); };
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
