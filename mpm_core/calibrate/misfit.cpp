#include "calibrate/misfit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "calibrate/atlas_errors.hpp"
#include "characterise/composed_law.hpp"

namespace granulaw {

namespace {

constexpr double rigid_partner = 1e4;    // E* of a rigid partner over the specimen's
constexpr double by_runs_error = 0.003;  // of a law by runs
constexpr double clear = 4;              // standard deviations
/// A pattern counts from so many standard deviations on: of those stated; of the scatter about the pattern,
/// where that is less: of eight values it is itself known to a third, and Student's t has 0.4 % beyond.
constexpr double clear_by_stated = 3, clear_by_scatter = 5;

/// Relative differences of some values from the fit, over a coordinate from -1 to 1.
struct Differences
{
  std::vector<double> place, relative, sd;
};

/// Weighted least squares of the first three Legendre polynomials: factor and its sd.
struct Factors
{
  double value[3], sd[3];
  double scatter;  ///< of what they leave, over the sd given
  /// Whether a factor is no chance and no error of the model, whose sd is `model`.
  bool seen(int k, double model) const
  {
    const double limit = scatter < 1 ? clear_by_scatter : clear_by_stated;
    return std::abs(value[k]) > limit * std::hypot(std::min(1.0, scatter) * sd[k], model) ||
           std::abs(value[k]) > clear_by_stated * std::hypot(sd[k], model);
  }
};
Factors legendre_factors(const Differences& d)
{
  const auto rows = static_cast<Eigen::Index>(d.place.size());
  Eigen::MatrixXd a(rows, 3);
  Eigen::VectorXd b(rows);
  for (Eigen::Index k = 0; k < rows; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double t = d.place[i], w = 1 / d.sd[i];
    a.row(k) << w, w * t, w * 0.5 * (3 * t * t - 1);
    b(k) = w * d.relative[i];
  }
  Eigen::Matrix3d information = a.transpose() * a;
  information.diagonal().array() += 1e-9;
  const Eigen::Matrix3d inverse = information.inverse();
  const Eigen::Vector3d x = inverse * (a.transpose() * b);
  Factors f{};
  for (int k = 0; k < 3; ++k) f.value[k] = x(k), f.sd[k] = std::sqrt(inverse(k, k));
  const auto left = static_cast<double>(rows - 3);
  f.scatter = left > 2 ? (b - a * x).norm() / std::sqrt(left) : 1.0;
  return f;
}

/// Standard deviations by which there are too few runs of one sign.
double missing_runs(const std::vector<double>& values)
{
  double plus = 0, minus = 0, runs = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    (values[k] > 0 ? plus : minus) += 1;
    if (k == 0 || (values[k] > 0) != (values[k - 1] > 0)) runs += 1;
  }
  const double n = plus + minus;
  if (n < 8 || plus == 0 || minus == 0) return 0;
  const double mean = 2 * plus * minus / n + 1;
  const double variance = (mean - 1) * (mean - 2) / (n - 1);
  return variance > 0 ? (mean - runs) / std::sqrt(variance) : 0;
}

/// A measurement against the fit.
class Inspection
{
 public:
  Inspection(const CalibrationProblem& problem, const Minimum& minimum, std::size_t index)
      : problem_(problem),
        minimum_(minimum),
        index_(index),
        measurement_(problem.request().measurements[index]),
        comparison_(problem.compare(minimum.q, index))
  {
  }
  /// Standard deviations by which the values as a whole lie above the fit; those of e at which nothing
  /// yields, and what unloads, tell nothing of the strength.
  double above() const
  {
    double sum = 0, weights = 0;
    const bool curve = is_curve(measurement_.kind);
    const std::size_t count = curve ? measurement_.loading_rows() : measurement_.data.size();
    for (std::size_t k = 0; k < count; ++k) {
      const double predicted = comparison_.predicted[k];
      if (!(predicted > 0) || (!curve && predicted > 0.9995)) continue;
      const double weight = std::pow(predicted / comparison_.sd[k], 2);
      sum += weight * (measurement_.data[k].y / predicted - 1), weights += weight;
    }
    return weights > 0 ? sum / weights / std::hypot(1 / std::sqrt(weights), model_error()) : 0;
  }
  bool is_fast() const { return measurement_.kind == MeasurementKind::restitution; }
  bool is_slow() const
  {
    return !is_impact(measurement_.kind) && measurement_.kind != MeasurementKind::onset_force;
  }

  std::vector<Misfit> misfits()
  {
    if (measurement_.kind == MeasurementKind::restitution) look_at_restitution();
    if (is_curve(measurement_.kind)) look_at_curve();
    if (is_curve(measurement_.kind) && found_.empty()) look_at_model_errors();
    if (is_curve(measurement_.kind) && found_.empty()) look_for_long_runs();
    look_for_outliers();
    return std::move(found_);
  }

 private:
  void say(const char* name, const std::string& sentence)
  {
    found_.push_back({measurement_.source, name, sentence});
  }
  double residual(std::size_t k) const
  {
    return (measurement_.data[k].y - comparison_.with_errors[k]) / comparison_.sd[k];
  }

  /// Sd of each of the three factors that the model's own error may have: the atlas's, as its file certifies;
  /// of e, absolute, or of the force, relative.
  double model_error() const
  {
    const AtlasErrors atlas =
        errors_of(problem_.laws().atlas(), MaterialRatios::of(problem_.material(minimum_.q)).stiffness);
    const double error = measurement_.kind == MeasurementKind::restitution
                             ? std::hypot(atlas.restitution, atlas.solver)
                         : measurement_.kind == MeasurementKind::platens ? atlas.midplane_force
                                                                         : atlas.force;
    const bool by_runs = !problem_.request().known.hardens_linearly();
    return std::hypot(error, by_runs ? by_runs_error : 0.0, composed_error_of()) / std::sqrt(3.0);
  }
  /// Of an indenter's law, or of a wall that gives way.
  double composed_error_of() const
  {
    constexpr double stated = 2;  // standard deviations
    const std::optional<LawMaterial>& partner = measurement_.kind == MeasurementKind::indenter
                                                    ? measurement_.indenter
                                                : measurement_.ball ? measurement_.ball
                                                                    : measurement_.wall;
    const bool composed = measurement_.kind == MeasurementKind::indenter || partner;
    if (!composed) return 0;
    const double ratio = partner ? partner->e_star() / problem_.material(minimum_.q).e_star() : rigid_partner;
    const ComposedError error = composed_error(ratio);
    return (measurement_.kind == MeasurementKind::indenter ? error.force : error.restitution) / stated;
  }

  void look_at_restitution()
  {
    Differences d;
    double slowest = 1e300, fastest = 0;
    for (const Datum& datum : measurement_.data) {
      slowest = std::min(slowest, datum.x), fastest = std::max(fastest, datum.x);
    }
    const double range = std::log(fastest / slowest);
    double least = 1;
    std::string elastic;
    for (std::size_t k = 0; k < measurement_.data.size(); ++k) {
      const Datum& datum = measurement_.data[k];
      const double predicted = comparison_.predicted[k];
      if (predicted > 0.9995 && datum.y < 1 - clear * comparison_.sd[k])
        elastic = fmt::format("{:.4g} at {:.4g} m/s", datum.y, datum.x);
      d.place.push_back(range > 0 ? 2 * std::log(datum.x / slowest) / range - 1 : 0.0);
      d.relative.push_back(datum.y / predicted - 1);
      d.sd.push_back(comparison_.sd[k] / predicted);
      least = std::min(least, predicted);
    }
    if (!elastic.empty())
      say("elastic loss",
          fmt::format(
              "e is below 1 at speeds that do not yield ({}): adhesion, waves in the wall or roughness "
              "take energy, not plasticity",
              elastic));
    if (d.place.size() < 4 || range < 0.3) return;
    const Factors f = legendre_factors(d);
    const double model = model_error() / least;
    const bool trend = f.seen(1, model);
    if (trend && f.value[1] < 0)
      say("falls faster",
          fmt::format(
              "e falls faster with the speed than any J2 material's ({:+.1f} % against the fit from the "
              "slowest to the fastest): damage, adhesion or waves; or what is held fixed is wrong",
              200 * f.value[1]));
    if (trend && f.value[1] > 0)
      say("falls slower",
          fmt::format(
              "e falls slower with the speed than the fit ({:+.1f} % from the slowest to the fastest): the "
              "material is stronger at fast impacts, as one that depends on the rate, or hardens more "
              "than the fit may",
              200 * f.value[1]));
    if (!trend && f.seen(2, model))
      say("bends",
          fmt::format("e bends {} against the logarithm of the speed than the fit: another flow law, or two "
                      "mechanisms of loss",
                      f.value[2] > 0 ? "less" : "more"));
  }

  void look_at_curve()
  {
    look_for_a_drop();
    const std::size_t loading = measurement_.loading_rows();
    double largest = 0;
    for (std::size_t k = 0; k < loading; ++k) largest = std::max(largest, comparison_.predicted[k]);
    Differences d;
    for (std::size_t k = 0; k < loading; ++k) {
      const double predicted = comparison_.predicted[k];
      if (predicted < 0.1 * largest) continue;
      d.place.push_back(1 + 2 * std::log(predicted / largest) / std::log(10.0));
      d.relative.push_back(measurement_.data[k].y / predicted - 1);
      d.sd.push_back(comparison_.sd[k] / predicted);
    }
    if (d.place.size() < 8) return;
    const Factors f = legendre_factors(d);
    const double model = model_error();
    if (f.seen(2, model))
      say("curve bends",
          fmt::format("the force bends {} on loading than the fit ({:.1f} %): {}",
                      f.value[2] > 0 ? "up more" : "down more", 150 * std::abs(f.value[2]),
                      f.value[2] > 0
                          ? "hardening that grows with strain, or a solid ground beneath the particle"
                          : "hardening that saturates (Voce, Swift) where the fit's is linear, or damage"));
    else if (f.seen(1, model))
      say("curve grows",
          fmt::format("the force grows {} on loading than the fit's ({:+.1f} % from a tenth to all of it): "
                      "another flow law, or a particle that is no sphere",
                      f.value[1] > 0 ? "faster" : "slower", 200 * f.value[1]));
    look_at_unloading();
  }

  /// A misfit that neither the fit nor the model's own error explains, and that no other name fits.
  void look_for_long_runs()
  {
    double largest = 0;
    for (const double predicted : comparison_.predicted) largest = std::max(largest, predicted);
    std::vector<double> left;
    for (std::size_t k = 0; k < measurement_.loading_rows(); ++k)
      if (const double predicted = comparison_.predicted[k]; predicted >= 0.1 * largest)
        left.push_back((measurement_.data[k].y - comparison_.with_errors[k]) / predicted);
    if (left.size() < 8 || !(missing_runs(left) > clear && rms(left) > model_error())) return;
    say("long runs",
        fmt::format(
            "the differences from the fit keep their sign over long stretches (rms {:.2g} % of the force): "
            "systematic, though of no known pattern",
            100 * rms(left)));
  }

  static double rms(const std::vector<double>& values)
  {
    double sum = 0;
    for (const double v : values) sum += v * v;
    return std::sqrt(sum / static_cast<double>(values.size()));
  }

  /// What the fit takes for the model's own error is more than the atlas certifies.
  void look_at_model_errors()
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
    const std::vector<double> taken = model_errors();
    std::size_t most = 0;
    for (std::size_t k = 0; k < taken.size(); ++k)
      if (std::abs(taken[k]) > std::abs(taken[most])) most = k;
    if (taken.size() != std::size(patterns) || std::abs(taken[most]) < clear_by_stated) return;
    const Pattern& p = patterns[most];
    say(p.name,
        fmt::format(
            "{} by {:.2g} standard deviations of the model's own error: another flow law (hardening that is "
            "not fitted, a rate), or what is held fixed is wrong",
            taken[most] > 0 ? p.above : p.below, std::abs(taken[most])));
  }
  /// Over their standard deviations.
  std::vector<double> model_errors() const
  {
    std::vector<double> taken;
    for (std::size_t u = 0; u < problem_.unknowns().size(); ++u) {
      const CalibrationProblem::Unknown& unknown = problem_.unknowns()[u];
      if (unknown.kind == CalibrationProblem::Unknown::Kind::model_error && unknown.measurement == index_)
        taken.push_back(minimum_.q[static_cast<Eigen::Index>(u)]);
    }
    return taken;
  }

  void look_at_unloading()
  {
    const std::size_t loading = measurement_.loading_rows();
    double difference = 0, weights = 0, largest = measurement_.data[loading - 1].y;
    for (std::size_t k = loading; k < measurement_.data.size(); ++k) {
      difference += measurement_.data[k].y - comparison_.with_errors[k];
      weights += 1;
    }
    if (weights < 4 || !(largest > 0)) return;
    const double mean = difference / weights / largest;
    if (std::abs(mean) > 0.03)
      say("unloading",
          fmt::format("unloading lies {} the fit by {:.1f} % of the largest force: {}",
                      mean > 0 ? "above" : "below", 100 * std::abs(mean),
                      mean > 0 ? "a machine that gives way, or E is lower than the loading says"
                               : "time-dependent recovery, or E is higher than the loading says"));
  }

  void look_for_a_drop()
  {
    constexpr double least_drop = 0.03;  // of the largest force so far
    const std::size_t loading = measurement_.loading_rows();
    double peak = 0, peak_at = 0, sd = 0;
    for (std::size_t k = 0; k < loading; ++k) {
      const Datum& d = measurement_.data[k];
      if (d.y > peak) peak = d.y, peak_at = d.x, sd = d.sd;
      const bool stays = k + 1 >= loading || measurement_.data[k + 1].y < peak - clear * sd;
      if (peak - d.y > least_drop * peak + clear * std::hypot(sd, d.sd) && stays) {
        say("fracture",
            fmt::format("the force falls by {:.2g} % on loading, after {:.4g} m: the particle softens, as by "
                        "fracture; rows beyond tell nothing of a contact",
                        100 * (peak - d.y) / peak, peak_at));
        return;
      }
    }
  }

  void look_for_outliers()
  {
    const std::size_t count = measurement_.data.size();
    std::vector<std::size_t> off;
    for (std::size_t k = 0; k < count; ++k)
      if (std::abs(residual(k)) > clear + (count > 100 ? 1 : 0)) off.push_back(k);
    if (off.empty() || off.size() > std::max<std::size_t>(1, count / 10)) return;
    std::string lines;
    for (const std::size_t k : off) {
      if (!lines.empty()) lines += ", ";
      lines += fmt::format("{} ({:+.1f} sd)", measurement_.data[k].line, residual(k));
      if (lines.size() > 100) break;
    }
    say("outliers", fmt::format("single values lie far off the fit, in line {}: outliers count less", lines));
  }

  const CalibrationProblem& problem_;
  const Minimum& minimum_;
  std::size_t index_;
  const Measurement& measurement_;
  CalibrationProblem::Comparison comparison_;
  std::vector<Misfit> found_;
};

}  // namespace

namespace {

/// Impacts that show another strength than slow measurements of the same material.
std::optional<Misfit> contradiction(const std::vector<Inspection>& inspections)
{
  constexpr double agrees = 1;  // the side that has more values pulls the fit to itself
  double fast = 0, slow = 0;
  bool has_fast = false, has_slow = false;
  for (const Inspection& i : inspections) {
    if (!i.is_fast() && !i.is_slow()) continue;
    (i.is_fast() ? has_fast : has_slow) = true;
    double& side = i.is_fast() ? fast : slow;
    if (const double above = i.above(); std::abs(above) > std::abs(side)) side = above;
  }
  const bool same_side = (fast > 0) == (slow > 0) && std::min(std::abs(fast), std::abs(slow)) > agrees;
  if (!has_fast || !has_slow || same_side || std::max(std::abs(fast), std::abs(slow)) < clear_by_stated)
    return std::nullopt;
  return Misfit{
      "", fast > slow ? "rate" : "slow is stronger",
      fast > slow
          ? "impacts show a stronger material than slow measurements do: its yield stress grows with the "
            "strain rate, which this fit does not know"
          : "slow measurements show a stronger material than impacts do: losses that are not plastic, or "
            "specimens that differ"};
}

}  // namespace

std::vector<Misfit> name_misfits(const CalibrationProblem& problem, const Minimum& minimum)
{
  std::vector<Misfit> all;
  std::vector<Inspection> inspections;
  for (std::size_t k = 0; k < problem.request().measurements.size(); ++k)
    inspections.emplace_back(problem, minimum, k);
  if (const std::optional<Misfit> found = contradiction(inspections)) all.push_back(*found);
  for (Inspection& inspection : inspections)
    for (Misfit& m : inspection.misfits()) all.push_back(std::move(m));
  return all;
}

}  // namespace granulaw
