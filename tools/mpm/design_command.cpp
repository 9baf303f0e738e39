// mpm design: which measurement would narrow what is wanted most.
#include <algorithm>
#include <cmath>
#include <memory>

#include "base/error.hpp"
#include "calibrate/design.hpp"
#include "calibrate/kind/kind.hpp"
#include "calibration_options.hpp"
#include "command.hpp"
#include "json_output.hpp"
#include "option_checks.hpp"
#include "own_files.hpp"

namespace granulaw {

namespace of_design {

struct DesignRequest
{
  CalibrationOptions options;
  std::string speeds, displacements;
  std::vector<std::string> guess, measure;
  int count = 8, places = 13;
  double highest = 10;
  bool json = false;
};

constexpr double gravity = 9.81;

double drop_height(double speed) { return speed * speed / (2 * gravity); }

/// Evenly in the logarithm, up to `most`, whose reason is `why`.
void add_candidates(
    std::vector<DesignCandidate>& all, const Measurement& form, const std::string& range, const char* option, int places, double most, const std::string& why)
{
  Range r = parse_range(range, option);
  if (r.low >= most) fail(option, "none of these measurements can be made", range, why);
  if (r.high > most) fmt::print(stderr, "mpm: {} {}: left out beyond {}\n", option, range, why);
  r.high = std::min(r.high, most);
  for (int k = 0; k < places; ++k) all.push_back({form, r.low * std::pow(r.high / r.low, static_cast<double>(k) / (places - 1))});
}

/// The material by which the design goes: the guess, else what the data say.
CandidateMaterial assumed_material(const DesignRequest& r, const CalibrationRequest& request, const Atlas& atlas)
{
  if (r.guess.empty()) {
    if (request.measurements.empty()) fail("--guess", "is missing: without data the design needs a material to go by, such as yield_stress=50e6");
    const Calibration c = calibrate(CalibrationProblem(atlas, request));
    if (!c.has_values())
      fail("design",
          (c.bound.empty() ? "no parameters follow DATA" : "the fit of DATA lies at an end of the method's range, " + c.bound) + ": give a --guess without these data");
    return c.material;
  }
  CandidateMaterial m = request.known;
  for (const std::string& word : r.guess) {
    const auto equals = word.find('=');
    const double value = equals == std::string::npos ? -1 : number_in(word.substr(equals + 1)).value_or(-1);
    require(value >= 0, "--guess", fmt::format("'{}'", cut(word)), "NAME=VALUE, SI");
    set_value(m, parameter_named(word.substr(0, equals), "--guess"), value);
  }
  for (const Parameter p : {Parameter::youngs_modulus, Parameter::yield_stress})
    if (!(value_of(m, p) > 0)) fail("--guess", fmt::format("{} is neither given nor guessed", name_of(p)));
  if (const std::string why = atlas.why_not(MaterialRatios::of(m)); !why.empty()) fail("--guess", "this material is not in the atlas: " + why);
  return m;
}

/// "impact at 2 m/s (from 0.2 m)", "platens to 1e-05 m", "hardness"
std::string label(const DesignCandidate& c)
{
  const Kind& kind = *c.form.kind;
  if (!kind.x.exists()) return kind.name;
  if (kind.planned) return fmt::format("{} to {:.3g} m", kind.name, c.place);
  return fmt::format("{} at {:.3g} m/s (from {:.3g} m)", &kind == kinds().front() ? "impact" : kind.name, c.place, drop_height(c.place));
}

/// As many copies of a candidate as shall be made: a curve is dear, one of it.
std::vector<std::size_t> copies_of(const DesignRequest& r, const Design& design, std::size_t k)
{
  const bool once = design.candidates()[k].form.kind->planned;
  return std::vector<std::size_t>(once ? 1 : static_cast<std::size_t>(r.count), k);
}

std::string cells(const ExpectedIntervals& widths)
{
  std::string text;
  for (const double w : widths) text += w < 1 ? fmt::format("{:>18.2g} %", 100 * w) : fmt::format("{:>20}", "not determined");
  return text;
}

void print(const DesignRequest& r, const Design& design, const std::vector<std::size_t>& plan, bool has_data)
{
  fmt::print("expected 95 % interval, +-{:<23}", "");
  for (const std::string& name : r.options.fit) fmt::print("{:>20}", name);
  fmt::print("\n");
  if (has_data) fmt::print("{:<48}{}\n", "what there is", cells(design.expected({})));
  for (std::size_t k = 0; k < design.candidates().size(); ++k) {
    const std::vector<std::size_t> copies = copies_of(r, design, k);
    fmt::print("{:<48}{}\n", fmt::format("{} {}", copies.size(), label(design.candidates()[k])), cells(design.expected(copies)));
  }
  const ExpectedIntervals best = design.expected(plan);
  if (std::all_of(best.begin(), best.end(), [](double width) { return width >= 1; })) {
    fmt::print("no measurement of these determines the wanted parameters, nor do {} of them\n", plan.size());
    return;
  }
  fmt::print("best {} measurements:\n", plan.size());
  for (std::size_t k = 0; k < design.candidates().size(); ++k)
    if (const auto n = std::count(plan.begin(), plan.end(), k); n > 0) fmt::print("  {} {}\n", n, label(design.candidates()[k]));
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
    const std::vector<std::size_t> copies = copies_of(r, design, k);
    nlohmann::ordered_json candidate{{"kind", c.form.kind->name}};
    if (c.form.kind->x.exists()) candidate[c.form.kind->x.name()] = c.place;
    candidate["copies"] = copies.size();
    candidate["in_best"] = std::count(plan.begin(), plan.end(), k);
    candidate["expected95"] = widths_json(r, design.expected(copies));
    out["candidates"].push_back(std::move(candidate));
  }
  out["best"] = widths_json(r, design.expected(plan));
  print_json(out);
}

/// The kinds to choose from: those of --measure, else drops and the curves of --kind.
std::vector<const Kind*> kinds_of(const DesignRequest& r)
{
  std::vector<const Kind*> chosen;
  for (const std::string& name : r.measure) chosen.push_back(&kind_named(name, "--measure"));
  if (!chosen.empty()) return chosen;
  if (!r.speeds.empty()) chosen.push_back(kinds().front());
  if (!r.displacements.empty()) chosen.push_back(&r.options.curves());
  return chosen;
}

std::vector<DesignCandidate> candidates_of(const DesignRequest& r, const CandidateMaterial& assumed)
{
  const double drop = std::sqrt(2 * gravity * r.highest), end = SphereLaws::fastest * std::sqrt(assumed.yield_stress / assumed.density);
  std::vector<DesignCandidate> all;
  for (const Kind* kind : kinds_of(r)) {
    const Measurement form = r.options.form(*kind, kind->name);
    const auto needs = [&](const std::string& range, const char* option) {
      if (range.empty()) fail(option, fmt::format("is missing: of the kind '{}'", kind->name));
    };
    if (!kind->x.exists()) {
      all.push_back({form, 0});
    } else if (kind->planned) {
      needs(r.displacements, "--displacements");
      const double deepest = kind->deepest(form) * form.effective_radius() * kind->contacts;
      add_candidates(all, form, r.displacements, "--displacements", r.places, deepest, fmt::format("{:.3g} m, where the atlas ends", deepest));
    } else {
      needs(r.speeds, "--speeds");
      add_candidates(all, form, r.speeds, "--speeds", r.places, std::min(drop, end),
          drop < end ? fmt::format("{:.3g} m/s, a drop from {:g} m (--highest)", drop, r.highest)
                     : fmt::format("{:.3g} m/s, where the atlas ends for this material (rho V^2/Y = {:g})", end, SphereLaws::fastest * SphereLaws::fastest));
    }
  }
  return all;
}

void run(const DesignRequest& r)
{
  const CalibrationRequest request = r.options.request();
  if (!r.speeds.empty() && !r.options.density) fail("--density", "is missing: impacts depend on it");
  if (r.speeds.empty() && r.displacements.empty() && r.measure.empty()) fail("design", "nothing to choose from: give --speeds, --displacements or --measure");
  const std::optional<Atlas> atlas = own_atlas();
  if (!atlas) fail("design", "the atlas is not beside the program (docs/evidence/atlas.md)");
  const CandidateMaterial assumed = assumed_material(r, request, *atlas);
  const Design design(*atlas, request, assumed, candidates_of(r, assumed), r.options.relative_sd);
  const std::vector<std::size_t> plan = design.best(static_cast<std::size_t>(r.count));
  if (r.json)
    print_as_json(r, design, plan);
  else
    print(r, design, plan, !request.measurements.empty());
}

void define(Options& command)
{
  const auto r = std::make_shared<DesignRequest>();
  r->options.add_to(command, false);
  command.add_option("--guess", r->guess, "NAME=VALUE of what is fitted, Pa: the material to go by (default: what DATA say)");
  command
      .add_option(
          "--measure", r->measure, "kinds that could be measured: restitution, hardness, ... (default: restitution at --speeds, curves of --kind to --displacements)")
      .list();
  command.add_option("--speeds", r->speeds, "LOW..HIGH, m/s: impacts that could be made");
  command.add_option("--highest", r->highest, "m: highest drop that can be made; faster impacts are left out").check(above_zero_to(1e3)).capture_default_str();
  command.add_option("--displacements", r->displacements, "LOW..HIGH, m: largest displacements of curves that could be made");
  command.add_option("--count", r->count, "measurements to be made").check(whole_from_to(1, 100)).capture_default_str();
  command.add_option("--places", r->places, "candidates in each range").check(whole_from_to(2, 100)).capture_default_str();
  command.add_flag("--json", r->json, "print one JSON object instead of the table");
  command.callback([r] { run(*r); });
}

}  // namespace of_design

extern const Command design_command{"design",
    "Recommends the next measurement: the one that narrows the wanted intervals most. Prints expected\n"
    "intervals of impacts at given speeds and of curves between platens, with the data that exist\n"
    "(docs/guide/calibrate.md).\n"
    "Example: mpm design --fit yield_stress --youngs-modulus 3e9 --guess yield_stress=40e6 --radius 1e-3\n"
    "         --density 1500 --speeds 0.1..5",
    of_design::define};

}  // namespace granulaw
