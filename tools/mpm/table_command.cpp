// mpm table: the contact laws of a materials file, into one law file.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>
#include <set>
#include <thread>

#include "base/error.hpp"
#include "base/version.hpp"
#include "characterise/build_law.hpp"
#include "commands.hpp"
#include "law/law_file.hpp"
#include "materials_file.hpp"
#include "terminal.hpp"
#include "trace_file.hpp"

namespace granulaw {

namespace {

struct TableRequest
{
  std::string materials, deck, output;
  std::vector<std::string> pairs;
  double tolerance = 0;
  int jobs = std::max(1u, std::thread::hardware_concurrency());
};

using Pairs = std::vector<std::pair<std::string, std::string>>;

/// The pairs asked for, checked; without any: every material with every other, itself and the wall.
Pairs pairs_of(const TableRequest& r, const MaterialsFile& file)
{
  Pairs pairs;
  for (const std::string& text : r.pairs) {
    const auto colon = text.find(':');
    if (colon == std::string::npos)
      fail("--pair", "cannot be used", fmt::format("'{}'", text), "a:b or a:wall, with material names");
    std::string a = text.substr(0, colon), b = text.substr(colon + 1);
    if (a == wall_name) std::swap(a, b);
    file.material(a);
    if (b != wall_name) file.material(b);
    pairs.emplace_back(a, b);
  }
  if (!pairs.empty()) return pairs;
  for (auto a = file.materials.begin(); a != file.materials.end(); ++a) {
    for (auto b = a; b != file.materials.end(); ++b) pairs.emplace_back(a->first, b->first);
    pairs.emplace_back(a->first, wall_name);
  }
  return pairs;
}

std::string material_text(const Material& m)
{
  return fmt::format("{:.17g} {:.17g} {:.17g} {:.17g} {:.17g}", m.density, m.youngs_modulus, m.poisson_ratio,
                     m.yield_stress, m.hardening_modulus);
}

/// FNV-1a of the five numbers: tells whether a law was made from these very materials.
std::string material_hash(const Material& m)
{
  std::uint64_t h = 14695981039346656037ull;
  for (const char c : material_text(m)) h = (h ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  return fmt::format("{:016x}", h);
}

std::string now_utc()
{
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

void print_certificate(const BodyLaw& body)
{
  const Certificate& c = body.certificate;
  fmt::print("{}: to delta/R = {:.3g}; solver error {:.2g} %, held-out e {:.2g} %, scatter {:.2g} %",
             body.material.name, body.curve.x_end(), 100 * c.solver_error_force, 100 * c.held_out_error,
             100 * c.residual_scatter);
  if (c.verification_impacts > 0)
    fmt::print("; {:.0f} impacts not sampled: force within {:.2g} %, e within {:.2g} %",
               c.verification_impacts, 100 * c.verification_error_force,
               100 * c.verification_error_restitution);
  if (std::isfinite(c.max_inertia)) fmt::print("; rate-free up to I = rho V^2/Y = {:.3g}", c.max_inertia);
  fmt::print("\n");
}

void build(const TableRequest& r)
{
  if (!r.deck.empty())
    fail("--deck", "reading decks is not in this version yet: name the pairs with --pair a:b");
  if (r.tolerance != 0 && !(r.tolerance >= 1e-4 && r.tolerance <= 0.5))
    fail("--tolerance", "cannot be used", fmt::format("{:g}", r.tolerance), "1e-4 to 0.5");
  check_output(r.output, ".h5");
  const MaterialsFile file = read_materials(r.materials);
  Law law;
  std::set<std::string> names;
  for (const auto& [a, b] : pairs_of(r, file)) {
    law.pairs.push_back({a, b});
    names.insert(a);
    if (b != wall_name) names.insert(b);
  }

  for (const std::string& name : names) {
    const Material& m = file.material(name);
    const std::string where = fmt::format("{}: [material.{}]", r.materials, name);
    if (m.rate_dependent())
      fail(where, fmt::format("its yield stress depends on the rate ('{}'): a contact law of such a material "
                              "needs an axis in V/R, "
                              "which this version does not have; mpm impact can be used",
                              m.rate.name));
    if (!m.hardening.name.empty())
      fail(where, fmt::format("a law file cannot hold the hardening law '{}' yet", m.hardening.name), {},
           "'linear' or none; mpm impact and mpm press can be used");
  }

  BuildOptions options;
  options.jobs = r.jobs;
  options.tolerance = r.tolerance;
  options.cache_folder = r.output + ".runs";
  ProgressBar bar;
  double finished = 0;
  for (const std::string& name : names) {
    const Material& m = file.material(name);
    options.progress = [&](double done, const std::string& what) {
      bar.update((finished + done) / static_cast<double>(names.size()), name + ": " + what);
    };
    LawMaterial material{name,           m.density,          m.youngs_modulus, m.poisson_ratio,
                         m.yield_stress, m.hardening_modulus};
    law.bodies[name] = build_law(material, options);
    law.provenance["material_hash." + name] = material_hash(m);
    finished += 1;
  }
  law.provenance["version"] = version();
  law.provenance["git_hash"] = git_hash();
  law.provenance["created"] = now_utc();
  law.provenance["command"] = command_line;
  write_law(law, r.output);
  RunCache(options.cache_folder).remove();

  bar.clear();
  fmt::print("wrote {}: pairs {}\n", r.output, law.pair_list());
  for (const auto& entry : law.bodies) print_certificate(entry.second);
}

}  // namespace

void add_table(CLI::App& app)
{
  const auto r = std::make_shared<TableRequest>();
  CLI::App* command = app.add_subcommand(
      "table",
      "Computes the contact laws of a materials file into one law file for LIGGGHTS.\n"
      "Finished runs are kept in LAW.h5.runs/ until the law is written: a build that was stopped goes on\n"
      "where it was when the same command is given again.\n"
      "Example: mpm table materials.toml --pair powder:powder --pair powder:wall -o law.h5");
  command->add_option("MATERIALS", r->materials, "TOML file with [material.NAME]")->required();
  command->add_option("--deck", r->deck, "LIGGGHTS deck to take the pairs from (a later version)");
  command->add_option("--pair", r->pairs,
                      "a:b or a:wall (rigid), material names; several times; default: every pair");
  command->add_option("--tolerance", r->tolerance,
                      "relative error of force and e that two resolutions must agree to, such as 0.005");
  command->add_option("--jobs", r->jobs, "runs at the same time (default: one for each core)")
      ->check(CLI::Range(1, 1024));
  command->add_option("-o,--output", r->output, "law file, NAME.h5")->required();
  command->callback([r] { build(*r); });
}

}  // namespace granulaw
