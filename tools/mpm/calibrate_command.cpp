// mpm calibrate: from measurements to a material.
#include <filesystem>
#include <memory>

#include "atlas/law_from_atlas.hpp"
#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "calibrate/calibrate_by_runs.hpp"
#include "calibrate/cycles.hpp"
#include "calibrate/leeb.hpp"
#include "calibrate/material_toml.hpp"
#include "calibrate/pull_off.hpp"
#include "calibrate/sphere_laws.hpp"
#include "calibration_options.hpp"
#include "calibration_output.hpp"
#include "characterise/build/build_law.hpp"
#include "command.hpp"
#include "contact/adhesion.hpp"
#include "farm_options.hpp"
#include "json_output.hpp"
#include "material_file/plausible.hpp"
#include "option_checks.hpp"
#include "own_files.hpp"
#include "terminal.hpp"

namespace granulaw {

namespace of_calibrate {

struct CalibrateRequest
{
  CalibrationOptions options;
  FarmOptions farm;
  std::string output, plot, reference;
  double adhesion_range = usual_adhesion_range;
  int ensemble = 0;
  unsigned seed = 1;
  bool json = false;
};

/// material.toml -> material-07.toml
std::string numbered(const std::string& path, int number, int count)
{
  const std::filesystem::path p(path);
  const auto digits = std::to_string(count).size();
  return (p.parent_path() / fmt::format("{}-{:0{}}{}", p.stem().string(), number, digits, p.extension().string())).string();
}

void write_ensemble(const CalibrateRequest& r, const CalibrationProblem& problem, const Calibration& c)
{
  const std::vector<CandidateMaterial> drawn = draw_materials(problem, c, r.ensemble, r.seed);
  for (int k = 1; k <= r.ensemble; ++k)
    write_text_atomically(numbered(r.output, k, r.ensemble),
        material_toml(drawn[static_cast<std::size_t>(k) - 1], fmt::format("# draw {} of {} from the posterior: mpm calibrate --seed {}\n", k, r.ensemble, r.seed)));
}

void check_outputs(const CalibrateRequest& r)
{
  check_output("-o", r.output, ".toml");
  check_output("--plot", r.plot, ".png, .pdf, .svg");
  if (r.ensemble > 0 && r.output.empty()) fail("--ensemble", "needs -o NAME.toml: its files are NAME-1.toml, ...");
  if (!r.output.empty() && !r.options.density) fail("--density", "is missing: a materials file holds it");
}

/// Fit of hardening that is not in the atlas; prints its cost.
Calibration fit_by_runs(const CalibrateRequest& r, CalibrationProblem& problem, nlohmann::ordered_json& runs)
{
  const std::unique_ptr<Farm> farm = r.farm.farm();
  ProgressBar bar;
  const Atlas& atlas = problem.laws().atlas();
  const LawByRuns law_by_runs = [&](const std::string& name, const Material& material, double depth, const Progress& progress) {
    return slow_law_by_runs(name, material, depth, atlas, *farm, progress);
  };
  CalibrationByRuns fit = calibrate_by_runs(problem, law_by_runs, [&](double done, const std::string& what) { bar.update(done, what); });
  bar.clear();
  const FarmCount& count = farm->count();
  runs = {{"laws", fit.laws}, {"runs", count.made}, {"runs_from_cache", count.from_cache}, {"cpu_s", count.cpu_s}, {"miss_force", fit.miss_force},
      {"miss_restitution", fit.miss_restitution}};
  if (!r.json) {
    fmt::print("{} laws by the solver; the last is within {:.2g} % of F and {:.2g} of e of what the fit went by; ", fit.laws, 100 * fit.miss_force, fit.miss_restitution);
    print_count(count);
  }
  return std::move(fit.calibration);
}

/// Message in place of a material where there is none.
void state_no_values(const CalibrateRequest& r, const CalibrationProblem& problem, const Calibration& result, const nlohmann::ordered_json& json)
{
  if (r.json)
    print_json(json);
  else
    print_calibration(problem, result);
  const std::string why = result.bound.empty() ? "no parameters follow the data" : "the fit lies at an end of the method's range, " + result.bound;
  if (!r.output.empty()) fail(r.output, "is not written: " + why);
  if (!r.plot.empty()) fail(r.plot, "is not drawn: " + why);
}

/// "HL=760,HB=560": the two of a word, in any order.
std::pair<double, double> reference_of(const std::string& word)
{
  double leeb = 0, brinell = 0;
  for (std::size_t at = 0; at < word.size();) {
    const std::size_t end = std::min(word.find(',', at), word.size());
    const std::string part = word.substr(at, end - at);
    for (const auto& [key, value] : {std::pair{"HL=", &leeb}, std::pair{"HB=", &brinell}})
      if (part.starts_with(key)) *value = number_in(part.substr(3)).value_or(0);
    at = end + 1;
  }
  if (!(leeb > 0 && leeb < 1000 && brinell > 0 && std::isfinite(brinell)))
    fail("--reference", "cannot be understood", fmt::format("'{}'", word), "HL=VALUE,HB=VALUE of the tester's block: Leeb hardness below 1000, HBW 10/3000");
  return {leeb, brinell};
}

/// Static flow stress by the yield stress that a rebound tester's readings show; none: there are no such readings, or
/// the yield stress is not what was fitted.
std::optional<Estimate95> static_flow_stress(const CalibrateRequest& r, const CalibrationProblem& problem, const Calibration& c)
{
  const auto& all = problem.request().measurements;
  const auto reading = std::find_if(all.begin(), all.end(), [](const Measurement& m) { return m.is_leeb; });
  const auto fitted = std::find_if(c.parameters.begin(), c.parameters.end(), [](const FittedParameter& p) {
    return p.parameter == Parameter::yield_stress && p.identifiable();
  });
  if (reading == all.end() || fitted == c.parameters.end()) {
    if (!r.reference.empty()) fail("--reference", "goes with leeb_hardness and --fit yield_stress");
    return std::nullopt;
  }
  Estimate95 factor = usual_rate_factor(reading->body.compliance);
  if (!r.reference.empty()) {
    const auto [leeb, brinell] = reference_of(r.reference);
    factor = rate_factor_of(problem.laws().atlas(), *reading, leeb, brinell, problem.request().known);
  }
  const ParameterProfile& p = fitted->profile;
  return over({p.value, p.within95.low, p.within95.high}, factor);
}

constexpr const char* adhesion_name = "work_of_adhesion";

/// `--fit work_of_adhesion`: of pull-off forces of a known material.
void fit_adhesion_alone(const CalibrateRequest& r)
{
  const CalibrationOptions& o = r.options;
  if (o.fit.size() != 1 || o.data.size() != 1 || !r.output.empty() || !r.plot.empty() || r.ensemble > 0)
    fail("--fit", fmt::format("'{}' takes one file of pull-off forces, of a known material, and makes no file", adhesion_name));
  if (!(o.youngs_modulus && o.yield_stress && o.radius && std::isfinite(*o.radius)))
    fail("--fit", fmt::format("'{}' needs --youngs-modulus, --yield-stress and --radius", adhesion_name));
  const std::vector<PullOff> data = read_pull_offs(o.data.front());
  const std::optional<Atlas> atlas = own_atlas();
  if (!atlas) fail("calibrate", "the atlas is not beside the program (docs/evidence/atlas.md)");
  const LawMaterial material{o.name, o.density.value_or(1000), *o.youngs_modulus, o.poisson_ratio, *o.yield_stress, o.hardening_modulus.value_or(0)};
  const BodyLaw body = law_from(*atlas, material, {.depth = 0.3});
  const bool equal = o.partner != "wall";
  const PairLaw pair{{&body.curve, equal ? PairMapping::deformable_partner(material.e_star(), material.e_star()) : PairMapping::rigid_partner(material.e_star())}, &body};
  const FoundAdhesion found = fit_adhesion(pair, equal ? 0.5 * *o.radius : *o.radius, data, r.adhesion_range, o.data.front());
  const bool trend = std::abs(found.trend) > 0.1 && std::abs(found.trend) > 2 * found.trend_sd;
  if (r.json)
    return print_json({{"parameters", {{adhesion_name, {{"value", found.work}, {"low95", found.low}, {"high95", found.high}, {"unit", "J/m2"}}}}}, {"count", data.size()},
                       {"scatter", found.scatter}, {"preload_trend", found.trend}, {"follows_the_dent", !trend}});
  fmt::print("{}  {:.4g} J/m2 (95 %: {:.4g} to {:.4g}), of {} pull-off forces; they scatter by {:.2g} %\n", adhesion_name, found.work, found.low, found.high, data.size(),
             100 * found.scatter);
  if (trend)
    fmt::print("The pull-off forces grow with the preload to the power of {:.2g} {} than those of dents: rough surfaces, or another yield stress\n", std::abs(found.trend),
               found.trend > 0 ? "more" : "less");
}

void run(const CalibrateRequest& r)
{
  if (std::find(r.options.fit.begin(), r.options.fit.end(), adhesion_name) != r.options.fit.end()) return fit_adhesion_alone(r);
  check_outputs(r);
  r.farm.check();
  CalibrationRequest request = r.options.request();
  const std::optional<Atlas> atlas = own_atlas();
  if (!atlas) fail("calibrate", "the atlas is not beside the program (docs/evidence/atlas.md)");
  set_cycles_aside(*atlas, request);
  CalibrationProblem problem(*atlas, request);
  nlohmann::ordered_json runs;
  const Calibration result = request.known.hardens_linearly() ? calibrate(problem) : fit_by_runs(r, problem, runs);
  nlohmann::ordered_json json = calibration_json(problem, result);
  if (!runs.empty()) json["runs"] = runs;
  const std::optional<Estimate95> flow = result.has_values() ? static_flow_stress(r, problem, result) : std::nullopt;
  if (flow) json["static_flow_stress"] = {{"value", flow->value}, {"low95", flow->low}, {"high95", flow->high}, {"unit", "Pa"}};
  if (!result.has_values()) return state_no_values(r, problem, result, json);
  for (const FittedParameter& p : result.parameters)
    if (p.identifiable() && p.parameter <= Parameter::yield_stress) check_plausible("the fit", name_of(p.parameter), name_of(p.parameter), p.profile.value);
  if (!r.output.empty()) write_text_atomically(r.output, material_toml(result.material, "# " + command_line + "\n" + interval_comments(problem, result)));
  if (r.ensemble > 0) write_ensemble(r, problem, result);
  if (!r.plot.empty()) draw_by_python("calibrate", "plot_fit.py", {r.plot}, json.dump(), r.plot);
  if (r.json) return print_json(json);
  print_calibration(problem, result);
  if (flow)
    fmt::print("yield_stress is that at the strain rate of the impact, the one to simulate impacts with. The static flow stress at a\n"
               "plastic strain of about 4 % is {:.4g} Pa (95 %: {:.4g} to {:.4g}{})\n",
               flow->value, flow->low, flow->high, r.reference.empty() ? "; of steels. --reference narrows it" : "");
}

void define(Options& command)
{
  const auto r = std::make_shared<CalibrateRequest>();
  r->options.add_to(command, true);
  r->farm.add_to(command);
  command.add_option("--reference", r->reference,
                     "HL=VALUE,HB=VALUE: what the rebound tester reads on its own block, and the block's HBW 10/3000. Only the static\n"
                     "flow stress depends on it");
  command.add_option("--adhesion-range", r->adhesion_range, "m, with --fit work_of_adhesion: gap at which the attraction ends").check(above_zero_to(1e-3)).capture_default_str();
  command.add_option("-o,--output", r->output, "materials file, NAME.toml, that mpm table takes");
  command.add_option("--plot", r->plot, "picture of data, fit and its 95 % band: NAME.png, .pdf or .svg");
  command.add_option("--ensemble", r->ensemble, "so many materials drawn from what the data leave open: NAME-1.toml, ... beside -o NAME.toml")
      .check(whole_from_to(1, 10000));
  command.add_option("--seed", r->seed, "of the ensemble").capture_default_str();
  command.add_flag("--json", r->json,
      "print one JSON object instead of the summary: parameters.NAME.value, low68, high68, low95, high95 (Pa), identifiable, told; correlation; chi2, degrees_of_freedom, p_value; interval_scale: factor on chi^2 in the intervals; verdict; misfits; measurements with their fit");
  command.callback([r] { run(*r); });
}

}  // namespace of_calibrate

extern const Command calibrate_command{"calibrate",
    "Fits Young's modulus, yield stress and hardening to measurements, with intervals. It says which\n"
    "parameters the data do not determine (docs/guide/calibrate.md).\n"
    "Example: mpm calibrate drops.csv --radius 1e-3 --density 1540 --poisson-ratio 0.25 --youngs-modulus 3.2e9\n"
    "         --fit yield_stress -o material.toml --plot fit.png",
    of_calibrate::define};

}  // namespace granulaw
