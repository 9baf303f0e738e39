// mpm table: the contact laws of a materials file, into one law file.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "characterise/body/law_body.hpp"
#include "characterise/build/build_law.hpp"
#include "characterise/file/make_law_file.hpp"
#include "collision_report.hpp"
#include "command.hpp"
#include "deck_options.hpp"
#include "farm_options.hpp"
#include "law/law_file.hpp"
#include "law/pair_lines.hpp"
#include "law/pair_names.hpp"
#include "law/range.hpp"
#include "material_file/materials_file.hpp"
#include "option_checks.hpp"
#include "own_files.hpp"
#include "ranks.hpp"
#include "shape_output.hpp"
#include "terminal.hpp"

namespace granulaw {

namespace of_table {

struct TableRequest
{
  std::string materials, deck, output;
  std::vector<std::string> pairs;
  LawFileRequest file;
  bool no_atlas = false;
  FarmOptions farm;
  DeckOptions scene;  ///< of --deck
};

/// Takes from the deck what was not given itself: pairs, depth, damage number and radius ratio. Returns its plan.
deck::Plan take_from_deck(TableRequest& r, const Options& command)
{
  r.scene.materials_file = r.materials;
  PlannedDeck d = plan_deck(r.deck, r.scene);
  require_answers(d.plan, r.deck);
  if (!(d.plan.depth > 0)) return d.plan;
  if (command.count("--pair") == 0) r.pairs = d.plan.law_pairs;
  if (rank() == 0)
    for (const std::string& sentence : deck::beyond_laws(d.plan)) fmt::print(stderr, "mpm: {}\n", printable(sentence));
  if (command.count("--depth") == 0) r.file.depth = d.plan.depth;
  if (command.count("--damage-number") == 0) r.file.damage_number = d.plan.damage_number;
  const deck::PairSizes sizes = deck::pair_sizes(d.plan);
  if (command.count("--radius-ratio") == 0) r.file.radius_ratio = sizes.radius_ratio;
  if (command.count("--thick-walls") == 0) r.file.thick_walls = sizes.thick_walls;
  return d.plan;
}

/// The request as the library takes it; `atlas` may be null.
LawFileRequest law_file_request(const TableRequest& r, const Atlas* atlas)
{
  LawFileRequest request = r.file;
  request.materials = read_materials(r.materials);
  for (const std::string& text : r.pairs) request.pairs.push_back(new_pair(text));
  request.atlas = atlas;
  request.words = {"--pair", "--slowest", "--damage-number", r.no_atlas ? "--no-atlas" : "there is no atlas beside the program"};
  return request;
}

MadeLawFile make(const LawFilePlan& plan, Farm* farm)
{
  ProgressBar bar(rank() == 0);
  MadeLawFile file = make_law_file(plan, farm, [&](double done, const std::string& what) { bar.update(done, what); });
  file.law.provenance["command"] = command_line;
  if (farm) file.law.provenance["ranks"] = fmt::format("{}", ranks());
  return file;
}

/// Before the runs: why they are needed, and what they cost. At once, as a batch job's log shows it.
void print_expected(const LawFilePlan& plan)
{
  for (const auto& [name, body] : plan.bodies) {
    if (body.from_atlas()) continue;
    const ExpectedRuns runs = expected_runs(body.body->material, body.body->characterised, plan.build_options());
    fmt::print("{}: by the solver ({}): {} runs to begin with, about {:.0f} s of CPU\n", name, body.why_runs, runs.first, std::max(1.0, runs.first_cpu_s));
  }
  std::fflush(stdout);
}

void print_body(const std::string& name, const LawFilePlan::Body& planned, const MadeLawFile& file)
{
  if (planned.from_atlas()) return fmt::print("{}: from the atlas\n", name);
  const MadeLawFile::Runs& runs = file.runs.at(name);
  fmt::print("{}: by {} runs ({})\n", name, runs.made, planned.why_runs);
  if (!runs.size.empty()) fmt::print("{}: {}\n", name, runs.size);
}

/// As planned; a pair that could not be composed follows the pair rule.
bool has_own_laws(const LawFilePlan::Pair& pair, const Law& law) { return law.pair_laws.contains(pair.name()); }

/// Ratios of radii that have no law of their own.
void print_not_composed(const LawFilePlan::Pair& pair, const MadeLawFile& file)
{
  std::vector<double> missing = pair.composed_at;
  if (has_own_laws(pair, file.law))
    for (const TwoBodyLaw& own : file.law.pair_laws.at(pair.name())) std::erase(missing, own.radius_ratio);
  if (missing.empty()) return;
  const auto material = [&](const std::string& name) { return file.law.bodies.at(name).material; };
  const std::string& yielding = yields_first(material(pair.a), material(pair.b)) ? pair.a : pair.b;
  fmt::print("{}: cannot be composed where the partner's radius over that of '{}' is {:.4g} (mpm info says why): {}\n", pair.name(), yielding, fmt::join(missing, ", "),
      has_own_laws(pair, file.law) ? "the law of the nearest ratio stands in" : "the pair rule stands in");
}

/// Origin of the pair's laws, if it is worth a line.
void print_origin(const LawFilePlan::Pair& pair, const MadeLawFile& file)
{
  print_not_composed(pair, file);
  if (!has_own_laws(pair, file.law)) {
    if (pair.worth_own_law) fmt::print("{}: follows the pair rule; --own-law computes a two-body law\n", pair.name());
    return;
  }
  if (pair.a == pair.b || !pair.own_law) return;
  const Certificate& c = file.law.pair_laws.at(pair.name()).front().law.certificate;
  if (c.origin != composed_origin)
    fmt::print("{}: by {} runs of two bodies of equal radii\n", pair.name(), file.runs.at(pair.name()).made);
  else if (c.verification_impacts > 0)
    fmt::print("{}: corrected by {} impacts of the two bodies\n", pair.name(), file.runs.at(pair.name()).made);
  else
    fmt::print("{}: not corrected, as impacts of the two bodies failed: mpm info says why\n", pair.name());
}

void print_certificate(const std::string& name, const BodyLaw& body)
{
  const Certificate& c = body.certificate;
  fmt::print("{}: to delta/R = {:.3g}", name, body.curve.end());
  if (body.curve.axis()) fmt::print(" and I = rho V^2/Y = {:.3g}", c.damage_number_max);
  if (c.origin != "atlas") fmt::print("; held-out e {}, scatter {}", percent(c.held_out_error), percent(c.residual_scatter));
  fmt::print("; solver error of a computation {}", percent(c.solver_error_force));
  if (c.verification_impacts > 0)
    fmt::print("; {:.0f} impacts not sampled: {}", c.verification_impacts, errors_text(c.verification_error_force, c.verification_error_restitution));
  if (!body.curve.axis() && std::isfinite(c.damage_number_max)) fmt::print("; quasi-static up to I = {:.3g}", c.damage_number_max);
  fmt::print("\n");
}

void print_warnings(const LawFilePlan& plan, const MadeLawFile& file)
{
  for (const auto& [name, runs] : file.runs)
    if (runs.sampling_error > plan.request.tolerance)
      fmt::print(stderr, "mpm: {}: sampling ended before --tolerance {:g} was reached: error where nothing was sampled {:.2g} (in the law's certificate)\n", name,
          plan.request.tolerance, runs.sampling_error);
}

void report(const TableRequest& r, const LawFilePlan& plan, const MadeLawFile& file, const Farm* farm)
{
  fmt::print("wrote {}: pairs {}\n", r.output, file.law.pair_list());
  for (const auto& [name, planned] : plan.bodies) print_body(name, planned, file);
  for (const LawFilePlan::Pair& pair : plan.pairs) print_origin(pair, file);
  for (const auto& [name, body] : file.law.bodies) {
    print_certificate(name, body);
    if (body.shape) print_shape(name, *body.shape);
  }
  for (const auto& [name, laws] : file.law.pair_laws)
    for (const TwoBodyLaw& own : laws)
      if (own.law.certificate.origin != composed_origin) print_certificate(name, own.law);
  fmt::print("error bounds: 95 % of head-on impacts lie within\n");
  for (const LawPair& pair : file.law.pairs)
    for (const PairLine& line : pair_lines(file.law, pair)) fmt::print("{}:{}  {}\n", pair.a, pair.b, line.text());
  if (farm) print_count(farm->count());
  print_warnings(plan, file);
}

/// The pairs of the deck that are faster than the error bound of their law.
void warn_of_fast_pairs(const Law& law, const deck::Plan& plan)
{
  for (const deck::PairPlan& p : plan.pairs) {
    if (!p.needs_table || !p.visited) continue;
    const auto &a = p.meeting.name_a, &b = p.meeting.name_b;
    const LawPair* pair = law.find_pair(a, b);
    if (!pair) continue;
    double least = std::numeric_limits<double>::infinity();
    for (const PairLine& line : pair_lines(law, *pair)) least = std::min(least, line.least_damage_number_max);
    if (p.damage_number > least * (1 + 1e-9))
      fmt::print(stderr, "mpm: {}:{} reaches I = {:.3g} in the deck, and the error bound of its law holds to {:.3g}: beyond, no bound is stated{}\n", printable(a),
          printable(b), p.damage_number, least, a != b && b != wall_name ? " (--own-law may raise it)" : "");
  }
}

void make_table(const TableRequest& r, const deck::Plan* of_deck = nullptr)
{
  check_output("-o", r.output, ".h5");
  r.farm.check();
  const std::optional<Atlas> atlas = r.no_atlas ? std::nullopt : own_atlas();
  const LawFilePlan plan = plan_law_file(law_file_request(r, atlas ? &*atlas : nullptr));
  if (rank() == 0) print_expected(plan);
  const std::unique_ptr<Farm> farm = plan.needs_runs() ? r.farm.farm() : nullptr;
  MadeLawFile file = make(plan, farm.get());
  if (rank() != 0) return;
  if (of_deck) deck::note_plan(file.law, *of_deck, r.deck);
  write_law(file.law, r.output);
  report(r, plan, file, farm.get());
  if (of_deck) warn_of_fast_pairs(file.law, *of_deck);
}

/// Table for --deck: only the pairs of its simulation.
void make_table_for_deck(TableRequest& r, const Options& command)
{
  const deck::Plan plan = take_from_deck(r, command);
  if (!(plan.depth > 0)) {
    if (rank() == 0) fmt::print("{}: no pair of the deck yields: Hertz suffices, no law is written\n", printable(r.deck));
    return;
  }
  if (rank() == 0) fmt::print("{}: needs {} to delta/R = {:.3g} and I = {:.3g}\n", printable(r.deck), fmt::join(r.pairs, ", "), r.file.depth, r.file.damage_number);
  make_table(r, &plan);
}

void add_range_options(Options& command, LawFileRequest& file)
{
  command
      .add_option("--tolerance", file.tolerance,
          "relative error of force and e (of an e below 0.5, over 0.5). A velocity axis of a smaller effect is left out,\n"
          "and the error bound states that effect")
      .check(from_to(1e-4, 0.5))
      .capture_default_str();
  command.add_option("--depth", file.depth, "largest overlap over the radius, up to 0.5").check(above_zero_to(deepest_law)).capture_default_str();
  command
      .add_option("--damage-number,--inertia", file.damage_number,
          "largest damage number I = rho V^2/Y (Johnson's; it has nothing to do with breakage), up to 0.09;\n0: a quasi-static law")
      .check(from_to(0, fastest_law))
      .capture_default_str();
  command
      .add_option("--slowest", file.slowest,
          "lowest impact speed, m/s on a wall, that the law of a rate-dependent particle covers. Slower impacts use\n"
          "this speed (default: a fiftieth of the fastest, or the onset of yield)")
      .check(above_zero());
  command.add_option("--radius-ratio", file.radius_ratio, "largest ratio of two spheres' radii: pairs get a law for each ratio up to it")
      .check(from_to(1, 10))
      .capture_default_str();
  command.add_flag("--thick-walls,!--no-thick-walls", file.thick_walls,
      "also laws for deformable walls: of either material of a pair, and of the particle's material (default:\n"
      "yes; --deck: if it has such walls)");
  command.add_flag("--correct-pairs,--own-law", file.own_laws,
      "correct composed laws whose error is above --tolerance by impacts of the two bodies.\n"
      "Without the atlas: two-body laws, at equal radii");
}

void add_shape_options(Options& command, ShapeQuestion& shapes)
{
  command.add_option("--directions,--orientations", shapes.directions, "of a particle with a shape: directions of its certificate, over all that its mirror planes leave")
      .check(whole_from_to(4, 10000))
      .capture_default_str();
  command
      .add_option("--velocity", shapes.velocities,
          "of a particle with a shape: speeds of the certificate's impacts, m/s (default: where rho\n"
          "V^2/Y is 0.0025)")
      .list()
      .check(above_zero());
}

void define(Options& command)
{
  const auto r = std::make_shared<TableRequest>();
  command.add_option("MATERIALS", r->materials, "TOML file with [material.NAME]").required();
  const Option deck = command.add_option("--deck", r->deck, "LIGGGHTS deck: only the pairs, speeds and overlaps that it can reach (mpm plan)");
  r->scene.add_to(command, false, deck);
  command
      .add_option("--pair", r->pairs,
          "a:b or a:wall (rigid), names of materials or particles; several; default: every pair of\n"
          "materials")
      .list();
  add_range_options(command, r->file);
  add_shape_options(command, r->file.shapes);
  command.add_flag("--no-atlas", r->no_atlas, "compute every law by the solver");
  r->farm.add_to(command);
  command.add_option("-o,--output", r->output, "law file, NAME.h5").required();
  command.callback([r, command] {
    if (r->deck.empty())
      make_table(*r);
    else
      make_table_for_deck(*r, command);
  });
}

}  // namespace of_table

extern const Command table_command{"table",
    "Makes the contact laws of a materials file, one law file for LIGGGHTS. A homogeneous sphere that hardens\n"
    "linearly or not at all comes from the atlas at once (--no-atlas: computed anew). Other hardening laws,\n"
    "rate dependence, layers, inclusions and profiles are computed by the solver: name the particle in\n"
    "--pair.\n"
    "A particle with a shape in three dimensions gets its material's law, for the radius of curvature at the\n"
    "contact, and a certificate.\n"
    "Finished runs are stored in a folder (--cache). A stopped build goes on where it stopped, and one with a\n"
    "wider range reuses them. The folder may be removed at any time.\n"
    "mpirun -np N mpm table ... shares the runs among N processes; the law is the same.\n"
    "Example: mpm table materials.toml --pair powder:powder --pair powder:wall -o law.h5",
    of_table::define, true};

}  // namespace granulaw
