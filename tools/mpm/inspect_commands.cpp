// mpm info, mpm plot: what a law file says about itself.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <memory>

#include "atlas_path.hpp"
#include "base/error.hpp"
#include "characterise/build_law.hpp"
#include "commands.hpp"
#include "law/law_file.hpp"
#include "trace_file.hpp"

namespace granulaw {

namespace {

void print_body(const BodyLaw& body, const std::map<std::string, std::string>& provenance)
{
  const LawMaterial& m = body.material;
  const Certificate& c = body.certificate;
  fmt::print("material {}\n", m.name);
  if (!body.is_sphere())
    fmt::print(
        "  body                 {}, radius of curvature {:.6g} m, mass {:.4g} rho 4/3 pi R^3: rigid wall and "
        "like "
        "pair only\n",
        body.body, body.pole_radius, body.mass_ratio);
  fmt::print(
      "  density              {:.6g} kg/m^3\n  Young's modulus      {:.6g} Pa\n  Poisson's ratio      "
      "{:.6g}\n",
      m.density, m.youngs_modulus, m.poisson_ratio);
  if (m.yields()) {
    fmt::print("  yield stress         {:.6g} Pa  (E*/Y = {:.4g})\n", m.yield_stress,
               m.e_star() / m.yield_stress);
    const auto own = provenance.find("hardening." + m.name), rate = provenance.find("rate." + m.name);
    if (own != provenance.end())
      fmt::print("  hardening            {}\n", own->second);
    else
      fmt::print("  linear hardening     {:.6g} Pa\n", m.hardening_modulus);
    if (rate != provenance.end()) fmt::print("  rate                 {}\n", rate->second);
  } else
    fmt::print("  elastic\n");
  fmt::print("  range                delta/R = 0 to {:.4g}, {} nodes, onset of yield at {:.4g}\n",
             body.curve.x_end(), body.curve.table().force_ratio.size(), body.curve.onset());
  if (const VelocityAxis* axis = body.curve.axis()) {
    const VelocityAxis::Table& t = axis->table();
    if (axis->kind() == VelocityAxis::Kind::inertia)
      fmt::print("  velocity axis         to I = rho V^2/Y = {:.3g}", t.speed_end * t.speed_end);
    else
      fmt::print("  rate axis            V = {:.3g} to {:.3g} m/s on a wall, for R = {:.4g} m only",
                 t.speed_begin * std::sqrt(m.yield_stress / m.density),
                 t.speed_end * std::sqrt(m.yield_stress / m.density), t.reference_radius);
    fmt::print(", {} levels of {} nodes; without it force {:+.2g} %, e {:+.2g} % there\n", t.levels,
               t.ratio_nodes(), 100 * c.axis_cost_force, 100 * c.axis_cost_restitution);
  }
  fmt::print("  origin               {}", printable(c.origin));
  if (c.atlas_error_force > 0 || c.atlas_error_restitution > 0)
    fmt::print(" ({}force within {:.2g} %, e within {:.2g})",
               c.origin == "atlas" ? "" : "at no rate the atlas: ", 100 * c.atlas_error_force,
               c.atlas_error_restitution);
  fmt::print("\n  support              {}\n", printable(c.support));
  fmt::print("  solver error         force {:.2g} %, e {:.2g} % (two resolutions)\n",
             100 * c.solver_error_force, 100 * c.solver_error_restitution);
  fmt::print("  interpolation error  {:.2g} %", 100 * c.interpolation_error);
  if (c.origin == "runs")
    fmt::print(
        ";  held-out e {:.2g} %;  scatter of the runs {:.2g} %\n  reload loop          {:.2g} % of the "
        "loading work",
        100 * c.held_out_error, 100 * c.residual_scatter, 100 * c.reload_loop_area);
  fmt::print("\n");
  if (c.verification_impacts > 0)
    fmt::print("  against {:.0f} impacts    force within {:.2g} %, e within {:.2g} %\n",
               c.verification_impacts, 100 * c.verification_error_force,
               100 * c.verification_error_restitution);
  if (c.slow_press_force != 0 || c.slow_press_restitution != 0)
    fmt::print("  slow press instead   force {:+.2g} %, e {:+.2g} % at the deepest impact's overlap\n",
               100 * c.slow_press_force, 100 * c.slow_press_restitution);
  if (std::isfinite(c.damage_number_max))
    fmt::print("  holds up to          I = rho V^2/Y = {:.3g}\n", c.damage_number_max);
  if (m.yields())
    fmt::print("  support matters      F free/F midplane about {:.3g} at its largest overlap (E*/Y = 100)\n",
               support_ratio(body.curve.x_end()));
}

void info(const std::string& path)
{
  const Law law = read_law(path);
  fmt::print("{}: contact law, pairs {}\n", path, law.pair_list());
  for (const auto& [name, text] : law.provenance) fmt::print("  {} = {}\n", printable(name), printable(text));
  for (const LawPair& pair : law.pairs) {
    const TwoBodyLaw* own = law.find_pair_law(pair.a, pair.b);
    if (own)
      fmt::print("  pair {}:{} by its own law, made at radii 1:{:.4g} (yielding body : partner)\n", pair.a,
                 pair.b, own->radius_ratio);
    if (pair.reduction_error_force > 0 || pair.reduction_error_restitution > 0)
      fmt::print("  pair {}:{} {}: force within {:.2g} %, e within {:.2g} %\n", pair.a, pair.b,
                 own ? "at other radii" : "by the pair rule", 100 * pair.reduction_error_force,
                 100 * pair.reduction_error_restitution);
  }
  for (const auto& entry : law.bodies) print_body(entry.second, law.provenance);
  for (const auto& [name, own] : law.pair_laws) {
    fmt::print("pair {}, its own law; yielding ", name);
    print_body(own.law, law.provenance);
  }
}

void plot(const std::string& law, const std::string& output)
{
  check_output(output, ".png, .pdf, .svg");
  read_law(law);  // its sentence is better than Python's
  const std::string script = own_file("plot_law.py");
  if (script.empty()) fail("mpm plot", "plot_law.py is not beside the program");
  int complaints[2];
  if (pipe(complaints) != 0) fail("mpm plot", "cannot make a pipe");
  const pid_t child = fork();
  if (child < 0) fail("mpm plot", "cannot start /usr/bin/python3");
  if (child == 0) {
    dup2(complaints[1], STDERR_FILENO);
    close(complaints[0]);
    close(complaints[1]);
    // its whole path as its name: by "python3" alone Python looks for its modules beside the PATH's first one
    execl("/usr/bin/python3", "/usr/bin/python3", script.c_str(), law.c_str(), output.c_str(),
          static_cast<char*>(nullptr));
    _exit(127);
  }
  close(complaints[1]);
  std::string said;
  char part[4096];
  for (ssize_t length; (length = read(complaints[0], part, sizeof part)) > 0;)
    said.append(part, static_cast<std::size_t>(length));
  close(complaints[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127)
    fail("mpm plot", "/usr/bin/python3 is missing (Debian: python3-matplotlib, python3-h5py)");
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    while (said.ends_with('\n')) said.pop_back();  // a traceback's last line says what went wrong
    fail(output, "cannot be drawn", said.substr(said.rfind('\n') + 1));
  }
  fmt::print("wrote {}\n", output);
}

}  // namespace

void add_info(CLI::App& app)
{
  const auto path = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(
      "info", "What a law holds: materials, pairs, errors, range, origin.\nExample: mpm info law.h5");
  command->add_option("LAW", *path, "law file of mpm table")->required();
  command->callback([path] { info(*path); });
}

void add_plot(CLI::App& app)
{
  struct Request
  {
    std::string law, output;
  };
  const auto r = std::make_shared<Request>();
  CLI::App* command = app.add_subcommand(
      "plot",
      "Draws a law: force against overlap with its unloading branches, and e against velocity beside\n"
      "Thornton's closed form. Example: mpm plot law.h5 -o law.png");
  command->add_option("LAW", r->law, "law file of mpm table")->required();
  command->add_option("-o,--output", r->output, "picture, NAME.png, .pdf or .svg")->required();
  command->callback([r] { plot(r->law, r->output); });
}

}  // namespace granulaw
