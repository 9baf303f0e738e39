// mpm table: the contact laws of a materials file, into one law file.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>
#include <optional>
#include <set>

#include "atlas_path.hpp"
#include "base/error.hpp"
#include "base/version.hpp"
#include "characterise/build_law.hpp"
#include "characterise/reduction_error.hpp"
#include "characterise/two_body_law.hpp"
#include "commands.hpp"
#include "deck_options.hpp"
#include "farm_options.hpp"
#include "law/law_file.hpp"
#include "material_hash.hpp"
#include "materials_file.hpp"
#include "option_checks.hpp"
#include "ranks.hpp"
#include "terminal.hpp"
#include "trace_file.hpp"

namespace granulaw {

namespace {

struct TableRequest
{
  std::string materials, deck, output;
  std::vector<std::string> pairs;
  BuildOptions range;
  double damage_number = 0.0625, radius_ratio = 1, slowest = 0;
  bool no_atlas = false, own_law = false;
  FarmOptions farm;
  DeckOptions scene;  ///< of --deck
};

/// One body of the law file: a material of the materials file, or a particle whose law is its own.
struct Entry
{
  LawMaterial material;  ///< its name is the entry's
  CharacterisedBody characterised;
  std::string body = sphere_name;
  std::string hash;  ///< of all that determines it
};

LawMaterial law_material(const std::string& name, const Material& m)
{
  return {name, m.density, m.youngs_modulus, m.poisson_ratio, m.yield_stress, m.hardening_modulus};
}

/// The entry that a name of --pair means: a material; else a particle, whose law is its material's if it is a
/// homogeneous sphere and the law knows no size.
Entry entry_of(const std::string& name, const MaterialsFile& file)
{
  if (!file.materials.contains(name) && file.particles.contains(name)) {
    const Particle& p = file.particle(name);
    const CharacterisedBody characterised = characterised_body_of(p);
    const int skin = p.material_at(0.0, 1e-9 * characterised.scale.length);
    const Material& m =
        p.materials[static_cast<std::size_t>(std::max(0, p.is_homogeneous_sphere() ? 0 : skin))];
    LawMaterial material = law_material(name, m);
    // the weakest of several; a homogeneous sphere has its own, and a plain one's characterised no dimensions
    if (!p.is_homogeneous_sphere() && characterised.yields())
      material.yield_stress = characterised.yield * characterised.scale.stress;
    return {material, characterised, p.is_homogeneous_sphere() ? sphere_name : name,
            hash_of(characterised, m)};
  }
  const Material& m = file.material(name);
  if (m.rate_dependent())
    fail(fmt::format("{}: [material.{}]", file.path, name),
         fmt::format(
             "its yield stress depends on the rate ('{}'), so its law depends on the particle's size: name a "
             "particle of it, --pair PARTICLE:wall",
             m.rate.name));
  const CharacterisedBody characterised = characterised_body_of(m);
  return {law_material(name, m), characterised, sphere_name, hash_of(characterised, m)};
}

using Pairs = std::vector<std::pair<std::string, std::string>>;

/// The pairs asked for, checked; without any: every material with every other, itself and the wall.
Pairs pairs_of(const TableRequest& r, const MaterialsFile& file)
{
  Pairs pairs;
  const auto check = [&](const std::string& name) {
    if (file.particles.contains(name) || file.materials.contains(name)) return;
    std::vector<std::string> names;
    for (const auto& [known, m] : file.materials) names.push_back(known);
    for (const auto& [known, p] : file.particles) names.push_back(known);
    fail(file.path, fmt::format("no material or particle '{}'{}", name, did_you_mean(name, names)), {},
         fmt::format("{}", fmt::join(names, ", ")));
  };
  for (const std::string& text : r.pairs) {
    const auto colon = text.find(':');
    std::string a = text.substr(0, colon), b = colon == std::string::npos ? "" : text.substr(colon + 1);
    if (a == wall_name) std::swap(a, b);
    if (a.empty() || b.empty() || a == wall_name)
      fail("--pair", "cannot be used", fmt::format("'{}'", text),
           "a:b or a:wall, with names of materials or particles");
    check(a);
    if (b != wall_name) check(b);
    for (const auto& [c, d] : pairs)
      if ((a == c && b == d) || (a == d && b == c))
        fail("--pair", fmt::format("'{}:{}' and '{}:{}' are one pair", c, d, a, b), {}, "each pair once");
    pairs.emplace_back(a, b);
  }
  if (!pairs.empty()) return pairs;
  for (auto a = file.materials.begin(); a != file.materials.end(); ++a) {
    for (auto b = a; b != file.materials.end(); ++b) pairs.emplace_back(a->first, b->first);
    pairs.emplace_back(a->first, wall_name);
  }
  return pairs;
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

void print_certificate(const std::string& name, const BodyLaw& body)
{
  const Certificate& c = body.certificate;
  fmt::print("{}: to delta/R = {:.3g}", name, body.curve.x_end());
  if (body.curve.axis()) fmt::print(" and I = rho V^2/Y = {:.3g}", c.damage_number_max);
  if (c.origin == "atlas")
    fmt::print("; from the atlas: force within {:.2g} %, e within {:.2g}", 100 * c.atlas_error_force,
               c.atlas_error_restitution);
  else
    fmt::print("; held-out e {:.2g} %, scatter {:.2g} %", 100 * c.held_out_error, 100 * c.residual_scatter);
  fmt::print("; solver error {:.2g} %", 100 * c.solver_error_force);
  if (c.verification_impacts > 0)
    fmt::print("; {:.0f} impacts not sampled: force within {:.2g} %, e within {:.2g} %",
               c.verification_impacts, 100 * c.verification_error_force,
               100 * c.verification_error_restitution);
  if (!body.curve.axis() && std::isfinite(c.damage_number_max))
    fmt::print("; rate-free up to I = {:.3g}", c.damage_number_max);
  fmt::print("\n");
}

/// Where sampling ended before the tolerance was reached, a sentence; else nothing.
std::string tolerance_missed(const std::string& name, const BuiltLaw& built, double tolerance)
{
  if (built.sampling_error <= tolerance) return {};
  return fmt::format(
      "mpm: {}: sampling ended before --tolerance {:g} was reached: error where nothing was sampled {:.2g} "
      "(in the law's certificate)\n",
      name, tolerance, built.sampling_error);
}

/// A flow law as the materials file has it; empty: none.
std::string text_of(const FlowLaw& law)
{
  std::string text = law.name;
  for (const auto& [key, values] : law.values)
    text += fmt::format(", {} = {:g}", key, fmt::join(values, " "));
  return text;
}

/// The pair as its two bodies, at this ratio of the partner's radius to the yielding body's.
UnlikePair bodies_of(const LawPair& pair, const Law& law, double radius_ratio)
{
  const LawMaterial &a = law.bodies.at(pair.a).material, &b = law.bodies.at(pair.b).material;
  const bool a_yields = yields_first(a, b);
  return {a_yields ? a : b, a_yields ? b : a, radius_ratio};
}

/// What the pair's law costs, at the end of the range that the pair rule was measured in: by the rule; of its
/// own law, by other radii.
void state_reduction(LawPair& pair, const Law& law, double radius_ratio)
{
  constexpr double damage_number = 0.002;
  if (pair.b == wall_name || (pair.a == pair.b && radius_ratio == 1)) return;
  const TwoBodyLaw* own = law.find_pair_law(pair.a, pair.b);
  for (const double ratio : {radius_ratio, 1 / radius_ratio}) {
    const UnlikePair unlike = bodies_of(pair, law, ratio);
    if (!unlike.yielding.yields()) return;
    const double fastest = fastest_of_law(unlike, damage_number);
    const ReductionError error = own ? estimate_remaining_error(unlike, own->radius_ratio, fastest)
                                     : estimate_reduction_error(unlike, fastest);
    pair.reduction_error_force = std::max(pair.reduction_error_force, error.force);
    pair.reduction_error_restitution = std::max(pair.reduction_error_restitution, error.restitution);
    if (!error.within_measured && rank() == 0)
      fmt::print(
          stderr,
          "mpm: what the pair rule costs {}:{} is extrapolated: the partner is softer than was measured "
          "(docs/pairs.md)\n",
          pair.a, pair.b);
  }
}

/// Pairs, depth and damage number that the scene of --deck can reach; of each it takes what was not given
/// itself. False: no pair of the scene yields.
bool take_from_deck(TableRequest& r, const CLI::App& command)
{
  r.scene.materials_file = r.materials;
  const PlannedDeck d = plan_deck(r.deck, r.scene);
  for (const deck::Question& q : d.plan.questions)
    if (q.option != "--particles N")
      fail(r.deck, fmt::format("not in the deck: {}: give it by {}", q.what, q.option));
  double ratio = 1;
  std::set<std::string> pairs;
  for (const deck::PairPlan& p : d.plan.pairs) {
    if (!p.needs_table || !p.visited) continue;
    pairs.insert(p.meeting.name_a + ":" + p.meeting.name_b);
    ratio = std::max(ratio, deck::radius_ratio(d.plan, p.meeting));
  }
  if (pairs.empty()) return false;
  if (command.count("--pair") == 0) r.pairs.assign(pairs.begin(), pairs.end());
  if (command.count("--depth") == 0) r.range.depth = d.plan.depth;
  if (command.count("--damage-number") == 0) r.damage_number = d.plan.damage_number;
  if (command.count("--radius-ratio") == 0) r.radius_ratio = ratio;
  if (rank() == 0)
    fmt::print("{}: needs {} to delta/R = {:.3g} and I = {:.3g}\n", printable(r.deck),
               fmt::join(r.pairs, ", "), r.range.depth, r.damage_number);
  return true;
}

/// Whether the two make a pair that may have its own law: different homogeneous spheres, one yields.
bool may_have_own_law(const LawPair& pair, const std::map<std::string, Entry>& entries, const Law& law)
{
  if (pair.a == pair.b || pair.b == wall_name) return false;
  for (const std::string& name : {pair.a, pair.b})
    if (entries.at(name).body != sphere_name || !entries.at(name).characterised.is_plain()) return false;
  return bodies_of(pair, law, 1).yielding.yields();
}

/// Throws where --slowest is of no use, or leaves the rate axis no room.
void check_slowest(const TableRequest& r, const std::map<std::string, Entry>& entries)
{
  if (r.slowest == 0) return;
  bool used = false;
  for (const auto& [name, entry] : entries) {
    if (!entry.characterised.rate_dependent()) continue;
    used = true;
    const double fastest =
        std::sqrt(r.damage_number * entry.material.yield_stress / entry.material.density);  // on a wall
    if (r.slowest > 0.7 * fastest)
      fail("--slowest", fmt::format("is no slower than the fastest impact of '{}' (--damage-number)", name),
           fmt::format("{:g} m/s", r.slowest), fmt::format("up to {:.4g} m/s", 0.7 * fastest));
  }
  if (!used) fail("--slowest", "no body of the pairs depends on the rate: leave it out");
}

/// Throws for a pair of different bodies that the pair rule is not for: before anything is computed.
void check_pairs(const std::vector<LawPair>& pairs, const std::map<std::string, Entry>& entries)
{
  const auto body_of = [&](const std::string& name) {
    BodyLaw body;
    body.material = entries.at(name).material;
    body.body = entries.at(name).body;
    return body;
  };
  for (const LawPair& pair : pairs)
    if (pair.b != wall_name && pair.a != pair.b)
      check_partners(body_of(pair.a), body_of(pair.b), fmt::format("--pair {}:{}", pair.a, pair.b));
}

void build(const TableRequest& r)
{
  check_output(r.output, ".h5");
  r.farm.check();
  const MaterialsFile file = read_materials(r.materials);
  Law law;
  std::map<std::string, Entry> entries;
  for (const auto& [a, b] : pairs_of(r, file)) {
    law.pairs.push_back({a, b});
    for (const std::string& name : {a, b})
      if (name != wall_name && !entries.contains(name)) entries[name] = entry_of(name, file);
  }
  check_pairs(law.pairs, entries);
  check_slowest(r, entries);

  BuildOptions options = r.range;
  options.fastest = std::sqrt(r.damage_number);
  std::optional<Atlas> atlas;
  if (const std::string path = atlas_path(); !r.no_atlas && !path.empty()) atlas = read_atlas(path);
  options.atlas = atlas ? &*atlas : nullptr;
  std::unique_ptr<Farm> farm;  // made when the first run is needed
  ProgressBar bar(rank() == 0);
  std::vector<std::string> remarks;
  std::string warnings;
  double finished = 0;
  for (const auto& [name, entry] : entries) {
    const bool plain = entry.characterised.is_plain();
    const std::string why = !plain       ? "its law is its own"
                            : r.no_atlas ? "--no-atlas"
                            : !atlas     ? "there is no atlas beside the program"
                            : entry.characterised.yields()
                                ? atlas->why_not(MaterialRatios::of(entry.material))
                                : std::string();
    if (why.empty()) {
      law.bodies[name] = law_from(*atlas, entry.material, options);
      remarks.push_back(name + ": from the atlas");
    } else {
      if (!farm) farm = r.farm.farm();
      options.farm = farm.get();
      options.slowest = entry.characterised.rate_dependent()
                            ? r.slowest * std::sqrt(entry.material.density / entry.material.yield_stress)
                            : 0.0;
      options.progress = [&, &name = name](double done, const std::string& what) {
        bar.update((finished + done) / static_cast<double>(entries.size()), name + ": " + what);
      };
      BuiltLaw built = build_law(entry.material, entry.characterised, options);
      law.bodies[name] = std::move(built.law);
      warnings += tolerance_missed(name, built, options.tolerance);
      remarks.push_back(fmt::format("{}: by {} runs, {} of the densest sampling plan ({})", name, built.runs,
                                    built.runs_full, why));
      for (std::size_t k = 0; k < built.holes.size(); ++k)
        law.provenance[fmt::format("hole.{}.{}", name, k + 1)] = built.holes[k];
      law.provenance["sampling_plan." + name] = law.provenance["survey." + name] =
          fmt::format("{} runs, {} of the densest sampling plan", built.runs, built.runs_full);
      if (!built.shallow.empty()) law.provenance["shallow." + name] = built.shallow;
      if (!built.rate_free.empty()) law.provenance["rate_free." + name] = built.rate_free;
      const auto& materials = entry.characterised.particle.materials;
      if (materials.size() == 1 && !materials[0].hardening.name.empty())
        law.provenance["hardening." + name] = text_of(materials[0].hardening);
      if (materials.size() == 1 && materials[0].rate_dependent())
        law.provenance["rate." + name] = text_of(materials[0].rate);
      law.provenance["admissible." + name] =
          fmt::format("the fitted e changed by {:.2g} % at most", 100 * built.change_of_restitution);
      if (entry.characterised.rate_dependent()) {
        const VelocityAxis* axis = law.bodies[name].curve.axis();
        law.provenance["size." + name] =
            axis ? fmt::format(
                       "rate-dependent: holds for R = {:g} m and from {:.3g} m/s on a wall",
                       entry.characterised.scale.length,
                       axis->speed_begin() * std::sqrt(entry.material.yield_stress / entry.material.density))
                 : fmt::format(
                       "rate-dependent, by less than the tolerance at R = {:g} m and in this range of speeds",
                       entry.characterised.scale.length);
        remarks.push_back(name + ": " + law.provenance["size." + name]);
      }
    }
    BodyLaw& body = law.bodies[name];
    body.body = entry.body;
    if (entry.body != sphere_name) {
      body.pole_radius = entry.characterised.scale.length;
      body.mass_ratio = entry.characterised.mass / (4.0 / 3.0 * M_PI);
    }
    law.provenance["material_hash." + name] = entry.hash;
    finished += 1;
  }
  for (LawPair& pair : law.pairs) {
    const std::string name = pair.a + ":" + pair.b;
    state_reduction(pair, law, r.radius_ratio);
    const double worst = std::max(pair.reduction_error_force, pair.reduction_error_restitution);
    if (!may_have_own_law(pair, entries, law) || worst <= options.tolerance) continue;
    if (!r.own_law) {
      remarks.push_back(
          fmt::format("{}: by the pair rule, force within {:.2g} %, e within {:.2g} %; --own-law computes "
                      "the pair's own law",
                      name, 100 * pair.reduction_error_force, 100 * pair.reduction_error_restitution));
      continue;
    }
    if (law.find_pair_law(pair.a, pair.b)) continue;  // named twice
    if (!farm) farm = r.farm.farm();
    options.farm = farm.get();
    options.progress = [&](double done, const std::string& what) { bar.update(done, name + ": " + what); };
    BuiltLaw built = build_two_body_law(bodies_of(pair, law, 1), options);
    law.pair_laws[name] = {std::move(built.law), 1};
    warnings += tolerance_missed(name, built, options.tolerance);
    for (std::size_t k = 0; k < built.holes.size(); ++k)
      law.provenance[fmt::format("hole.{}.{}", name, k + 1)] = built.holes[k];
    remarks.push_back(fmt::format(
        "{}: its own law by {} runs of two bodies of equal radii (pair rule: force within "
        "{:.2g} %, e within {:.2g} %)",
        name, built.runs, 100 * pair.reduction_error_force, 100 * pair.reduction_error_restitution));
    pair.reduction_error_force = pair.reduction_error_restitution = 0;
    state_reduction(pair, law, r.radius_ratio);
  }
  law.provenance["version"] = version();
  law.provenance["git_hash"] = git_hash();
  law.provenance["created"] = now_utc();
  law.provenance["command"] = command_line;
  law.provenance["reduction_radius_ratio"] = fmt::format("{:g}", r.radius_ratio);
  if (farm) note(farm->count(), law.provenance);
  if (rank() != 0) return;
  write_law(law, r.output);

  bar.clear();
  fmt::print("wrote {}: pairs {}\n", r.output, law.pair_list());
  for (const std::string& remark : remarks) fmt::print("{}\n", remark);
  for (const auto& [name, body] : law.bodies) print_certificate(name, body);
  for (const auto& [name, own] : law.pair_laws) print_certificate(name, own.law);
  if (farm) print_count(farm->count());
  fmt::print(stderr, "{}", warnings);
}

}  // namespace

void add_table(CLI::App& app)
{
  const auto r = std::make_shared<TableRequest>();
  CLI::App* command = app.add_subcommand(
      "table",
      "Makes the contact laws of a materials file, one law file for LIGGGHTS. A homogeneous sphere that "
      "hardens\n"
      "linearly or not at all comes from the atlas at once (--no-atlas: computed anew); other hardening "
      "laws,\n"
      "rate dependence, layers, inclusions and profiles are computed by the solver: name the particle in "
      "--pair.\n"
      "Finished runs are kept in a folder (--cache): a build that was stopped goes on where it was, and one\n"
      "with a wider range reuses them. The folder may be removed at any time.\n"
      "mpirun -np N mpm table ... shares the runs among N processes; the law is the same.\n"
      "Example: mpm table materials.toml --pair powder:powder --pair powder:wall -o law.h5");
  command->add_option("MATERIALS", r->materials, "TOML file with [material.NAME]")->required();
  CLI::Option* deck =
      command->add_option("--deck", r->deck, "LIGGGHTS deck: only what its scene can reach (mpm plan)");
  r->scene.add_to(*command, false, deck);
  command->add_option(
      "--pair", r->pairs,
      "a:b or a:wall (rigid), names of materials or particles; several times; default: every pair of\n"
      "materials");
  command
      ->add_option(
          "--tolerance", r->range.tolerance,
          "relative error of force and e (of an e below 0.5, over 0.5): of sampling, of the resolution, "
          "and below which an axis is left out")
      ->check(from_to(1e-4, 0.5))
      ->capture_default_str();
  command->add_option("--depth", r->range.depth, "largest overlap over the radius, up to 0.5")
      ->check(above_zero_to(0.5))
      ->capture_default_str();
  command
      ->add_option("--damage-number,--inertia", r->damage_number,
                   "largest damage number I = rho V^2/Y, up to 0.09; 0: a rate-free law")
      ->check(from_to(0, 0.09))
      ->capture_default_str();
  command
      ->add_option(
          "--slowest", r->slowest,
          "speed, m/s on a wall, of the slowest impact that the law of a rate-dependent particle must\n"
          "know: slower ones count as this one (default: a fiftieth of the fastest, or the onset of "
          "yield)")
      ->check(above_zero());
  command
      ->add_option("--radius-ratio", r->radius_ratio,
                   "largest ratio of two radii in the scene: the pair rule's error is stated for it")
      ->check(from_to(1, 10))
      ->capture_default_str();
  command->add_flag("--own-law", r->own_law,
                    "compute a law of its own, by runs of the two bodies at equal radii, for each pair of\n"
                    "different spheres whose law by the pair rule is off by more than --tolerance");
  command->add_flag("--no-atlas", r->no_atlas, "compute every law by the solver");
  r->farm.add_to(command);
  command->add_option("-o,--output", r->output, "law file, NAME.h5")->required();
  command->callback([r, command] {
    if (!r->deck.empty() && !take_from_deck(*r, *command)) {
      if (rank() == 0)
        fmt::print("{}: no pair of the scene yields: Hertz suffices, no law is written\n",
                   printable(r->deck));
      return;
    }
    build(*r);
  });
}

}  // namespace granulaw
