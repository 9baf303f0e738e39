#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ctime>
#include <nlohmann/json.hpp>
#include <tuple>

#include "base/error.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "law/law_file.hpp"
#include "law/replay.hpp"

namespace granulaw::tool {

namespace {

/// Overlap past the table's end, relative to it, that a replay accepts before it refuses.
constexpr double range_margin = 0.05;

struct Arguments
{
  std::string law, pair;
  double radius = 1e-3, radius2 = 0, velocity = 0;
  bool json = false;
};

double sphere_mass(const LawMaterial& m, double radius) { return 4.0 / 3.0 * M_PI * radius * radius * radius * m.density; }

void replay(const Arguments& a)
{
  const auto positive = [](const char* option, double value, const char* unit) {
    if (!(value > 0)) fail(option, "cannot be used", fmt::format("{:g}", value), fmt::format("over 0 ({})", unit));
  };
  positive("--velocity", a.velocity, "m/s");
  positive("--radius", a.radius, "m");
  const double radius2 = a.radius2 != 0 ? a.radius2 : a.radius;
  positive("--radius2", radius2, "m");
  const Law law = read_law(a.law);
  std::string first, second;
  if (a.pair.empty()) {
    if (law.pairs.size() != 1) fail("--pair", fmt::format("'{}' holds several pairs; name one", a.law), {}, law.pair_list());
    std::tie(first, second) = law.pairs.front();
  } else {
    const std::size_t colon = a.pair.find(':');
    if (colon == std::string::npos) fail("--pair", "is not two names", a.pair, law.pair_list());
    first = a.pair.substr(0, colon), second = a.pair.substr(colon + 1);
    if (first == wall_name) std::swap(first, second);
  }
  const PairLaw pair = resolve_pair(law, first, second, a.law);
  const double mass_first = sphere_mass(law.bodies.at(first).material, a.radius);
  const bool wall = second == wall_name;
  const double r_eff = wall ? a.radius : effective_radius(a.radius, radius2);
  const double mass = wall ? mass_first : effective_mass(mass_first, sphere_mass(law.bodies.at(second).material, radius2));

  const std::clock_t start = std::clock();
  const Replay r = replay_collision(pair, r_eff, mass, a.velocity);
  const double cpu = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  if (r.delta_max > (1 + range_margin) * pair.max_overlap(r_eff))
    fail(a.law, "the collision leaves the range of the table", fmt::format("overlap {:.3g} m", r.delta_max),
         fmt::format("up to {:.3g} m; build the law with a greater --depth", pair.max_overlap(r_eff)));

  // The yielding body sees a rigid plane at 1/sqrt(lambda) of the approach speed (like pair: half).
  const LawMaterial& m = pair.yielding->material;
  const Certificate& c = pair.yielding->certificate;
  const double v = a.velocity / pair.mapping.sqrt_lambda;
  const double inertia = m.yields() ? m.density * v * v / m.yield_stress : 0;
  const bool needs_axis = inertia > c.max_inertia;
  const double error = std::max({c.verification_error_force, c.verification_error_restitution, c.solver_error_force,
                                 c.solver_error_restitution});
  if (a.json) {
    const nlohmann::ordered_json out = {{"e", r.restitution},
                                        {"force_max_N", r.force_max},
                                        {"delta_max_m", r.delta_max},
                                        {"delta_residual_m", r.delta_residual},
                                        {"contact_time_s", r.contact_time},
                                        {"work_load_J", r.work_load},
                                        {"work_unload_J", r.work_unload},
                                        {"points", 0},
                                        {"steps", r.samples.size() - 1},
                                        {"cpu_s", cpu},
                                        {"point_updates_per_s", 0},
                                        {"error_estimate", error},
                                        {"inertia", inertia},
                                        {"needs_velocity_axis", needs_axis},
                                        {"left_range", r.left_range}};
    fmt::print("{}\n", out.dump());
  } else {
    fmt::print("{}:{} at {:g} m/s, radius {:g} m{}\n", first, second, a.velocity, a.radius, wall ? "" : fmt::format(" and {:g} m", radius2));
    fmt::print("coefficient of restitution  {:.4f}  (+-{:.2g} %)\n", r.restitution, 100 * error);
    fmt::print("largest force               {:.5g} N\n", r.force_max);
    fmt::print("largest overlap             {:.5g} m  ({:.3g} of the table's range)\n", r.delta_max, r.delta_max / pair.max_overlap(r_eff));
    fmt::print("residual overlap            {:.5g} m\n", r.delta_residual);
    fmt::print("contact time                {:.5g} s\n", r.contact_time);
  }
  if (needs_axis)
    warn(fmt::format("I = rho V^2/Y = {:.2g} is over {:.2g}: the rate-free law needs its velocity axis there, "
                     "and gives e too high (DESIGN: 3 % at 0.01, 8 % at 0.06)", inertia, c.max_inertia));
  if (r.left_range) warn(fmt::format("the overlap passed the end of the table by {:.1f} %", 100 * (r.delta_max / pair.max_overlap(r_eff) - 1)));
}

}  // namespace

void add_law(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("law", "Replay one collision with a law, as a DEM code would");
  command->footer("Example:\n  mpm law law.h5 --pair granule:granule --radius 0.002 --radius2 0.004 --velocity 0.5 --json");
  auto a = std::make_shared<Arguments>();
  command->add_option("law", a->law, "law file")->required();
  command->add_option("--pair", a->pair, "a:b or a:wall; may be left out where the file holds one pair");
  command->add_option("--radius", a->radius, "radius of the first sphere, m")->capture_default_str();
  command->add_option("--radius2", a->radius2, "radius of the second sphere, m (default: the first's)");
  command->add_option("--velocity", a->velocity, "approach velocity, m/s")->required();
  command->add_flag("--json", a->json, "print one JSON object");
  command->callback([a] { replay(*a); });
}

}  // namespace granulaw::tool
