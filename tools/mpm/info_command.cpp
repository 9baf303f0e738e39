// mpm info: contents of a law file.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>
#include <memory>

#include "base/error.hpp"
#include "characterise/body/law_material.hpp"
#include "collision_report.hpp"
#include "command.hpp"
#include "law/contact_law.hpp"
#include "law/law_file.hpp"
#include "law/pair_lines.hpp"
#include "own_files.hpp"
#include "shape_output.hpp"

namespace granulaw {

namespace of_info {

void print_material(const LawMaterial& m, const std::map<std::string, std::string>& provenance)
{
  fmt::print("  density              {:.6g} kg/m^3\n  Young's modulus      {:.6g} Pa\n  Poisson's ratio      {:.6g}\n", m.density, m.youngs_modulus, m.poisson_ratio);
  if (!m.yields()) return fmt::print("  elastic\n");
  fmt::print("  yield stress         {:.6g} Pa  (E*/Y = {:.4g})\n", m.yield_stress, m.e_star() / m.yield_stress);
  const auto own = provenance.find("hardening." + m.name), rate = provenance.find("rate." + m.name);
  if (own != provenance.end())
    fmt::print("  hardening            {}\n", own->second);
  else
    fmt::print("  linear hardening     {:.6g} Pa\n", m.hardening_modulus);
  if (rate != provenance.end()) fmt::print("  rate                 {}\n", rate->second);
}

/// The law's range along its velocity axis.
void print_axis(const AxisTable& t, const LawMaterial& m, const Certificate& c)
{
  if (t.by == AxisTable::By::inertia)
    fmt::print("  velocity axis         to I = rho V^2/Y = {:.3g}", t.speed_end * t.speed_end);
  else
    fmt::print("  rate axis            V = {:.3g} to {:.3g} m/s on a wall, for R = {:.4g} m only", t.speed_begin * speed_unit(m), t.speed_end * speed_unit(m),
        t.reference_radius);
  fmt::print(
      ", {} levels of {} nodes; without it force {:+.2g} %, e {:+.2g} % there\n", t.level.size(), t.shares(), 100 * c.axis_cost_force, 100 * c.axis_cost_restitution);
}

void print_origin(const Certificate& c)
{
  fmt::print("  origin               {}", printable(c.origin));
  if (c.origin != "atlas" && (c.atlas_error_force > 0 || c.atlas_error_restitution > 0))
    fmt::print(" (without speed from the atlas: {})", ErrorBound{c.atlas_error_force, c.atlas_error_restitution}.text());
  fmt::print("\n");
}

void print_errors(const BodyLaw& body)
{
  const Certificate& c = body.certificate;
  fmt::print("  error bound          {} (95 % of {})\n", bound_of(body).text(), body.shape ? "orientations" : "impacts");
  if (body.shape) fmt::print("  of spheres           {} (the same law, of a sphere)\n", body.bound.text());
  fmt::print("  solver error         force {}, e {} (of a computation, by two resolutions; included in the bound)\n", percent(c.solver_error_force),
      percent(c.solver_error_restitution));
  fmt::print("  interpolation error  {}", percent(c.interpolation_error));
  if (c.origin == "runs")
    fmt::print(";  held-out e {};  scatter of the runs {}\n  reload loop          {} of the loading work", percent(c.held_out_error), percent(c.residual_scatter),
        percent(c.reload_loop_area));
  fmt::print("\n");
  if (c.verification_impacts > 0)
    fmt::print("  against {:.0f} impacts    {}\n", c.verification_impacts, errors_text(c.verification_error_force, c.verification_error_restitution));
}

/// Why there is no single pair law at large overlaps: the same sphere between two platens, by the atlas.
void print_support(const BodyLaw& body)
{
  static const std::optional<Atlas> atlas = own_atlas();
  const MaterialRatios m = MaterialRatios::of(body.material);
  if (!body.is_sphere() || !body.material.flow.strain.empty() || !atlas || atlas->midplane().empty() || !atlas->why_not(m).empty()) return;
  const double x = std::min(body.curve.end(), MidplaneShapes::depth);
  fmt::print("  support matters      F free/F midplane {:.3g} at delta/R = {:.3g}\n", body.curve.force(x) / ContactLaw(atlas->midplane_shape(m)).force(x), x);
}

void print_body(const BodyLaw& body, const std::map<std::string, std::string>& provenance)
{
  const LawMaterial& m = body.material;
  const Certificate& c = body.certificate;
  fmt::print("material {}\n", m.name);
  if (!body.is_sphere())
    fmt::print("  body                 {}, radius of curvature {:.6g} m, mass {:.4g} rho 4/3 pi R^3: rigid wall and equal bodies only\n", body.body, body.pole_radius,
        body.mass_ratio);
  print_material(m, provenance);
  fmt::print("  range                delta/R = 0 to {:.4g}, {} nodes, onset of yield at {:.4g}\n", body.curve.end(), body.curve.table().force.size(), body.curve.onset());
  if (const AxisTable* axis = body.curve.axis()) print_axis(*axis, m, c);
  print_origin(c);
  print_errors(body);
  if (std::isfinite(c.damage_number_max)) fmt::print("  bound holds up to    I = rho V^2/Y = {:.3g}\n", c.damage_number_max);
  if (body.shape) {
    fmt::print("  shape                {}\n", printable(body.shape->shape.substr(0, 100)));
    print_shape("  orientations", *body.shape);
  }
  if (m.yields()) print_support(body);
}

void print_pair(const Law& law, const LawPair& pair)
{
  for (const PairLine& line : pair_lines(law, pair)) fmt::print("  pair {}:{}  {}\n", pair.a, pair.b, line.text());
}

void info(const std::string& path)
{
  const Law law = read_law(path);
  fmt::print("{}: contact law, pairs {}\n", path, law.pair_list());
  for (const auto& [name, text] : law.provenance) fmt::print("  {} = {}\n", printable(name), printable(text));
  if (!law.provenance.contains(checksum_note)) fmt::print("  checksum = none\n");
  for (const LawPair& pair : law.pairs) print_pair(law, pair);
  for (const auto& entry : law.bodies) print_body(entry.second, law.provenance);
  for (const auto& [name, laws] : law.pair_laws)
    for (const TwoBodyLaw& own : laws) {
      if (own.law.certificate.origin == composed_origin) continue;  // its errors are the pair's
      fmt::print("pair {}, its two-body law; yielding ", name);
      print_body(own.law, law.provenance);
    }
}

void define(Options& command)
{
  const auto path = std::make_shared<std::string>();
  command.add_option("LAW", *path, "law file of mpm table").required();
  command.callback([path] { info(*path); });
}

}  // namespace of_info

extern const Command info_command{"info", "Contents of a law file: materials, pairs, errors, range, origin.\nExample: mpm info law.h5", of_info::define};

}  // namespace granulaw
