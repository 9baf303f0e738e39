// Hardness: the flow stress at the strain of the dent times the constraint of the solver's own indentations
// (docs/theory/calibration.md).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "base/error.hpp"
#include "calibrate/kind/hardness_table.hpp"
#include "calibrate/kind/kind.hpp"
#include "calibrate/problem.hpp"
#include "solver/material/law_table.hpp"

namespace granulaw {

namespace {

/// Sd of a hardness, relative: 4 % for a hardening that is unknown, 2 % for the corners of the dent, 1 % each for
/// friction, Poisson's ratio and grid, 2.5 % for the tester (docs/evidence/hardness.md).
constexpr double hardness_error = 0.054;

constexpr double vickers_strain = 0.08, brinell_strain = 0.2;  // plastic; over a/R (Tabor 1951)

/// Flow stress at a strain, and its logarithmic slope about there.
struct Flow
{
  double stress, exponent;
};

Flow flow_at(const Material& m, double strain)
{
  return {flow_stress(m, strain), std::log(flow_stress(m, 2 * strain) / flow_stress(m, 0.5 * strain)) / std::log(4.0)};
}

/// Place among ascending nodes: the lower one, and the way to the next, 0 to 1; held at both ends.
struct Place
{
  std::size_t lower;
  double way;
  /// Between the values of two nodes.
  double between(double low, double high) const { return (1 - way) * low + way * high; }
};

Place place_in(std::span<const double> nodes, double x)
{
  const auto upper = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, x) - nodes.begin();
  const auto k = static_cast<std::size_t>(upper - 1);
  return {k, std::clamp((x - nodes[k]) / (nodes[k + 1] - nodes[k]), 0.0, 1.0)};
}

/// Linear in the exponent, the logarithm of the stiffness and the place. Softer than the table a contact is elastic:
/// the pressure goes with the stiffness. An exponent below the table's, a tenth, counts as that: hardening that a fit
/// leaves out is unknown, not absent, and metals have 0.05 to 0.25.
template <std::size_t Exponents, std::size_t Stiffnesses, std::size_t Places>
double constraint(const HardnessTable<Exponents, Stiffnesses, Places>& table, const Flow& flow, double e_star,
                  double place = 0)
{
  const double stiffness = e_star / flow.stress;
  const Place n = place_in(table.exponents, flow.exponent);
  const Place k = place_in(table.log_stiffnesses, std::log(stiffness));
  const auto at = [&](std::size_t p) {
    const auto along = [&](std::size_t row) {
      const auto& values = table.values[p][row];
      return k.between(values[k.lower], values[k.lower + 1]);
    };
    return n.between(along(n.lower), along(n.lower + 1));
  };
  const double softer = std::min(1.0, stiffness / std::exp(table.log_stiffnesses.front()));
  if constexpr (Places == 1) return softer * at(0);
  const Place p = place_in(table.places, place);
  return softer * p.between(at(p.lower), at(p.lower + 1));
}

double vickers(const CandidateMaterial& m)
{
  const Flow flow = flow_at(solver_material(m), vickers_strain);
  return flow.stress * constraint(vickers_table, flow, m.e_star());
}

/// a/R of the dent by a ball of diameter D under `load` D^2: pi a^2 p = load D^2.
double brinell_dent(const CandidateMaterial& m, double load)
{
  const Material material = solver_material(m);
  double low = 1e-4, high = 0.99;
  for (int k = 0; k < 60; ++k) {
    const double u = std::sqrt(low * high);
    const Flow flow = flow_at(material, brinell_strain * u);
    (M_PI * u * u * flow.stress * constraint(brinell_table, flow, m.e_star(), u) < 4 * load ? low : high) = u;
  }
  return low;
}

/// F over the area of the ball's cap.
double brinell(const CandidateMaterial& m, double load)
{
  const double u = brinell_dent(m, load);
  return 2 * load / (M_PI * (1 - std::sqrt(1 - u * u)));
}

/// The table is of dents of 0.25 to 0.55 of the ball's diameter.
void check_dents(const Measurement& m, double load)
{
  for (const Datum& d : m.data) {
    const double left = 1 - 2 * load / (M_PI * d.y), dent = left > 0 ? std::sqrt(1 - left * left) : 1;
    if (dent < 0.15 || dent > 0.7)
      fail(fmt::format("{}:{}", m.source, d.line), "the dent of that hardness, over the ball's diameter, is out of range",
           fmt::format("{:.2g}", dent), "0.15 to 0.7; F/D^2 or the unit may be another");
  }
}

Prediction of_hardness(const Measurement& m, const Trial& t, double hardness)
{
  if (!m.ratio_to_yield) return same_value(m, hardness, hardness * hardness_error);
  const auto [low, high] = *m.ratio_to_yield;
  const double value = std::sqrt(low * high) * t.material.yield_stress;
  return same_value(m, value, std::log(high / low) / (2 * normal95) * value);
}

void likely_yield(const Measurement& m, const LawMaterial&, std::vector<double>& likely)
{
  for (const double ratio : {3.0, 2.5, 2.0, 1.5}) likely.push_back(m.data.front().y / ratio);
}

constexpr Kind vickers_kind()
{
  return {.name = "hardness",
          .help = "Vickers: force over the dent's sloping area, by its diagonals",
          .y = {.quantity = "hardness", .unit = "Pa"},
          .shows = Kind::Shows::slow,
          .has_ratio_to_yield = true,
          .flow_strain = [](const CandidateMaterial&) { return vickers_strain; },
          .predict = [](const Measurement& m, const Trial& t) { return of_hardness(m, t, vickers(t.material)); },
          .starts = likely_yield,
          .model_error = [](const AtlasErrors&) { return hardness_error; }};
}

/// Brinell's, F/D^2 in kgf/mm^2.
template <int Ratio>
constexpr Kind brinell_kind(const char* name, const char* quantity, const char* help)
{
  constexpr double load = Ratio * kilogram_force;
  Kind kind = vickers_kind();
  kind.name = name, kind.help = help, kind.y.quantity = quantity, kind.has_ratio_to_yield = false;
  kind.predict = [](const Measurement& m, const Trial& t) { return of_hardness(m, t, brinell(t.material, load)); };
  kind.flow_strain = [](const CandidateMaterial& m) { return brinell_strain * brinell_dent(m, load); };
  kind.check_rows = [](const Measurement& m) { check_dents(m, load); };
  return kind;
}

}  // namespace

extern const Kind hardness_kind = vickers_kind();
extern const Kind brinell_30_kind = brinell_kind<30>("Brinell hardness 30", "brinell_30_hardness",
                                                     "Brinell with F/D^2 = 30 kgf/mm^2, as HBW 10/3000"),
                  brinell_10_kind = brinell_kind<10>("Brinell hardness 10", "brinell_10_hardness",
                                                     "the same with 10, as HBW 10/1000"),
                  brinell_5_kind = brinell_kind<5>("Brinell hardness 5", "brinell_5_hardness",
                                                   "the same with 5, as HBW 10/500");

}  // namespace granulaw
