// mpm table: the contact laws of a materials file, into one law file.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <thread>

#include "base/error.hpp"
#include "base/version.hpp"
#include "characterise/build_law.hpp"
#include "commands.hpp"
#include "law/law_file.hpp"
#include "materials_file.hpp"
#include "ranks.hpp"
#include "terminal.hpp"
#include "trace_file.hpp"

namespace granulaw {

namespace {

struct TableRequest
{
  std::string materials, deck, output;
  std::vector<std::string> pairs;
  double tolerance = 0;
  int jobs = 0;  // 0: one for each core, on several ranks one for each
  std::string cache = default_cache_folder();
  bool no_cache = false;
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

int threads_of(const TableRequest& r)
{
  if (r.jobs > 0) return r.jobs;
  return ranks() > 1 ? 1 : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

RunCache cache_of(const TableRequest& r)
{
  if (r.no_cache || r.cache.empty() || rank() != 0) return RunCache{};
  std::error_code problem;
  std::filesystem::create_directories(r.cache, problem);
  if (problem)
    fail("--cache", fmt::format("the folder '{}' cannot be made ({})", r.cache, problem.message()));
  return RunCache(r.cache);
}

void note(const FarmCount& c, std::map<std::string, std::string>& provenance)
{
  provenance["runs_made"] = fmt::format("{}", c.made);
  provenance["runs_from_cache"] = fmt::format("{}", c.from_cache);
  provenance["runs_retried"] = fmt::format("{}", c.retried);
  provenance["runs_failed"] = fmt::format("{}", c.failed);
  provenance["cpu_s"] = fmt::format("{:.1f}", c.cpu_s);
  provenance["ranks"] = fmt::format("{}", ranks());
}

void print_count(const FarmCount& c)
{
  fmt::print("{} runs made in {:.1f} CPU s", c.made, c.cpu_s);
  if (ranks() > 1) fmt::print(" on {} ranks", ranks());
  if (c.from_cache) fmt::print(", {} taken from the cache ({:.1f} CPU s saved)", c.from_cache, c.cpu_s_saved);
  if (c.retried)
    fmt::print("; {} of them failed at first, {} at a higher resolution too", c.retried, c.failed);
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
  options.tolerance = r.tolerance;
  const std::unique_ptr<Farm> farm = make_farm(threads_of(r), cache_of(r));
  options.farm = farm.get();
  ProgressBar bar(rank() == 0);
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
  note(farm->count(), law.provenance);
  if (rank() != 0) return;
  write_law(law, r.output);

  bar.clear();
  fmt::print("wrote {}: pairs {}\n", r.output, law.pair_list());
  for (const auto& entry : law.bodies) print_certificate(entry.second);
  print_count(farm->count());
}

}  // namespace

void add_table(CLI::App& app)
{
  const auto r = std::make_shared<TableRequest>();
  CLI::App* command = app.add_subcommand(
      "table",
      "Computes the contact laws of a materials file into one law file for LIGGGHTS.\n"
      "Finished runs are kept in a folder (--cache): a build that was stopped goes on where it was, and one\n"
      "with a wider range reuses them. The folder may be removed at any time.\n"
      "mpirun -np N mpm table ... shares the runs among N processes; the law is the same.\n"
      "Example: mpm table materials.toml --pair powder:powder --pair powder:wall -o law.h5");
  command->add_option("MATERIALS", r->materials, "TOML file with [material.NAME]")->required();
  command->add_option("--deck", r->deck, "LIGGGHTS deck to take the pairs from (a later version)");
  command->add_option("--pair", r->pairs,
                      "a:b or a:wall (rigid), material names; several times; default: every pair");
  command->add_option("--tolerance", r->tolerance,
                      "relative error of force and e that two resolutions must agree to, such as 0.005");
  command
      ->add_option("--jobs", r->jobs,
                   "runs at the same time in each process (default: one for each core; under mpirun: one)")
      ->check(CLI::Range(1, 1024));
  CLI::Option* cache =
      command->add_option("--cache", r->cache, "folder for finished runs")->capture_default_str();
  command->add_flag("--no-cache", r->no_cache, "keep no finished run and reuse none")->excludes(cache);
  command->add_option("-o,--output", r->output, "law file, NAME.h5")->required();
  command->callback([r] { build(*r); });
}

}  // namespace granulaw
