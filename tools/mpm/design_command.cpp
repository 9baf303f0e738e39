// mpm design: which measurement would narrow what is wanted most.
#include <algorithm>
#include <cmath>
#include <memory>

#include "atlas_path.hpp"
#include "base/error.hpp"
#include "calibrate/design.hpp"
#include "calibration_options.hpp"
#include "command.hpp"
#include "json_output.hpp"
#include "option_checks.hpp"

namespace granulaw {

namespace {

struct DesignRequest
{
  CalibrationOptions options;
  std::string speeds, displacements;
  std::vector<std::string> guess;
  int count = 8, places = 13;
  double highest = 10;
  bool json = false;
};

constexpr double gravity = 9.81;

double drop_height(double speed)
{
  return speed * speed / (2 * gravity);
}

/// Evenly in the logarithm, up to `most`, whose reason is `why`.
void add_candidates(std::vector<DesignCandidate>& all, MeasurementKind kind, const std::string& range,
                    const char* option, int places, double most, const std::string& why)
{
  if (range.empty()) return;
  Range r = parse_range(range, option);
  if (r.low >= most) fail(option, "none of these measurements can be made", range, why);
  if (r.high > most) fmt::print(stderr, "mpm: {} {}: left out beyond {}\n", option, range, why);
  r.high = std::min(r.high, most);
  for (int k = 0; k < places; ++k)
    all.push_back({kind, r.low * std::pow(r.high / r.low, static_cast<double>(k) / (places - 1))});
}

/// The material by which the design goes: the guess, else what the data say.
CandidateMaterial assumed_material(const DesignRequest& r, const CalibrationRequest& request,
                                   const Atlas& atlas)
{
  if (r.guess.empty()) {
    if (request.measurements.empty())
      fail("--guess",
           "is missing: without data the design needs a material to go by, such as yield_stress=50e6");
    const Calibration c = calibrate(CalibrationProblem(atlas, request));
    if (!c.bound.empty())
      fail("mpm design", "the fit of DATA lies at an end of the method's range, " + c.bound +
                             ": give a --guess without these data");
    return c.material;
  }
  CandidateMaterial m = request.known;
  for (const std::string& word : r.guess) {
    const auto equals = word.find('=');
    const double value = equals == std::string::npos ? -1 : number_in(word.substr(equals + 1));
    require(value >= 0, "--guess", fmt::format("'{}'", cut(word)), "NAME=VALUE, SI");
    set_value(m, parameter_named(word.substr(0, equals), "--guess"), value);
  }
  for (const Parameter p : {Parameter::youngs_modulus, Parameter::yield_stress})
    if (!(value_of(m, p) > 0)) fail("--guess", fmt::format("{} is neither given nor guessed", name_of(p)));
  if (const std::string why = atlas.why_not(MaterialRatios::of(m)); !why.empty())
    fail("--guess", "this material is not in the atlas: " + why);
  return m;
}

std::string label(const DesignCandidate& c)
{
  return is_curve(c.kind)
             ? fmt::format("platens to {:.3g} m", c.place)
             : fmt::format("impact at {:.3g} m/s (from {:.3g} m)", c.place, drop_height(c.place));
}

std::string cells(const ExpectedIntervals& widths)
{
  std::string text;
  for (const double w : widths)
    text += w < 1 ? fmt::format("{:>18.2g} %", 100 * w) : fmt::format("{:>20}", "cannot be told");
  return text;
}

void print(const DesignRequest& r, const Design& design, const std::vector<std::size_t>& plan, bool has_data)
{
  fmt::print("expected 95 % interval, +-{:<23}", "");
  for (const std::string& name : r.options.fit) fmt::print("{:>20}", name);
  fmt::print("\n");
  if (has_data) fmt::print("{:<48}{}\n", "what there is", cells(design.expected({})));
  for (std::size_t k = 0; k < design.candidates().size(); ++k) {
    const bool curve = is_curve(design.candidates()[k].kind);
    const std::vector<std::size_t> copies(curve ? 1 : static_cast<std::size_t>(r.count), k);
    fmt::print("{:<48}{}\n",
               fmt::format("{} {}", curve ? "1" : std::to_string(r.count), label(design.candidates()[k])),
               cells(design.expected(copies)));
  }
  const ExpectedIntervals best = design.expected(plan);
  if (std::all_of(best.begin(), best.end(), [](double width) { return width >= 1; })) {
    fmt::print("none of these measurements tells what is wanted, {} of them neither\n", plan.size());
    return;
  }
  fmt::print("best {} measurements:\n", plan.size());
  for (std::size_t k = 0; k < design.candidates().size(); ++k)
    if (const auto n = std::count(plan.begin(), plan.end(), k); n > 0)
      fmt::print("  {} {}\n", n, label(design.candidates()[k]));
  fmt::print("{:<48}{}\n", "  together", cells(best));
}

nlohmann::ordered_json widths_json(const DesignRequest& r, const ExpectedIntervals& widths)
{
  nlohmann::ordered_json out;
  for (std::size_t k = 0; k < widths.size(); ++k) out[r.options.fit[k]] = json_number(widths[k]);
  return out;
}

void print_as_json(const DesignRequest& r, const Design& design, const std::vector<std::size_t>& plan)
{
  nlohmann::ordered_json out;
  out["what_there_is"] = widths_json(r, design.expected({}));
  out["candidates"] = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < design.candidates().size(); ++k) {
    const DesignCandidate& c = design.candidates()[k];
    const std::vector<std::size_t> copies(is_curve(c.kind) ? 1 : static_cast<std::size_t>(r.count), k);
    out["candidates"].push_back({{"kind", is_curve(c.kind) ? "platens" : "restitution"},
                                 {is_curve(c.kind) ? "displacement_m" : "velocity_m_per_s", c.place},
                                 {"copies", copies.size()},
                                 {"in_best", std::count(plan.begin(), plan.end(), k)},
                                 {"expected95", widths_json(r, design.expected(copies))}});
  }
  out["best"] = widths_json(r, design.expected(plan));
  print_json(out, 2);
}

/// As fast as a drop from the highest place, and as the atlas goes for the material.
void add_speeds(std::vector<DesignCandidate>& all, const DesignRequest& r, const CandidateMaterial& assumed)
{
  const double drop = std::sqrt(2 * gravity * r.highest),
               end = SphereLaws::fastest * std::sqrt(assumed.yield_stress / assumed.density);
  add_candidates(all, MeasurementKind::restitution, r.speeds, "--speeds", r.places, std::min(drop, end),
                 drop < end
                     ? fmt::format("{:.3g} m/s, a drop from {:g} m (--highest)", drop, r.highest)
                     : fmt::format("{:.3g} m/s, where the atlas ends for this material (rho V^2/Y = {:g})",
                                   end, SphereLaws::fastest * SphereLaws::fastest));
}

void run(const DesignRequest& r)
{
  const CalibrationRequest request = r.options.request();
  if (!r.speeds.empty() && !r.options.density) fail("--density", "is missing: impacts depend on it");
  if (r.speeds.empty() && r.displacements.empty())
    fail("mpm design", "nothing to choose from: give --speeds, --displacements or both");
  const std::optional<Atlas> atlas = own_atlas();
  if (!atlas) fail("mpm design", "the atlas is not beside the program (docs/evidence/atlas.md)");
  const CandidateMaterial assumed = assumed_material(r, request, *atlas);
  std::vector<DesignCandidate> candidates;
  add_speeds(candidates, r, assumed);
  const double deepest = 2 * MidplaneShapes::depth * *r.options.radius;
  add_candidates(candidates, MeasurementKind::platens, r.displacements, "--displacements", r.places, deepest,
                 fmt::format("{:.3g} m, where the atlas ends", deepest));
  const Design design(*atlas, request, assumed, candidates, *r.options.radius, r.options.relative_sd);
  const std::vector<std::size_t> plan = design.best(static_cast<std::size_t>(r.count));
  if (r.json)
    print_as_json(r, design, plan);
  else
    print(r, design, plan, !request.measurements.empty());
}

void define(CLI::App& command)
{
  const auto r = std::make_shared<DesignRequest>();
  r->options.add_to(command, false);
  command.add_option("--guess", r->guess,
                     "NAME=VALUE of what is fitted, Pa: the material to go by (default: what DATA say)");
  command.add_option("--speeds", r->speeds, "LOW..HIGH, m/s: impacts that could be made");
  command
      .add_option("--highest", r->highest, "m: highest drop that can be made; faster impacts are left out")
      ->check(above_zero_to(1e3))
      ->capture_default_str();
  command.add_option("--displacements", r->displacements,
                     "LOW..HIGH, m: largest displacements of curves between platens that could be made");
  command.add_option("--count", r->count, "measurements to be made")
      ->check(whole_from_to(1, 100))
      ->capture_default_str();
  command.add_option("--places", r->places, "candidates in each range")
      ->check(whole_from_to(2, 100))
      ->capture_default_str();
  command.add_flag("--json", r->json, "print one JSON object instead of the table");
  command.callback([r] { run(*r); });
}

}  // namespace

extern const Command design_command{
    "design",
    "Which measurement would narrow what is wanted most: expected intervals of impacts at given speeds and "
    "of\n"
    "curves between platens, given what was measured already (docs/guide/calibrate.md).\n"
    "Example: mpm design --fit yield_stress --youngs-modulus 3e9 --guess yield_stress=40e6 --radius 1e-3\n"
    "         --density 1500 --speeds 0.1..5",
    define};

}  // namespace granulaw
