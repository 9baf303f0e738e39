#include "characterise/tabulate_velocity_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "characterise/impact_level.hpp"
#include "characterise/impacts_by_speed.hpp"
#include "characterise/node_slopes.hpp"
#include "characterise/overlap_at_work.hpp"

namespace granulaw {

namespace {

constexpr double speed_spacing = 0.02;    // of the nodes of X(v)
constexpr double level_spacing = 0.0125;  // of X, about, beyond the first
constexpr double levels_an_octave = 3;    // of a rate axis
constexpr std::size_t first_levels = 3;   // within the first spacing
constexpr double first_told = 1.5;       // X of the first level over the onset's overlap: nearer, keeping the
                                         // law admissible takes more than inertia does
constexpr double soft = 2;               // times the onset: less is the first spacing of a soft body
constexpr double usual_ratio_end = 1.5;  // xi where the force is the press's again

/// X(v) at equal steps.
void tabulate_overlaps(VelocityAxis::Table& table, const ImpactsBySpeed& impacts, int steps)
{
  const double spacing = table.speed_end / steps;
  for (int k = 0; k <= steps; ++k)
    table.impact_overlap.push_back(impacts.impact_overlap(table.speed_end * k / steps));
  table.impact_overlap_slope = difference_slopes(table.impact_overlap, spacing);
  for (double& slope : table.impact_overlap_slope) slope = std::max(0.0, slope);
}

/// Where the levels of inertia stand. A soft body's first stands just past the onset, and none before:
/// half-way to an elastic level no mixture of the two is admissible, and raising exponents there took 0.01
/// of e.
ImpactLevels levels_from_standstill(VelocityAxis::Table& table, double onset)
{
  const double end = table.impact_overlap.back();
  double spacings = std::round(end / level_spacing);
  if (end / spacings < soft * onset) spacings = std::floor(end / (first_told * onset));
  spacings = std::max(2.0, spacings);
  table.first_levels = end / spacings < first_levels * first_told * onset ? 1 : first_levels;
  table.levels = static_cast<std::size_t>(spacings) + table.first_levels - 1;
  return ImpactLevels::from_standstill(table.levels, table.first_levels, end);
}

ImpactLevels levels_by_octaves(VelocityAxis::Table& table, double first)
{
  const double end = table.impact_overlap.back(), range = octaves(end) - octaves(first);
  table.levels = 1 + static_cast<std::size_t>(std::max(1.0, std::round(levels_an_octave * range)));
  return ImpactLevels::by_octaves(table.levels, first, end);
}

void append(const std::vector<double>& values, std::vector<double>& all)
{
  all.insert(all.end(), values.begin(), values.end());
}

/// Where a level is examined about the onset: at it, then to 1.4 times its overlap, beyond which a contact's
/// own loss is a tenth of the work and more.
std::vector<double> overlaps_about_onset(const ContactCurve& curve, double impact_overlap)
{
  std::vector<double> overlaps = curve.margin_overlaps(impact_overlap);
  for (int k = 0; k <= 64; ++k) overlaps.push_back(curve.onset() * std::exp(0.005 * k));
  std::erase_if(overlaps, [&](double x) {
    return x <= curve.onset() || x > 1.4 * curve.onset() || x >= curve.x_end();
  });
  overlaps.push_back(curve.onset() * (1 + 1e-9));
  std::sort(overlaps.begin(), overlaps.end());
  return overlaps;
}

/// Of W_L or the force: what a closed cycle is kept from gaining; half of it may hide between two overlaps
/// examined.
constexpr double spare = 1e-4;

/// A rise of a node's exponent, and what is gained without.
struct ExponentRise
{
  std::size_t node;
  double value, gain;
};

/// The least rise with which a contact reversed at x gains nothing, at the node on either side of x where it
/// does more. W_u = F (delta_m - delta_r) (11 - 2 n + A/5)/21 falls by about 2/21 F x a unit; the cubic has
/// the share t^2 (3 - 2 t) of the node after x.
ExponentRise exponent_rise_at(const ContactCurve& curve, double x, double impact_overlap)
{
  const bool at_onset = x < curve.onset() * (1 + 1e-8);
  // of W_L, about F x/2.5, at the onset; of F, beyond
  const double gain =
      at_onset ? curve.work_unloading(x, impact_overlap) / curve.work_loading(x, impact_overlap) - 1
               : -curve.margin_at(x, impact_overlap);
  const double place = x / impact_overlap / ImpactLevel::share_spacing, t = place - std::floor(place);
  const double share = t * t * (3 - 2 * t), slope = at_onset ? 0.0 : 6 * t * (1 - t) * place;
  const double after = 2.5 * share + slope, before = 2.5 - after;
  const auto node = static_cast<std::size_t>(place) + (after > before ? 1 : 0);
  return {node, (gain + spare) / (2. / 21 * std::max(after, before)), gain};
}

/// Cubics between nodes and means of two levels follow a loss that begins at the onset to some thousandths of
/// the force. Where so much would be gained a node's exponent is raised in both levels by what makes up for
/// it: contacts that reverse about that node lose more, no others do.
void lose_what_cubics_gain(VelocityAxis::Table& table, const ContactCurve& slow)
{
  constexpr int most_rounds = 20;
  const std::size_t columns = table.ratio_nodes();
  for (int round = 0; round < most_rounds; ++round) {
    const ContactCurve curve(slow.table(), table, "fitted curve");
    std::vector<double> rises(table.exponent_correction.size(), 0.0);
    double most_gain = -spare;
    for (const double impact_overlap : curve.axis()->examined_overlaps())
      for (const double x : overlaps_about_onset(curve, impact_overlap)) {
        const ExponentRise rise = exponent_rise_at(curve, x, impact_overlap);
        most_gain = std::max(most_gain, rise.gain);
        const double row = curve.axis()->scale().row(impact_overlap);
        for (const double level : {std::floor(row), std::ceil(row)})
          if (level >= 1) {
            const std::size_t column = std::min(rise.node, columns - 1);
            double& most = rises[(static_cast<std::size_t>(level) - 1) * columns + column];
            most = std::max(most, rise.value);
          }
      }
    if (most_gain < -0.5 * spare) return;
    for (std::size_t k = 0; k < rises.size(); ++k) table.exponent_correction[k] += rises[k];
  }
}

/// The table with these levels, whose force is known.
VelocityAxis::Table with_losses(VelocityAxis::Table table, std::vector<ImpactLevel> levels,
                                const std::vector<LawShape::VelocityEffect>& effects,
                                const ContactCurve& slow)
{
  for (std::size_t k = 0; k < levels.size(); ++k) {
    ImpactLevel& level = levels[k];
    tabulate_losses(level, effects[k], slow);
    append(level.force, table.force_correction), append(level.force_slope, table.force_correction_slope);
    append(level.residual, table.residual_correction);
    append(level.residual_slope, table.residual_correction_slope);
    append(level.exponent, table.exponent_correction);
    append(level.exponent_slope, table.exponent_correction_slope);
  }
  lose_what_cubics_gain(table, slow);
  return table;
}

/// `fastest`, or less where an impact would reverse beyond the table; throws where none was as fast.
double end_of_axis(const LawShape& shape, const ContactCurve& slow, const ImpactsBySpeed& impacts,
                   double fastest)
{
  const double last = shape.velocity_effects.empty() ? 0 : shape.velocity_effects.back().speed;
  if (!(fastest > 0 && fastest <= last * 1.0001))
    fail("fit", "no impact was as fast", fmt::format("sqrt(I) = {:.4g}", fastest),
         fmt::format("up to {:.4g}", last));
  while (impacts.impact_overlap(fastest) > slow.x_end())
    fastest *= std::min(0.98, std::sqrt(slow.x_end() / impacts.impact_overlap(fastest)));
  return fastest;
}

/// What impacts to the levels' overlaps change.
std::vector<LawShape::VelocityEffect> effects_at(const ImpactLevels& scale, const VelocityAxis::Table& table,
                                                 const ImpactsBySpeed& impacts)
{
  std::vector<LawShape::VelocityEffect> effects;
  for (std::size_t k = 1; k <= table.levels; ++k)
    effects.push_back(impacts.effect(
        impacts.speed(scale.overlap(static_cast<double>(k)), table.speed_begin, table.speed_end)));
  return effects;
}

/// The levels whose force stands, at the overlaps that `scale` says; empty where one ends too early.
std::vector<ImpactLevel> rate_levels(const VelocityAxis::Table& table, const ImpactLevels& scale,
                                     const std::vector<LawShape::VelocityEffect>& effects,
                                     const ContactCurve& slow)
{
  std::vector<ImpactLevel> levels(table.levels);
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const auto row = static_cast<double>(k + 1);
    levels[k].impact_overlap = scale.overlap(row);
    levels[k].overlap_below = scale.overlap(row - 0.5);
    const std::vector<double> beside{scale.overlap(row - 1), scale.overlap(row + 1)};
    if (!tabulate_rate_force(levels[k], effects[k], slow, beside, table.ratio_end)) return {};
  }
  return levels;
}

}  // namespace

VelocityAxis::Table tabulate_inertia(const LawShape& shape, const ContactCurve& slow,
                                     double e_star_over_yield, double mass, double fastest)
{
  const ImpactsBySpeed impacts(shape, slow, energy_unit(mass, 1 / e_star_over_yield),
                               VelocityAxis::Kind::inertia);
  VelocityAxis::Table table;
  table.speed_end = end_of_axis(shape, slow, impacts, fastest);
  table.ratio_end = usual_ratio_end;
  tabulate_overlaps(table, impacts,
                    std::max(3, static_cast<int>(std::ceil(table.speed_end / speed_spacing - 1e-9))));
  const ImpactLevels scale = levels_from_standstill(table, slow.onset());
  const std::vector<LawShape::VelocityEffect> effects = effects_at(scale, table, impacts);
  std::vector<ImpactLevel> levels(table.levels);
  for (std::size_t k = 0; k < levels.size(); ++k) {
    levels[k].impact_overlap = scale.overlap(static_cast<double>(k + 1));
    levels[k].overlap_below = scale.overlap(static_cast<double>(k) + 0.5);
    tabulate_inertia_force(levels[k], effects[k], table.ratio_end);
  }
  return with_losses(table, levels, effects, slow);
}

VelocityAxis::Table tabulate_rate(const LawShape& shape, const ContactCurve& slow, double e_star_over_yield,
                                  double mass, double fastest, double reference_radius)
{
  const ImpactsBySpeed impacts(shape, slow, energy_unit(mass, 1 / e_star_over_yield),
                               VelocityAxis::Kind::rate);
  VelocityAxis::Table table;
  table.kind = VelocityAxis::Kind::rate;
  table.reference_radius = reference_radius;
  table.speed_end = end_of_axis(shape, slow, impacts, fastest);
  table.speed_begin = shape.velocity_effects.front().speed;
  if (!(table.speed_begin < 0.7 * table.speed_end))
    fail("fit", "the slowest and the fastest impact of a rate-dependent law are too near to each other",
         fmt::format("sqrt(I) = {:.4g} and {:.4g}", table.speed_begin, table.speed_end), "1.5 times or more");
  // X(v) is as v^0.8 to v: an eighth of the first speed a step, and one table for all
  const double steps = std::clamp(8 * table.speed_end / table.speed_begin, 16.0, 2048.0);
  tabulate_overlaps(table, impacts, static_cast<int>(steps));
  const ImpactLevels scale = levels_by_octaves(table, impacts.impact_overlap(table.speed_begin));
  const std::vector<LawShape::VelocityEffect> effects = effects_at(scale, table, impacts);
  // further out, where a force that keeps its peak is not yet the press's
  constexpr double farthest = 12;
  std::vector<ImpactLevel> levels;
  table.ratio_end = usual_ratio_end;
  while ((levels = rate_levels(table, scale, effects, slow)).empty()) {
    table.ratio_end =
        ImpactLevel::share_spacing * std::ceil(1.2 * table.ratio_end / ImpactLevel::share_spacing);
    if (table.ratio_end > farthest)
      fail("fit", "a rate raises the force so much that it is the press's again only far beyond the impacts",
           fmt::format("over {:g} of their overlap", farthest));
  }
  return with_losses(table, levels, effects, slow);
}

}  // namespace granulaw
