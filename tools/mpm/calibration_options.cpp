#include "calibration_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "calibrate/measurement_file.hpp"
#include "calibrate/noise.hpp"
#include "characterise/law_material.hpp"
#include "materials_file.hpp"
#include "option_checks.hpp"
#include "plausible.hpp"

namespace granulaw {

namespace {

constexpr const char* hardness_ratio = "hardness/yield_stress";

std::string without_blanks(const std::string& word)
{
  const auto first = word.find_first_not_of(' ');
  return first == std::string::npos ? "" : word.substr(first, word.find_last_not_of(' ') - first + 1);
}

double number_or_nan(const std::string& word)
{
  return number_in(without_blanks(word));
}

/// A range of a parameter; `what` is allowed besides.
std::vector<ParameterRange> ranges_of(const std::vector<std::string>& words, const char* option,
                                      std::optional<Range>* hardness)
{
  std::vector<ParameterRange> found;
  for (const std::string& word : words) {
    const NamedRange r = parse_named_range(word, option);
    if (hardness && r.name == hardness_ratio)
      *hardness = r.range;
    else
      found.push_back({parameter_named(r.name, option), r.range});
  }
  return found;
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
  if (!(r.low > 0 && r.high > 0 && std::isfinite(r.low) && std::isfinite(r.high)))
    fail(option, "cannot be understood", found, form);
  if (!(r.high > r.low))
    fail(option, r.high < r.low ? "the range runs downwards" : "the range is empty", found,
         r.high < r.low ? fmt::format("'{:g}..{:g}'", r.high, r.low) : form);
  return r;
}

void CalibrationOptions::add_to(CLI::App& command, bool needs_data)
{
  CLI::Option* files = command.add_option(
      "DATA", data,
      "CSV files, SI, one kind of measurement each: velocity_m_per_s with restitution, contact_radius_m,\n"
      "residual_displacement_m or contact_time_s; displacement_m,force_N; hardness_Pa; onset_force_N; each "
      "with a\n"
      "further column NAME_sd where the standard deviation is known (docs/guide/calibrate.md)");
  if (needs_data) files->required();
  command
      .add_option("--fit", fit,
                  "what is wanted: youngs_modulus, yield_stress, hardening_modulus; with --hardening voce: "
                  "saturation_stress, strain; swift: exponent, offset; johnson-cook: strength, exponent")
      ->required();
  command
      .add_option(
          "--hardening", hardening,
          "law: linear (from the atlas), voce, swift or johnson-cook (some laws are made by the solver)")
      ->check(CLI::IsMember(fitted_hardening_laws()))
      ->capture_default_str();
  command.add_option("--known", known, "NAME=VALUE, SI, of a parameter of --hardening that is not fitted");
  command
      .add_option("--radius", radius,
                  "of the sphere, m; inf: a thick flat specimen under a spherical indenter")
      ->required()
      ->check(above_zero_to(std::numeric_limits<double>::infinity()));
  command.add_option("--density", density, "kg/m^3; force curves do without")->check(above_zero());
  command.add_option("--poisson-ratio", poisson_ratio)->check(from_to(0, 0.49))->capture_default_str();
  command.add_option("--youngs-modulus", youngs_modulus, "Pa, where it is known and not fitted")
      ->check(above_zero());
  command.add_option("--yield-stress", yield_stress, "Pa, where it is known and not fitted")
      ->check(above_zero());
  command.add_option("--hardening-modulus", hardening_modulus,
                     "Pa, where it is known and not fitted (default 0: perfectly plastic)");
  command
      .add_option(
          "--kind", kind,
          "of force curves. platens: a sphere between two plates, displacement of one towards the "
          "other; flat: one contact, displacement of the sphere's middle; sphere: a spherical indenter, "
          "its displacement towards the specimen's middle")
      ->check(CLI::IsMember({"platens", "flat", "sphere"}))
      ->capture_default_str();
  command.add_option("--indenter-radius", indenter_radius, "m, with --kind sphere")
      ->check(above_zero_to(1e3));
  command
      .add_option(
          "--partner", partner,
          "of impacts. wall: rigid; like: a sphere of the same material and size, the speed is that of "
          "approach")
      ->check(CLI::IsMember({"wall", "like"}))
      ->capture_default_str();
  CLI::Option* materials_file = command.add_option(
      "--materials", materials, "TOML file that holds the material of the wall, the indenter or the ball");
  command.add_option("--indenter", indenter, "name of the indenter's material (default: rigid)")
      ->needs(materials_file);
  command
      .add_option("--wall", wall,
                  "restitution: name of the material of a thick deformable wall (default: rigid)")
      ->needs(materials_file);
  command
      .add_option("--ball", ball,
                  "restitution: name of the material of the ball that drops, which is known; --radius is its "
                  "own, all else, and what is fitted, of the thick specimen that it drops on")
      ->needs(materials_file);
  command.add_option(
      "--offset", offset,
      "m, displacement at first touch, where it is known (default: it is fitted, for each curve)");
  command.add_flag("--compliance", compliance, "fit the machine's compliance, m/N, for each curve");
  command
      .add_option(
          "--relative-sd", relative_sd,
          "standard deviation of values whose file states none, as a share of the value; a curve's is "
          "taken from its own scatter")
      ->check(above_zero_to(1))
      ->capture_default_str();
  command.add_option(
      "--prior", priors,
      "'NAME = LOW..HIGH': known before, 95 % lie between; NAME as in --fit, or hardness/yield_stress");
  command.add_option("--bounds", bounds, "'NAME = LOW..HIGH': never outside");
  command.add_flag("--no-robust", plain, "outliers count by their square, as all other values");
  command.add_option("--name", name, "of the material in what is written")->capture_default_str();
}

namespace {

/// The material of a wall or an indenter.
LawMaterial partner_material(const std::string& path, const std::string& name, const char* option)
{
  const MaterialsFile file = read_materials(path);
  const Material& m = file.material(name);
  if (!m.hardening.name.empty() || m.rate_dependent() || !m.yield_surface.name.empty())
    fail(option, "this material must yield by von Mises, harden linearly or not at all, and without a rate law",
         name);
  return law_material(name, m);
}

}  // namespace

/// Puts the wall, or the ball, to all drops.
void CalibrationOptions::set_partner(CalibrationRequest& r) const
{
  if (!wall.empty() && !ball.empty()) fail("--ball", "is given beside --wall: the one or the other is known");
  const bool of_ball = !ball.empty();
  const char* option = of_ball ? "--ball" : "--wall";
  const LawMaterial material = partner_material(materials, of_ball ? ball : wall, option);
  for (Measurement& measurement : r.measurements) {
    if (!is_impact(measurement.kind)) continue;
    if (measurement.kind != MeasurementKind::restitution || measurement.partner != ImpactPartner::rigid_wall)
      fail(measurement.source, fmt::format("only restitution of drops goes with {}", option));
    (of_ball ? measurement.ball : measurement.wall) = material;
  }
}

/// The hardening law, and its parameters that are known.
void CalibrationOptions::set_hardening(CalibrationRequest& r) const
{
  if (hardening == "linear") {
    if (!known.empty()) fail("--known", "belongs to --hardening voce, swift or johnson-cook");
    return;
  }
  if (hardening_modulus) fail("--hardening-modulus", "belongs to linear hardening", hardening);
  r.known.hardening = hardening;
  for (const std::string& word : known) {
    const auto equals = word.find('=');
    const double value = equals == std::string::npos ? -1 : number_or_nan(word.substr(equals + 1));
    require(value > 0, "--known", fmt::format("'{}'", cut(word)), "NAME=VALUE, SI, over 0");
    const Parameter p = parameter_named(without_blanks(word.substr(0, equals)), "--known");
    const std::vector<Parameter> own = parameters_of(hardening);
    if (std::find(own.begin(), own.end(), p) == own.end())
      fail("--known", fmt::format("'{}' is no parameter of the hardening law '{}'", name_of(p), hardening));
    set_value(r.known, p, value);
  }
}

void CalibrationOptions::set_indenter(Measurement& m) const
{
  if (!indenter_radius) fail("--indenter-radius", "is missing: --kind sphere needs it");
  m.indenter_radius = *indenter_radius;
  if (!indenter.empty()) m.indenter = partner_material(materials, indenter, "--indenter");
}

Measurement CalibrationOptions::measurement(const std::string& path) const
{
  const MeasurementKind curves = kind == "flat"     ? MeasurementKind::flat
                                 : kind == "sphere" ? MeasurementKind::indenter
                                                    : MeasurementKind::platens;
  Measurement m = read_measurement(path, curves);
  if (is_impact(m.kind) && !density) fail("--density", "is missing: impacts depend on it");
  m.radius = *radius;
  m.partner = partner == "like" ? ImpactPartner::like_sphere : ImpactPartner::rigid_wall;
  if (m.kind == MeasurementKind::indenter) set_indenter(m);
  if (is_curve(m.kind)) {
    m.fit_offset = !offset, m.fit_compliance = compliance;
    if (offset)
      for (Datum& d : m.data) d.x -= *offset;
  }
  complete_standard_deviations(m, relative_sd);
  return m;
}

void CalibrationOptions::check_plausible_numbers(const CalibrationRequest& r) const
{
  check_plausible("--radius", "radius", "radius", *radius);
  if (density) check_plausible("--density", "density", "density", *density);
  if (youngs_modulus)
    check_plausible("--youngs-modulus", "youngs_modulus", "youngs_modulus", *youngs_modulus);
  if (yield_stress) check_plausible("--yield-stress", "yield_stress", "yield_stress", *yield_stress);
  for (const Measurement& m : r.measurements) {
    const bool impacts = is_impact(m.kind);
    if (!impacts && m.kind != MeasurementKind::hardness) continue;
    // one line for a file: of its fastest impact, or its softest value
    const Datum& d = *std::max_element(m.data.begin(), m.data.end(), [&](const Datum& a, const Datum& b) {
      return impacts ? a.x < b.x : a.y > b.y;
    });
    const std::string where = fmt::format("{}:{}", m.source, d.line);
    if (impacts)
      check_plausible(where, "velocity", "velocity_m_per_s", d.x);
    else
      check_plausible(where, "hardness", "hardness_Pa", d.y);
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
  require(r.known.hardening_modulus >= 0, "--hardening-modulus",
          fmt::format("{:g}", r.known.hardening_modulus), "0 or more");
  set_hardening(r);
  for (const Parameter p : r.fit)
    if (value_of(r.known, p) > 0)
      fail("--fit", fmt::format("'{}' is given, too: either it is known or it is fitted", name_of(p)));
  for (const auto& [parameter, option] : {std::pair{Parameter::youngs_modulus, "--youngs-modulus"},
                                          {Parameter::yield_stress, "--yield-stress"}})
    if (std::find(r.fit.begin(), r.fit.end(), parameter) == r.fit.end() &&
        !(value_of(r.known, parameter) > 0))
      fail(option, fmt::format("is missing: give it, or add {} to --fit", name_of(parameter)));
  r.priors = ranges_of(priors, "--prior", &r.hardness_ratio);
  r.bounds = ranges_of(bounds, "--bounds", nullptr);
  for (const std::string& path : data) r.measurements.push_back(measurement(path));
  if (!wall.empty() || !ball.empty()) set_partner(r);
  check_plausible_numbers(r);
  r.known.density = density.value_or(1000);  // no curve of force depends on it
  return r;
}

}  // namespace granulaw
