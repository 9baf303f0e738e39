// mpm convert: a deck of another contact model becomes one of model mpm, with its law.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "characterise/file/make_law_file.hpp"
#include "command.hpp"
#include "deck/convert/folder.hpp"
#include "deck/convert/page.hpp"
#include "deck/material_names.hpp"
#include "deck/scene.hpp"
#include "deck_options.hpp"
#include "farm_options.hpp"
#include "json_output.hpp"
#include "law/law_file.hpp"
#include "law/pair_names.hpp"
#include "law/range.hpp"
#include "material_file/materials_file.hpp"
#include "own_files.hpp"

namespace granulaw {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct ConvertRequest
{
  std::string deck, folder;
  DeckOptions options;
  bool no_stretch = false, accept_defaults = false, check = false, json = false;
};

/// Plans with the answers that were given. Throws Unanswered where one is missing.
PlannedDeck plan_with_answers(const deck::Scene& scene, ConvertRequest& r, std::vector<std::string>& accepted)
{
  constexpr int rounds = 4;  // an answer may bring another question
  for (int k = 0;; ++k) {
    PlannedDeck planned = plan_scene(scene, r.options);
    const std::vector<deck::Question> open = deck::open_questions(planned.plan);
    if (open.empty()) return planned;
    bool answered = r.accept_defaults && k < rounds;
    for (const deck::Question& q : open) {
      const deck::DefaultAnswer by_deck = deck::default_answer(scene, planned.plan, q.option);
      double& answer = q.option.starts_with("--speed") ? r.options.speed : r.options.drop_height;
      if (!(by_deck.value > 0) || answer > 0) answered = false;
      if (!answered) break;
      answer = by_deck.value;
      accepted.push_back(fmt::format("{}: {} {:.3g}, {}", q.what, q.option.substr(0, q.option.find(' ')), by_deck.value, by_deck.reason));
    }
    if (!answered) throw deck::Unanswered(deck::question_sentence(scene, planned.plan, open));
  }
}

void write_law_of(deck::Converted& c, const MaterialsFile& file)
{
  const std::optional<Atlas> atlas = own_atlas();
  LawFileRequest request;
  request.materials = file;
  request.atlas = atlas ? &*atlas : nullptr;
  c.law_pairs = c.planned.plan.law_pairs;
  for (const std::string& pair : c.law_pairs) request.pairs.push_back(new_pair(pair));
  if (request.pairs.empty()) return;
  const deck::PairSizes sizes = deck::pair_sizes(c.planned.plan);
  request.radius_ratio = sizes.radius_ratio;
  request.thick_walls = sizes.thick_walls;
  request.depth = deepest_law, request.damage_number = fastest_law;  // of the atlas: as far as laws go, at no cost
  LawFilePlan plan = plan_law_file(request);
  if (plan.needs_runs()) {
    request.depth = std::max(shallowest_table, c.planned.plan.depth);
    request.damage_number = c.planned.plan.damage_number;
    plan = plan_law_file(request);
  }
  const std::unique_ptr<Farm> farm = plan.needs_runs() ? FarmOptions{}.farm() : nullptr;
  MadeLawFile made = make_law_file(plan, farm.get());
  made.law.provenance["command"] = command_line;
  deck::note_plan(made.law, c.planned.plan, c.deck.filename().string());
  write_law(made.law, (c.folder / c.conversion.law).string());
}

deck::Destination choose_folder(const ConvertRequest& r, const deck::Scene& scene)
{
  fs::path folder = r.folder.empty() ? fs::path(fs::path(r.deck).filename().string() + ".mpm") : fs::path(r.folder);
  std::error_code ignored;
  const fs::path of_deck = fs::path(r.deck).parent_path().empty() ? fs::path(".") : fs::path(r.deck).parent_path();
  if (fs::equivalent(folder, of_deck, ignored)) fail("-o", "this is the deck's own folder: the original would be lost", folder.string());
  if (fs::exists(folder) && !fs::is_directory(folder)) fail("-o", "is no folder", folder.string());
  return deck::open_destination(scene, folder);
}

/// s, of all runs.
double duration(const deck::Scene& scene)
{
  double sum = 0;
  for (const deck::Run& run : scene.runs) sum += run.steps * run.time_step;
  return sum;
}

/// To 2 %: counts are rounded.
bool lasts_as_long(const deck::Scene& now, const deck::Scene& before) { return std::abs(duration(now) - duration(before)) <= 0.02 * duration(before); }

/// All runs of one line of a deck: those of a loop together.
struct RunsOfLine
{
  std::string where;
  double time = 0, steps = 0;  ///< of all passes; s
  int passes = 0;
};

/// In the order in which the lines run first.
std::vector<RunsOfLine> runs_by_line(const deck::Scene& scene)
{
  std::vector<RunsOfLine> lines;
  for (const deck::Run& run : scene.runs) {
    auto line = std::find_if(lines.begin(), lines.end(), [&](const RunsOfLine& l) { return l.where == run.where; });
    if (line == lines.end()) line = lines.insert(line, {run.where});
    line->time += run.steps * run.time_step, line->steps += run.steps, ++line->passes;
  }
  return lines;
}

/// Runs that last another time than the original's, and insertions that bring in other numbers. One run of a single step starts something: it stays one.
void compare_runs(deck::Converted& c, const deck::Scene& now)
{
  const deck::Scene& original = c.planned.scene;
  const double brought = original.count(), brings = now.count();
  if (std::abs(brings - brought) > 0.01 * brought + 1)
    c.result.left.push_back(fmt::format("the insertions bring in {:.0f} particles, {:.0f} in the original", brings, brought));
  if (!lasts_as_long(now, original)) c.result.left.push_back(fmt::format("the runs last {:.4g} s in all, {:.4g} s in the original", duration(now), duration(original)));
  std::vector<std::string> told;
  const auto compare = [&](const std::string& where, double was, double is, double steps) {
    if (std::abs(is / was - 1) < 0.01 + 2 / steps) return;
    const std::string text = fmt::format("{}: lasts {:.4g} s, {:.4g} s in the original", where, is, was);
    if (std::find(told.begin(), told.end(), text) == told.end()) told.push_back(text);
  };
  const std::vector<RunsOfLine> before = runs_by_line(original), after = runs_by_line(now);
  if (before.size() != after.size()) told.push_back(fmt::format("{} lines of the converted deck run, {} of the original", after.size(), before.size()));
  for (std::size_t k = 0; before.size() == after.size() && k < before.size(); ++k)
    if (before[k].steps > 1) compare(before[k].where, before[k].time, after[k].time, after[k].steps);
  if (original.runs.size() == now.runs.size() && told.empty())  // lines that differ in single passes only
    for (std::size_t k = 0; k < now.runs.size(); ++k) {
      const deck::Run &was = original.runs[k], &is = now.runs[k];
      if (was.steps > 1) compare(was.where, was.steps * was.time_step, is.steps * is.time_step, is.steps);
    }
  c.result.left.insert(c.result.left.end(), told.begin(), told.end());
}

/// The deck by the choices made, with its includes, as LIGGGHTS reads it. Variables follow the time step, unless more than counts of steps
/// would follow, the runs would last another time, or LIGGGHTS refuses the deck.
deck::Scene write_deck(deck::Converted& c)
{
  const deck::Scene& scene = c.planned.scene;
  const auto write = [&](bool follow) -> std::optional<deck::Scene> {
    c.conversion.variables_follow = follow;
    c.result = deck::convert(scene, c.conversion);
    if (follow && c.result.more_follows) return {};
    deck::write_files(scene, c.folder, c.result.files);
    return deck::read_scene(c.deck.string(), scene.presets, false);
  };
  if (c.conversion.step_factor == 1) return *write(false);
  try {
    auto now = write(true);
    if (now && (!c.result.followed || lasts_as_long(*now, scene))) return *std::move(now);
  } catch (const Error&) {
  }
  return *write(false);
}

deck::Converted convert(ConvertRequest& r)
{
  deck::Converted c;
  const MaterialsFile file = read_materials(r.options.materials_file);
  const deck::Presets presets = r.options.presets();
  deck::Scene scene = deck::read_scene(r.deck, presets);
  std::vector<std::string> known = names_of(file.materials);
  for (const std::string& name : names_of(file.particles)) known.push_back(name);
  r.options.materials = scene.material_names = deck::names_of_types(scene, r.options.materials, file.source, known);
  scene.stretch = 1;
  deck::require_contact_model(scene);
  c.planned = plan_with_answers(scene, r, c.accepted);
  c.conversion.materials = scene.material_names;
  c.step = deck::choose_time_step(c.conversion, c.planned, !r.no_stretch);
  deck::choose_moduli(c.conversion, c.planned, known);
  c.destination = choose_folder(r, scene);
  c.folder = c.destination.folder;
  c.conversion.law = c.destination.law;
  c.deck = c.folder / fs::path(r.deck).filename();
  c.restarts = deck::copy_data(scene, c.destination);
  deck::Scene now = write_deck(c);
  if (now.restart_stretch && std::abs(*now.restart_stretch / c.conversion.stretch - 1) > 1e-6) {
    c.step = deck::continue_stretch(c.conversion, c.planned, *now.restart_stretch);
    now = write_deck(c);
  }
  deck::require_shared_files(c.destination);
  for (const deck::OtherDensity& other : deck::other_densities(scene, c.planned.options))
    c.result.left.push_back(fmt::format("atom type {} ('{}'): {}", other.type, other.name, other.sentence()));
  if (c.planned.plan.pressing.needs_confinement() && scene.confinement.empty())
    c.result.left.push_back("the deck presses its bed " + deck::pressing_text(c.planned.plan.pressing, ""));
  for (const std::string& sentence : deck::beyond_laws(c.planned.plan)) c.result.left.push_back(sentence);
  write_law_of(c, file);
  compare_runs(c, now);
  return c;
}

ordered_json state_json(const deck::ShortRun& run)
{
  if (!run.ended) return {{"ended", false}, {"sentence", printable(deck::complaint(run.said))}};
  return {{"ended", true}, {"steps", run.steps}, {"time", json_number(run.time)}, {"particles", run.particles}, {"kinetic_energy", json_number(run.kinetic_energy)}};
}

ordered_json to_json(const deck::Converted& c, const ConvertRequest& r)
{
  ordered_json changes = ordered_json::array();
  for (const deck::Change& change : c.result.changes)
    changes.push_back({{"where", printable(change.where)}, {"before", printable(change.before)}, {"after", printable(change.after)}, {"why", printable(change.why)}});
  ordered_json root;
  root["deck"] = printable(r.deck);
  root["folder"] = printable(c.folder.string());
  root["converted_deck"] = printable(c.deck.string());
  root["law"] = printable((c.folder / c.conversion.law).string());
  root["pairs"] = c.law_pairs;
  root["materials"] = c.conversion.materials;
  root["time_step_s"] = {{"deck", json_number(c.step.deck_step)}, {"converted", json_number(c.step.deck_step / c.conversion.step_factor)}};
  root["stretch"] = c.conversion.stretch;
  root["steps_factor"] = c.conversion.step_factor;
  root["taken_from_deck"] = c.accepted;
  root["changes"] = changes;
  root["not_converted"] = c.result.left;
  root["not_followed"] = c.planned.scene.notes;
  if (c.checked)
    root["check"] = {{"original", state_json(c.checked->before)}, {"converted", state_json(c.checked->after)}, {"files_missing", c.checked->files_missing},
        {"files_new", c.checked->files_new}};
  return root;
}

void print(const deck::Converted& c)
{
  fmt::print("wrote {}, {}, {}\n", c.deck.string(), (c.folder / c.conversion.law).string(), (c.folder / c.destination.page).string());
  fmt::print("materials: {}\n", fmt::join(c.conversion.materials, ", "));
  fmt::print("time step: {}\n", printable(deck::time_step_line(c)));
  if (const std::string line = deck::tangential_line(c); !line.empty()) fmt::print("tangential law: {}\n", printable(line));
  fmt::print("{} lines changed\n", c.result.changes.size());
  for (const std::string& left : c.result.left) fmt::print("not converted: {}\n", printable(left));
  if (c.checked)
    for (const std::string& line : deck::check_lines(*c.checked)) fmt::print("{}\n", printable(line));
  fmt::print("{}\n", printable(deck::run_line(c)));
}

void carry_out(ConvertRequest& r)
{
  deck::Converted c = convert(r);
  if (r.check) c.checked = deck::check(c.planned.scene, c.folder, c.conversion.step_factor);
  write_text_atomically((c.folder / c.destination.page).string(), deck::page(c, command_line));
  if (r.json)
    print_json(to_json(c, r));
  else
    print(c);
  if (c.checked && c.checked->before.ended && !c.checked->after.ended)
    fail(c.deck.string(), "the check of the converted deck: " + deck::complaint(c.checked->after.said));
}

void define(Options& command)
{
  const auto r = std::make_shared<ConvertRequest>();
  command.add_option("DECK", r->deck, "LIGGGHTS input script, of any normal model").required();
  r->options.add_to(command, true);
  command.get_option("--materials-file").required();
  command.get_option("--materials")
      .description(
          "NAME,NAME,... or NAME NAME ...: one for each atom type. A name that the materials file lacks stands for a rigid wall's\n"
          "material (default: the deck's own, or the only one of the file)");
  command.add_option("-o,--output", r->folder, "folder to write (default: DECK.mpm, here)");
  command.add_flag("--no-stretch", r->no_stretch, "real contacts: the time step follows from them");
  command.add_flag("--accept-defaults", r->accept_defaults, "answer what the deck does not say by the defaults from the deck");
  command.add_flag("--check", r->check,
      "run 300 steps of the original and as much time of the converted deck, without writing their files, and compare particles,\n"
      "kinetic energy and files. Exit code 1: only the converted deck stops");
  command.add_flag("--json", r->json, "as JSON");
  command.callback([r] { carry_out(*r); });
}

}  // namespace

extern const Command convert_command{"convert",
    "Makes a deck of model mpm, with its law, from one of another model (hertz, hooke,\n"
    "hooke/stiffness, hooke/hysteresis, ...). The original is not touched. It writes FOLDER/DECK with its\n"
    "includes and the files it reads, FOLDER/law.h5, and FOLDER/conversion.md. The last has each changed line with\n"
    "its reason, and the lines that could not be converted. The particles get the real moduli of the materials file.\n"
    "The law is stretched as far as the limits of mpm stretch allow, so that the time step is near the deck's. If it\n"
    "must be shorter, all counts of steps grow with it (docs/guide/convert-hertz.md).\n"
    "Exit code 3: a number is needed that the deck does not say; the sentence names the option, with a default\n"
    "from the deck.\n"
    "Example: mpm convert in.hopper --materials-file materials.toml --materials bead,steel -o hopper-mpm",
    define};

}  // namespace granulaw
