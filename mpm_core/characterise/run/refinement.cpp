#include "characterise/run/refinement.hpp"

#include <algorithm>
#include <cmath>

#include "base/larger.hpp"
#include "law/law_shape.hpp"
#include "atlas/speed_interpolation.hpp"

namespace granulaw {

namespace {

double restitution_of(const ContactRecord& record)
{
  return std::sqrt(std::max(0.0, record.work_ratio));
}

double restitution_error(const LeftOutRun& run)
{
  return run.predicted ? std::abs(run.predicted->restitution / run.measured.restitution - 1) : 0.0;
}

double force_error(const LeftOutRun& run)
{
  return run.predicted && run.measured.force > 0 ? std::abs(run.predicted->force / run.measured.force - 1)
                                                 : 0.0;
}

/// Values of a law's shape for a quasi-static contact that reverses at overlap x.
AtReversal at_reversal(const LawShape& shape, double onset, double x_end, double x)
{
  const double q = 0.25 * std::log(x / onset), q_end = 0.25 * std::log(x_end / onset);
  const double elastic = x * std::sqrt(x) * shape.elastic.force_ratio(std::pow(x, 0.25));
  const double reduction = Spline::through(shape.force_reduction, q_end).value(q);
  const double dissipation = Spline::through(shape.dissipation, q_end).value(q);
  return {elastic * std::exp(-reduction), std::exp(-0.5 * dissipation)};
}

ContactRecords without(const ContactRecords& records, int run)
{
  ContactRecords others = records;
  std::erase_if(others.slow, [run](const ContactRecord& record) { return record.run == run; });
  return others;
}

/// Dissipation and force at the reversal that the effects but one say at the speed of that one.
struct Interpolated
{
  double dissipation, log_force;
};
Interpolated interpolated(std::span<const LawShape::VelocityEffect> effects, std::size_t left_out,
                          AxisTable::By kind)
{
  std::vector<double> speeds;
  std::vector<const LawShape::VelocityEffect*> others;
  for (std::size_t j = 0; j < effects.size(); ++j)
    if (j != left_out) {
      speeds.push_back(effects[j].speed);
      others.push_back(&effects[j]);
    }
  const SpeedInterpolation between(speeds, kind);
  const double v = effects[left_out].speed;
  return {between.at(v, [&](std::size_t j) { return others[j]->dissipation; }),
          between.at(v, [&](std::size_t j) { return others[j]->force.back(); })};
}

}  // namespace

double counted(double force, double e, double restitution)
{
  return larger(force, e * std::min(1.0, restitution / 0.5));
}

double miss(const LeftOutRun& run)
{
  return counted(force_error(run), restitution_error(run), run.measured.restitution);
}

double largest_miss(std::span<const LeftOutRun> runs)
{
  double largest = 0;
  for (const LeftOutRun& run : runs) largest = larger(largest, miss(run));
  return largest;
}

AtReversal largest_errors(std::span<const LeftOutRun> runs)
{
  AtReversal largest;
  for (const LeftOutRun& run : runs)
    largest = {larger(largest.force, force_error(run)), larger(largest.restitution, restitution_error(run))};
  return largest;
}

double least_interval(double tolerance)
{
  return std::sqrt(8 * tolerance);
}

std::vector<double> bisections(std::span<const LeftOutRun> runs, double tolerance,
                               std::optional<Exact> exact)
{
  const auto missed = [&](std::size_t k) { return miss(runs[k]) > tolerance; };
  std::vector<double> wanted;
  if (exact && !runs.empty() && missed(0)) {
    const double middle = 0.5 * (exact->coordinate + runs[0].coordinate);
    if (middle >= exact->nearest) wanted.push_back(middle);
  }
  for (std::size_t k = 1; k < runs.size(); ++k) {
    const bool wide = std::log(runs[k].overlap / runs[k - 1].overlap) > least_interval(tolerance);
    if (wide && (missed(k - 1) || missed(k)))
      wanted.push_back(0.5 * (runs[k - 1].coordinate + runs[k].coordinate));
  }
  return wanted;
}

std::vector<LeftOutRun> leave_out_slow(const ContactRecords& records, const ShapeOf& fit, double onset,
                                       double x_end, long least)
{
  const auto is_end = [](const ContactRecord& r) { return r.depth == r.run_depth; };
  const auto beyond = std::count_if(records.slow.begin(), records.slow.end(),
                                    [&](const auto& r) { return is_end(r) && r.depth > onset; });
  std::vector<LeftOutRun> runs;
  for (const ContactRecord& record : records.slow) {
    if (!is_end(record)) continue;
    LeftOutRun run{std::log(record.depth), record.depth, {record.peak, restitution_of(record)}, {}};
    const bool last = record.depth == records.slow.back().depth;
    if (!last && beyond >= least && record.depth > onset)
      run.predicted = at_reversal(fit(without(records, record.run)), onset, x_end, record.depth);
    runs.push_back(run);
  }
  return runs;
}

std::vector<LeftOutRun> leave_out_fast(std::span<const ContactRecords::Impact> impacts,
                                       std::span<const LawShape::VelocityEffect> effects,
                                       AxisTable::By kind)
{
  const bool rate = kind == AxisTable::By::rate;
  std::vector<LeftOutRun> runs;
  for (std::size_t k = 0; k < impacts.size(); ++k) {
    const double speed = impacts[k].speed, e = restitution_of(impacts[k].path);
    // over the force of a slow press to the same overlap
    const AtReversal measured{std::exp(effects[k].force.back()), e};
    LeftOutRun run{rate ? std::log(speed) : speed, impacts[k].path.depth, measured, {}};
    const bool end = k + 1 == impacts.size() || (rate && k == 0);
    if (!end) {
      const Interpolated told = interpolated(effects, k, kind);
      run.predicted = {std::exp(told.log_force),
                       e * std::exp(-0.5 * (told.dissipation - effects[k].dissipation))};
    }
    runs.push_back(run);
  }
  return runs;
}

}  // namespace granulaw
