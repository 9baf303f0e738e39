#include <fmt/format.h>

#include "base/scales.hpp"
#include "commands.hpp"
#include "law/law_file.hpp"

namespace granulaw::tool {

namespace {

void print_body(const std::string& name, const BodyLaw& body)
{
  const LawMaterial& m = body.material;
  const Certificate& c = body.certificate;
  fmt::print("\n{}\n", name);
  fmt::print("  density {:g} kg/m^3, E {:g} Pa, nu {:g}, ", m.density, m.youngs_modulus, m.poisson_ratio);
  if (m.yields()) {
    fmt::print("Y {:g} Pa, linear hardening {:g} Pa\n", m.yield_stress, m.hardening_modulus);
    fmt::print("  E*/Y {:.4g}; V_y {:.4g} m/s, true onset of yield {:.4g} m/s (rigid wall)\n", m.e_star() / m.yield_stress,
               yield_velocity(m.e_star(), m.yield_stress, m.density),
               onset_velocity(m.e_star(), m.yield_stress, m.density, m.poisson_ratio));
  } else {
    fmt::print("elastic\n");
  }
  fmt::print("  range: overlap up to {:.4g} lambda R*", body.curve.x_end());
  if (m.yields()) fmt::print("; rate-free up to I = rho V^2/Y = {:.2g} (V = {:.4g} m/s on a rigid wall)", c.max_inertia,
                             std::sqrt(c.max_inertia * m.yield_stress / m.density));
  fmt::print("\n  table: {} nodes, {} bytes; support of the presses: {}\n", body.curve.table().force_ratio.size(),
             body.curve.table().force_ratio.size() * 8 * sizeof(double), c.support);
  fmt::print("  solver error (two resolutions)      F {:.2g} %, e {:.2g} %\n", 100 * c.solver_error_force, 100 * c.solver_error_restitution);
  fmt::print("  against {} fresh impacts              F {:.2g} %, e {:.2g} %\n", c.verification_impacts, 100 * c.verification_error_force,
             100 * c.verification_error_restitution);
  fmt::print("  interpolation error                 {:.2g} %;  e at a depth left out {:.2g} %\n", 100 * c.interpolation_error, 100 * c.held_out_error);
  fmt::print("  scatter of the runs about the fit   {:.2g} %\n", 100 * c.residual_scatter);
  fmt::print("  reload loop left out                {:.2g} % of the loading work\n", 100 * c.reload_loop_area);
  if (m.yields()) fmt::print("  admissibility margin                {:.3f} (negative: a closed cycle could gain energy)\n", body.curve.admissibility_margin());
}

}  // namespace

void add_info(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("info", "Print what a law file holds: pairs, range, errors, provenance");
  auto path = std::make_shared<std::string>();
  command->add_option("law", *path, "law file")->required();
  command->callback([path] {
    const Law law = read_law(*path);
    fmt::print("{}\npairs: {}\n", *path, law.pair_list());
    for (const auto& [key, value] : law.provenance) fmt::print("{}: {}\n", key, value);
    fmt::print(
        "conventions: overlap on a rigid wall = way of the centre since first touch; J2 yield on the Cauchy stress;\n"
        "  pairs by F = lambda Y R*^2 Phi(d/(lambda R*)), sqrt(lambda) = 1 + E*_s/E*_h (rigid wall 1, like pair 4)\n");
    for (const auto& [name, body] : law.bodies) print_body(name, body);
  });
}

}  // namespace granulaw::tool
