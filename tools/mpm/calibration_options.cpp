#include "calibration_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "calibrate/kind/kind.hpp"
#include "calibrate/leeb.hpp"
#include "calibrate/measurement_file.hpp"
#include "calibrate/noise.hpp"
#include "characterise/body/law_material.hpp"
#include "impact_body_options.hpp"
#include "material_file/materials_file.hpp"
#include "material_file/plausible.hpp"
#include "option_checks.hpp"
#include "solver/material/law_table.hpp"

namespace granulaw {

namespace {

std::string without_blanks(const std::string& word)
{
  const auto first = word.find_first_not_of(' ');
  return first == std::string::npos ? "" : word.substr(first, word.find_last_not_of(' ') - first + 1);
}

double number_or_nan(const std::string& word) { return number_in(without_blanks(word)).value_or(std::nan("")); }

std::vector<std::string> words_of_kinds()
{
  std::vector<std::string> words;
  for (const Kind* kind : kinds())
    if (kind->word) words.emplace_back(kind->word);
  return words;
}

/// "CSV files ...": each kind's header and help.
std::string data_help()
{
  std::string text = "CSV files, SI, one kind of measurement each";
  for (const Kind* kind : kinds()) {
    text += fmt::format(";\n{}", kind->header());
    if (kind->word) text += fmt::format(" (--kind {})", kind->word);
    text += fmt::format(": {}", kind->help);
  }
  return text + ";\npreload_N,pull_off_N: pull-off forces, with --fit work_of_adhesion;\nleeb_hardness: readings of a rebound tester on thick metal, with --leeb.\nEach with a further column NAME_sd where the standard deviation is known (docs/guide/calibrate.md)";
}

/// "youngs_modulus, ...; with --hardening voce: saturation_stress, strain; ..."
std::string fit_help()
{
  std::string text = "the wanted numbers: youngs_modulus, yield_stress, hardening_modulus; work_of_adhesion alone, of preload_N,pull_off_N";
  for (const std::string& law : fitted_hardening_laws()) {
    std::vector<std::string> names;
    for (const Parameter p : parameters_of(law))
      if (p != Parameter::hardening_modulus) names.push_back(name_of(p));
    if (!names.empty()) text += fmt::format("; with --hardening {}: {}", law, fmt::join(names, ", "));
  }
  return text;
}

/// "hardness/yield_stress": of the kinds that may have it.
std::string ratio_name(const Kind& kind) { return fmt::format("{}/{}", kind.y.quantity, name_of(Parameter::yield_stress)); }

std::string ratio_names()
{
  std::string all;
  for (const Kind* kind : kinds())
    if (kind->has_ratio_to_yield) all += ", or " + ratio_name(*kind);
  return all;
}

}  // namespace

NamedRange parse_named_range(const std::string& word, const std::string& option)
{
  const auto equals = word.find('=');
  const char* form = "'NAME = LOW..HIGH', SI, both over 0";
  if (equals == std::string::npos) fail(option, "cannot be understood", fmt::format("'{}'", cut(word)), form);
  return {without_blanks(word.substr(0, equals)), parse_range(word.substr(equals + 1), option, form)};
}

Range parse_range(const std::string& word, const std::string& option, const std::string& form)
{
  const auto dots = word.find("..");
  const std::string found = fmt::format("'{}'", cut(without_blanks(word)));
  if (dots == std::string::npos) fail(option, "cannot be understood", found, form);
  const Range r{number_or_nan(word.substr(0, dots)), number_or_nan(word.substr(dots + 2))};
  if (!(r.low > 0 && r.high > 0 && std::isfinite(r.low) && std::isfinite(r.high))) fail(option, "cannot be understood", found, form);
  if (!(r.high > r.low))
    fail(option, r.high < r.low ? "the range runs downwards" : "the range is empty", found, r.high < r.low ? fmt::format("'{:g}..{:g}'", r.high, r.low) : form);
  return r;
}

void CalibrationOptions::add_to(Options& command, bool needs_data)
{
  Option files = command.add_option("DATA", data, data_help());
  if (needs_data) files.required();
  command.add_option("--fit", fit, fit_help()).required().list();
  command.add_option("--hardening", hardening, "law: linear, from the atlas; with any other some laws are made by the solver")
      .among(fitted_hardening_laws())
      .capture_default_str();
  command.add_option("--known", known, "NAME=VALUE, SI, of a parameter of --hardening that is not fitted");
  command.add_option("--radius", radius, "of the sphere, m; inf: a thick flat specimen under a spherical indenter. With --leeb the device has it")
      .check(above_zero_to(std::numeric_limits<double>::infinity()));
  command.add_option("--density", density, "kg/m^3; force curves do without").check(above_zero());
  command.add_option("--poisson-ratio", poisson_ratio).check(from_to(0, 0.49)).capture_default_str();
  command.add_option("--youngs-modulus", youngs_modulus, "Pa, where it is known and not fitted").check(above_zero());
  command.add_option("--yield-stress", yield_stress, "Pa, where it is known and not fitted").check(above_zero());
  command.add_option("--hardening-modulus", hardening_modulus, "Pa, where it is known and not fitted (default 0: perfectly plastic)");
  std::vector<std::string> words = words_of_kinds();
  words.emplace_back("leeb");
  command.add_option("--kind", kind, "of force curves, whose columns are the same: see DATA; leeb: readings of a rebound tester").among(words).capture_default_str();
  command.add_option("--indenter-radius", indenter_radius, "m, with --kind sphere").check(above_zero_to(1e3));
  command.add_option("--partner", partner, "of impacts. wall: rigid; equal: a sphere of the same material and size, the speed is that of approach (older word: like)")
      .among({"wall", "equal", "like"})
      .capture_default_str();
  Option materials_file = command.add_option("--materials-file,--materials", materials, "TOML file that holds the material of the wall, the indenter or the ball");
  command.add_option("--indenter", indenter, "name of the indenter's material (default: rigid)").needs(materials_file);
  command.add_option("--wall", wall, "restitution: name of the material of a thick deformable wall (default: rigid)").needs(materials_file);
  command
      .add_option(
          "--ball", ball, "restitution: name of the known material of the ball that drops. --radius is the ball's; all else, and the fit, belong to the thick specimen")
      .needs(materials_file);
  command.add_option("--leeb", leeb, "impact device of leeb_hardness: D, DC, D+15, S, E, C or G, downwards on thick metal. Sets ball, mass and speed");
  define_impact_body(command, body, "the sphere or ball");
  command.add_option("--offset", offset, "m, displacement at first touch, where it is known (default: it is fitted, for each curve)");
  command.add_flag("--compliance", compliance, "fit the machine's compliance, m/N, for each curve");
  command
      .add_option(
          "--relative-sd", relative_sd, "standard deviation of values whose file states none, as a fraction of the value; a curve's is taken from its own scatter")
      .check(above_zero_to(1))
      .capture_default_str();
  command.add_option("--prior", priors, "'NAME = LOW..HIGH': known before, 95 % lie between; NAME as in --fit" + ratio_names());
  command.add_option("--bounds", bounds, "'NAME = LOW..HIGH': never outside");
  command.add_flag("--no-robust", plain, "outliers count by their square, as all other values");
  command.add_option("--name", name, "of the material in what is written").capture_default_str();
}

namespace {

/// The material of a wall, an indenter or a ball.
LawMaterial material_of_other(const std::string& path, const std::string& name, const char* option)
{
  const MaterialsFile file = read_materials(path);
  const Material& m = file.material(name);
  if (!m.hardening.name.empty() || m.rate_dependent() || !m.yield_surface.name.empty())
    fail(option, "this material must yield by von Mises, harden linearly or not at all, and without a rate law", name);
  return law_material(name, m);
}

}  // namespace

/// The hardening law, and its parameters that are known.
void CalibrationOptions::set_hardening(CalibrationRequest& r) const
{
  if (hardening == flow::Linear::name) {
    if (!known.empty()) fail("--known", "belongs to --hardening voce, swift or johnson-cook");
    return;
  }
  if (hardening_modulus) fail("--hardening-modulus", "belongs to linear hardening", hardening);
  r.known.hardening.name = hardening;
  for (const std::string& word : known) {
    const auto equals = word.find('=');
    const double value = equals == std::string::npos ? -1 : number_or_nan(word.substr(equals + 1));
    require(value > 0, "--known", fmt::format("'{}'", cut(word)), "NAME=VALUE, SI, over 0");
    const Parameter p = parameter_named(without_blanks(word.substr(0, equals)), "--known");
    const std::vector<Parameter> own = parameters_of(hardening);
    if (std::find(own.begin(), own.end(), p) == own.end()) fail("--known", fmt::format("'{}' is no parameter of the hardening law '{}'", name_of(p), hardening));
    set_value(r.known, p, value);
  }
}

const Kind& CalibrationOptions::curves() const
{
  if (kind == "leeb") return kind_named("platens", "--kind");
  return **std::find_if(kinds().begin(), kinds().end(), [&](const Kind* k) { return k->word && k->word == kind; });
}

Measurement CalibrationOptions::form(const Kind& of, const std::string& source, bool device_has_radius) const
{
  Measurement m;
  m.kind = &of;
  m.source = source;
  if (of.needs_density && !density) fail("--density", "is missing: impacts depend on it");
  if (!radius && !device_has_radius) fail("--radius", "is missing");
  m.radius = radius.value_or(std::numeric_limits<double>::infinity());
  m.body = body;
  m.partner = partner != "wall" ? ImpactPartner::like_sphere : ImpactPartner::wall;
  m.fit_offset = of.has_machine && !offset, m.fit_compliance = of.has_machine && compliance;
  if (of.counterpart == Kind::Counterpart::indenter) {
    if (!indenter_radius) fail("--indenter-radius", "is missing: --kind sphere needs it");
    m.indenter_radius = *indenter_radius;
    if (!indenter.empty()) m.counterpart = material_of_other(materials, indenter, "--indenter");
  }
  if (of.needs_density && !(wall.empty() && ball.empty())) {
    if (!wall.empty() && !ball.empty()) fail("--ball", "is given beside --wall: the one or the other is known");
    m.counterpart_is_ball = !ball.empty();
    const char* option = m.counterpart_is_ball ? "--ball" : "--wall";
    m.counterpart = material_of_other(materials, m.counterpart_is_ball ? ball : wall, option);
    if (of.counterpart != Kind::Counterpart::wall || m.partner != ImpactPartner::wall) fail(source, fmt::format("only restitution of drops goes with {}", option));
  }
  return m;
}

namespace {

void check_body(const Measurement& m, const std::string& path)
{
  if (m.body.mass == 0 && m.body.compliance == 0) return;
  if (!m.kind->needs_density || m.partner != ImpactPartner::wall) fail(path, "no impact body hits here: --impact-body-mass and -compliance are of drops");
  if (m.body.compliance > 0 && !m.counterpart)
    fail("--impact-body-compliance", "needs the material of both: --ball or --wall; on a rigid wall give the speed and e of the contact alone");
}

}  // namespace

Measurement CalibrationOptions::measurement(const std::string& path) const
{
  Measurement read = read_measurement(path, curves());
  if (kind == "leeb" && !read.is_leeb) fail(path, "holds no readings of a rebound tester", read.kind->header(), "leeb_hardness");
  if (read.is_leeb && leeb.empty()) fail("--leeb", "is missing: the device has the ball, the mass and the speed of the readings");
  if (read.is_leeb && !(ball.empty() && wall.empty())) fail("--leeb", "the device has its own ball, and the thick metal is what is fitted");
  Measurement m = form(*read.kind, path, read.is_leeb);
  m.data = std::move(read.data), m.is_leeb = read.is_leeb;
  if (m.is_leeb) make_drops(m, leeb_device(leeb, "--leeb"), body.compliance);
  check_body(m, path);
  if (m.kind->has_machine && offset)
    for (Datum& d : m.data) d.x -= *offset;
  complete_standard_deviations(m, relative_sd);
  return m;
}

/// Priors and bounds, and the ratio of a value to the yield stress.
void CalibrationOptions::set_ranges(CalibrationRequest& r) const
{
  for (const std::string& word : priors) {
    const NamedRange prior = parse_named_range(word, "--prior");
    const auto with_ratio = std::find_if(kinds().begin(), kinds().end(), [&](const Kind* k) { return k->has_ratio_to_yield && prior.name == ratio_name(*k); });
    if (with_ratio == kinds().end()) {
      r.priors.push_back({parameter_named(prior.name, "--prior"), prior.range});
      continue;
    }
    for (Measurement& m : r.measurements)
      if (m.kind == *with_ratio) m.ratio_to_yield = {prior.range.low, prior.range.high};
  }
  for (const std::string& word : bounds) {
    const NamedRange bound = parse_named_range(word, "--bounds");
    r.bounds.push_back({parameter_named(bound.name, "--bounds"), bound.range});
  }
}

void CalibrationOptions::check_plausible_numbers(const CalibrationRequest& r) const
{
  if (radius) check_plausible("--radius", "radius", "radius", *radius);
  if (density) check_plausible("--density", "density", "density", *density);
  if (youngs_modulus) check_plausible("--youngs-modulus", "youngs_modulus", "youngs_modulus", *youngs_modulus);
  if (yield_stress) check_plausible("--yield-stress", "yield_stress", "yield_stress", *yield_stress);
  // one line for a file: of its fastest impact, or its softest value
  for (const Measurement& m : r.measurements) {
    const auto check = [&](const Column& column, double Datum::*value, double sign) {
      if (!is_usual_quantity(column.quantity)) return;
      const Datum& d = *std::max_element(m.data.begin(), m.data.end(), [=](const Datum& a, const Datum& b) { return sign * a.*value < sign * b.*value; });
      check_plausible(fmt::format("{}:{}", m.source, d.line), column.quantity, column.name(), d.*value);
    };
    check(m.kind->x, &Datum::x, 1), check(m.kind->y, &Datum::y, -1);
  }
}

CalibrationRequest CalibrationOptions::request() const
{
  CalibrationRequest r;
  r.robust = !plain;
  for (const std::string& word : fit) r.fit.push_back(parameter_named(word, "--fit"));
  for (std::size_t a = 0; a < r.fit.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (r.fit[a] == r.fit[b]) fail("--fit", fmt::format("'{}' is named twice", fit[a]));
  r.known.name = name;
  r.known.poisson_ratio = poisson_ratio;
  r.known.youngs_modulus = youngs_modulus.value_or(0);
  r.known.yield_stress = yield_stress.value_or(0);
  r.known.hardening_modulus = hardening_modulus.value_or(0);
  require(r.known.hardening_modulus >= 0, "--hardening-modulus", fmt::format("{:g}", r.known.hardening_modulus), "0 or more");
  set_hardening(r);
  for (const Parameter p : r.fit)
    if (value_of(r.known, p) > 0) fail("--fit", fmt::format("'{}' is given, too: either it is known or it is fitted", name_of(p)));
  for (const auto& [parameter, option] : {std::pair{Parameter::youngs_modulus, "--youngs-modulus"}, {Parameter::yield_stress, "--yield-stress"}})
    if (std::find(r.fit.begin(), r.fit.end(), parameter) == r.fit.end() && !(value_of(r.known, parameter) > 0))
      fail(option, fmt::format("is missing: give it, or add {} to --fit", name_of(parameter)));
  for (const std::string& path : data) r.measurements.push_back(measurement(path));
  if (!leeb.empty() && std::none_of(r.measurements.begin(), r.measurements.end(), [](const Measurement& m) { return m.is_leeb; }))
    fail("--leeb", "goes with leeb_hardness, which no file holds");
  set_ranges(r);
  check_plausible_numbers(r);
  r.known.density = density.value_or(1000);  // no curve of force depends on it
  return r;
}

}  // namespace granulaw
