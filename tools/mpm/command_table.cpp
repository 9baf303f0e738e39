#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <thread>

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "base/version.hpp"
#include "characterise/build_law.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "law/law_file.hpp"
#include "materials_file.hpp"

namespace granulaw::tool {

namespace {

struct Arguments
{
  std::string materials, deck, output;
  std::vector<std::string> pairs;
  double tolerance = 0.01, depth = 0.1;
  int jobs = 0;
  bool keep_runs = false;
};

using Pair = std::pair<std::string, std::string>;

/// A name in --pair: a material, or a particle that stands for its material, or "wall".
std::string material_named(const MaterialsFile& file, const std::string& name)
{
  if (name == wall_name) return name;
  if (const auto p = file.particles.find(name); p != file.particles.end() && !file.materials.count(name)) return p->second.material;
  return file.material(name).name;
}

std::vector<Pair> pairs_of(const MaterialsFile& file, const std::vector<std::string>& words)
{
  std::vector<Pair> pairs;
  for (const std::string& word : words) {
    const std::size_t colon = word.find(':');
    if (colon == std::string::npos) fail("--pair", "is not two names", word, "a:b or a:wall");
    Pair p{material_named(file, word.substr(0, colon)), material_named(file, word.substr(colon + 1))};
    if (p.first == wall_name) std::swap(p.first, p.second);
    if (p.first == wall_name) fail("--pair", "two walls do not touch", word, "a:b or a:wall");
    if (std::find(pairs.begin(), pairs.end(), p) == pairs.end()) pairs.push_back(p);
  }
  if (!pairs.empty()) return pairs;
  for (auto a = file.materials.begin(); a != file.materials.end(); ++a) {
    for (auto b = a; b != file.materials.end(); ++b) pairs.push_back({a->first, b->first});
    pairs.push_back({a->first, wall_name});
  }
  return pairs;
}

void build(const Arguments& a)
{
  if (!a.deck.empty()) fail("--deck", "this version cannot read decks yet; name the pairs with --pair");
  if (!(a.tolerance >= 1e-3 && a.tolerance <= 0.2)) fail("--tolerance", "cannot be used", fmt::format("{:g}", a.tolerance), "0.001 to 0.2, relative");
  if (a.jobs < 0) fail("--jobs", "cannot be used", std::to_string(a.jobs), "1 or more");
  require_writable(a.output, "-o");
  const auto start = std::chrono::steady_clock::now();
  const MaterialsFile file = read_materials(a.materials);
  Law law;
  law.pairs = pairs_of(file, a.pairs);
  std::set<std::string> names;
  for (const auto& [i, j] : law.pairs)
    for (const std::string& name : {i, j})
      if (name != wall_name) names.insert(name);

  ProgressBar bar("table");
  double before = 0;
  for (const std::string& name : names) {
    BuildOptions options;
    options.depth = a.depth;
    options.tolerance = a.tolerance;
    options.jobs = a.jobs ? a.jobs : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    options.cache_folder = a.output + ".runs";
    options.progress = [&](double done, const std::string& what) {
      bar.show((before + done) / static_cast<double>(names.size()), fmt::format("{}: {}", name, what));
    };
    law.bodies.emplace(name, build_law(file.material(name), options));
    before += 1;
  }
  law.provenance = {{"version", version()},
                    {"git_hash", git_hash()},
                    {"created", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))},
                    {"command", fmt::format("mpm table {} --depth {:g} --tolerance {:g} --pair {}", a.materials, a.depth, a.tolerance, law.pair_list())}};
  write_law(law, a.output);
  if (!a.keep_runs) RunCache(a.output + ".runs").remove();

  fmt::print("{}: {} in {:.1f} s\n", a.output, law.pair_list(),
             std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  for (const auto& [name, body] : law.bodies) {
    const Certificate& c = body.certificate;
    fmt::print("  {}: overlap to {:.3g} R; solver error {:.2g} %, against fresh impacts F {:.2g} %, e {:.2g} %\n", name,
               body.curve.x_end(), 100 * std::max(c.solver_error_force, c.solver_error_restitution),
               100 * c.verification_error_force, 100 * c.verification_error_restitution);
  }
}

}  // namespace

void add_table(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("table", "Compute the contact law of materials, for LIGGGHTS");
  command->footer(
      "Example:\n  mpm table materials.toml --pair granule:granule --pair granule:wall -o law.h5\n\n"
      "A pair is two materials, or a material and a rigid wall. Without --pair: all of them.\n"
      "A build that was stopped goes on where it was: finished runs wait in OUTPUT.runs/ until the law is written.");
  auto a = std::make_shared<Arguments>();
  command->add_option("materials", a->materials, "TOML file with [material.NAME]")->required();
  command->add_option("--pair", a->pairs, "a:b or a:wall; may be given several times");
  command->add_option("--deck", a->deck, "LIGGGHTS deck that says which pairs occur (not in this version)");
  command->add_option("--depth", a->depth, "largest overlap over radius on a rigid wall, up to 0.5; beyond 0.1 no single pair law exists")->capture_default_str();
  command->add_option("--tolerance", a->tolerance, "relative error aimed at in force and restitution")->capture_default_str();
  command->add_option("--jobs", a->jobs, "runs at the same time (default: one a core)");
  command->add_flag("--keep-runs", a->keep_runs, "keep the finished runs for a later build");
  command->add_option("-o,--output", a->output, "law file to write")->required();
  command->callback([a] { build(*a); });
}

}  // namespace granulaw::tool
