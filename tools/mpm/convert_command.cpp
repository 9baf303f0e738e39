// mpm convert: a deck of another contact model becomes one of model mpm, with its law.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <set>

#include "atlas_path.hpp"
#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "characterise/file/make_law_file.hpp"
#include "command.hpp"
#include "deck/convert/convert.hpp"
#include "deck/launcher.hpp"
#include "deck/soften.hpp"
#include "deck_options.hpp"
#include "farm_options.hpp"
#include "json_output.hpp"
#include "law/law_file.hpp"
#include "law/pair_names.hpp"
#include "material_file/materials_file.hpp"

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

/// Some hundred steps of original and converted deck.
struct Checked
{
  deck::ShortRun before, after;
  std::vector<std::string> files_missing, files_new;  ///< written by one of them alone
};

/// A conversion and its result.
struct Converted
{
  PlannedDeck planned;
  deck::Conversion conversion;
  deck::ConvertedDeck result;
  fs::path folder, deck;
  double deck_step = 0;                 ///< s; 0: nothing moves
  std::string bound;                    ///< what the stretch is bound by
  std::vector<std::string> law_pairs, accepted, restarts;
  std::optional<Checked> checked;
};

// ------------------------------------------------------------------ materials

std::set<int> particle_types(const deck::Scene& scene)
{
  std::set<int> types;
  for (const deck::Source& s : scene.sources) types.insert(s.type);
  if (types.empty()) types.insert(1);
  return types;
}

std::string describe_type(const deck::Scene& scene, int type)
{
  std::string text = fmt::format("type {}", type);
  for (const deck::Source& s : scene.sources)
    if (s.type == type && s.radius_max > 0) {
      text += fmt::format(" (R {:.3g} m, {:.4g} kg/m^3)", s.radius_max, s.density);
      break;
    }
  return text;
}

/// One name for each atom type: as given, as the deck has them, or the one material of the file.
std::vector<std::string> names_of_types(const deck::Scene& scene, const DeckOptions& o, const MaterialsFile& file)
{
  const auto types = static_cast<std::size_t>(std::max(1, scene.types));
  if (!o.materials.empty()) {
    if (o.materials.size() != types)
      fail("--materials", fmt::format("{} has {} atom types, each needs one name", scene.deck, types),
           fmt::format("{}", fmt::join(o.materials, ",")));
    return o.materials;
  }
  if (scene.material_names.size() == types) return scene.material_names;
  const std::set<int> of_particles = particle_types(scene);
  if (file.materials.size() + file.particles.size() != 1) {
    std::vector<std::string> asked;
    for (const int type : of_particles) asked.push_back(describe_type(scene, type));
    std::vector<std::string> known = names_of(file.materials);
    for (const std::string& name : names_of(file.particles)) known.push_back(name);
    throw deck::Unanswered(printable(fmt::format(
        "{}: which material of {} ({}) is {}? Give one name for each of the {} atom types by --materials NAME,NAME,...", scene.deck,
        file.source, fmt::join(known, ", "), fmt::join(asked, ", "), types)));
  }
  const std::string only = file.materials.empty() ? file.particles.begin()->first : file.materials.begin()->first;
  std::vector<std::string> names;
  for (std::size_t t = 1; t <= types; ++t)
    names.push_back(of_particles.contains(static_cast<int>(t)) ? only : fmt::format("wall{}", t));
  return names;
}

// ------------------------------------------------------------------ questions

/// m, of the deck's box along gravity; its longest side where there is none.
double box_height(const deck::Scene& scene)
{
  if (scene.domain.empty()) return 0;
  const deck::Vec3 size = scene.domain.size();
  const double g = deck::norm(scene.gravity);
  if (!(g > 0)) return std::max({size[0], size[1], size[2]});
  double height = 0;
  for (std::size_t k = 0; k < 3; ++k) height += std::abs(scene.gravity[k]) / g * size[k];
  return height;
}

/// A number from the deck, and where it comes from; 0: there is none.
struct DefaultAnswer
{
  double value = 0;
  std::string reason;
};

DefaultAnswer default_answer(const deck::Scene& scene, const std::string& option)
{
  const double height = box_height(scene), g = deck::norm(scene.gravity);
  if (option.starts_with("--drop-height")) return {height, "the height of the deck's box"};
  if (option.starts_with("--speed")) {
    double walls = 0, start = 0;
    for (const deck::Wall& w : scene.walls) walls = std::max({walls, w.speed, w.drag_speed});
    for (const deck::Source& s : scene.sources) start = std::max(start, s.speed);
    const double speed = start + 2 * walls + std::sqrt(2 * g * height);
    return {speed > 0 ? speed : 1.0, g > 0 ? "a fall through the deck's box, with its fastest wall" : "its fastest wall or particle"};
  }
  return {};
}

bool matters(const deck::Question& question)
{
  return question.option != "--particles N";
}

std::string question_sentence(const deck::Scene& scene, const std::vector<deck::Question>& questions)
{
  std::string text;
  for (const deck::Question& q : questions) {
    if (!matters(q)) continue;
    const std::string name = q.option.substr(0, q.option.find(' '));
    const DefaultAnswer by_deck = default_answer(scene, q.option);
    text += fmt::format("{}not in the deck: {}: give it by {}{}", text.empty() ? "" : "; ", q.what, q.option,
                        by_deck.value > 0 ? fmt::format(" ({} {:.3g}: {})", name, by_deck.value, by_deck.reason) : "");
  }
  return printable(fmt::format("{}: {}", scene.deck, text));
}

/// Plans with the answers that were given. Throws Unanswered where one is missing.
PlannedDeck plan_with_answers(const deck::Scene& scene, ConvertRequest& r, std::vector<std::string>& accepted)
{
  constexpr int rounds = 4;  // an answer may bring another question
  for (int k = 0;; ++k) {
    PlannedDeck planned = plan_scene(scene, r.options);
    std::vector<deck::Question> open;
    std::copy_if(planned.plan.questions.begin(), planned.plan.questions.end(), std::back_inserter(open), matters);
    if (open.empty()) return planned;
    bool answered = r.accept_defaults && k < rounds;
    for (const deck::Question& q : open) {
      const DefaultAnswer by_deck = default_answer(scene, q.option);
      double& answer = q.option.starts_with("--speed") ? r.options.speed : r.options.drop_height;
      if (!(by_deck.value > 0) || answer > 0) answered = false;
      if (!answered) break;
      answer = by_deck.value;
      accepted.push_back(fmt::format("{}: {} {:.3g}, {}", q.what, q.option.substr(0, q.option.find(' ')), by_deck.value,
                                     by_deck.reason));
    }
    if (!answered) throw deck::Unanswered(question_sentence(scene, open));
  }
}

// ------------------------------------------------------------------ law

/// Pairs of the particles with each other and with the walls; like pairs and the rigid wall always.
std::vector<PairNames> law_pairs(const PlannedDeck& d, const MaterialsFile& file)
{
  std::set<std::string> names;
  std::set<PairNames> pairs;
  const std::vector<std::string>& of_types = d.scene.material_names;
  const auto known = [&](const std::string& name) { return file.materials.contains(name) || file.particles.contains(name); };
  for (const int type : particle_types(d.scene))
    if (const std::string& name = of_types[static_cast<std::size_t>(type) - 1]; known(name)) names.insert(name);
  std::set<std::string> bodies = names;
  for (const deck::Wall& w : d.scene.walls)
    if (w.deformable && known(of_types[static_cast<std::size_t>(w.type) - 1]))
      bodies.insert(of_types[static_cast<std::size_t>(w.type) - 1]);
  for (const std::string& a : names) {
    pairs.insert({a, wall_name});
    for (const std::string& b : bodies)
      if (!pairs.contains({b, a})) pairs.insert({a, b});
  }
  return {pairs.begin(), pairs.end()};
}

void write_law_of(Converted& c, const MaterialsFile& file)
{
  const std::optional<Atlas> atlas = own_atlas();
  LawFileRequest request;
  request.materials = file;
  request.atlas = atlas ? &*atlas : nullptr;
  for (const PairNames& pair : law_pairs(c.planned, file)) {
    request.pairs.push_back(pair);
    c.law_pairs.push_back(pair.first + ":" + pair.second);
  }
  if (request.pairs.empty()) return;
  const deck::PairSizes sizes = deck::pair_sizes(c.planned.plan);
  request.radius_ratio = sizes.radius_ratio;
  request.thick_walls = sizes.thick_walls;
  if (sizes.thick_walls) request.rule_radius_ratio = deck::largest_radius_ratio;
  request.depth = 0.5, request.damage_number = 0.09;  // of the atlas: as far as laws go, at no cost
  LawFilePlan plan = plan_law_file(request);
  if (plan.needs_runs()) {
    request.depth = std::max(0.05, c.planned.plan.depth);
    request.damage_number = c.planned.plan.damage_number;
    plan = plan_law_file(request);
  }
  const std::unique_ptr<Farm> farm = plan.needs_runs() ? FarmOptions{}.farm() : nullptr;
  MadeLawFile made = make_law_file(plan, farm.get());
  made.law.provenance["command"] = command_line;
  write_law(made.law, (c.folder / c.conversion.law).string());
}

// ------------------------------------------------------------------ files

bool leaves_folder(const std::string& path)
{
  const std::string normal = fs::path(path).lexically_normal().string();
  return normal.starts_with("..");
}

/// The name of a file of commands in the folder of the converted deck.
fs::path name_in_folder(const deck::Scene& scene, const std::string& path)
{
  const bool is_main = fs::path(path).lexically_normal() == fs::path(main_file(scene)).lexically_normal();
  if (is_main || path.starts_with('/') || leaves_folder(path)) return fs::path(path).filename();
  return fs::path(path).lexically_normal();
}

void write_files(const deck::Scene& scene, const fs::path& folder, const std::map<std::string, std::string>& files)
{
  for (const auto& [path, text] : files) {
    const fs::path to = folder / name_in_folder(scene, path);
    fs::create_directories(to.parent_path());
    write_text_atomically(to.string(), text);
  }
}

bool is_restart(const deck::Scene& scene, const std::string& path)
{
  return std::any_of(scene.commands.begin(), scene.commands.end(), [&](const deck::DeckCommand& c) {
    return c.words.size() > 1 && c.words[0] == "read_restart" && c.words[1] == path;
  });
}

/// Files that the deck reads, beside the converted deck; folders that it writes into.
void copy_data(Converted& c)
{
  const deck::Scene& scene = c.planned.scene;
  std::set<std::string> commands;
  for (const deck::DeckCommand& command : scene.commands) commands.insert(command.file);
  for (const std::string& path : scene.files_read) {
    if (path.starts_with('/') || commands.contains(path)) continue;
    const fs::path from = path_of(scene, path);
    std::error_code ignored;
    if (!fs::is_regular_file(from, ignored)) continue;
    if (leaves_folder(path)) {
      c.conversion.paths[path] = fs::weakly_canonical(from).string();
      continue;
    }
    const fs::path to = c.folder / path;
    const bool restart = is_restart(scene, path);
    if (restart && fs::exists(to)) continue;  // of the deck before, converted
    if (restart) c.restarts.push_back(path);
    fs::create_directories(to.parent_path());
    fs::copy_file(from, to, fs::copy_options::overwrite_existing);
  }
  const auto make_folder_of = [&](const std::string& path, bool if_there) {
    const fs::path parent = fs::path(path).parent_path();
    if (parent.empty() || path.starts_with('/') || leaves_folder(path)) return;
    std::error_code ignored;
    if (!if_there || fs::is_directory(path_of(scene, parent.string()), ignored))
      fs::create_directories(c.folder / parent, ignored);
  };
  for (const std::string& path : scene.files_written) make_folder_of(path, false);
  for (const deck::DeckCommand& command : scene.commands)
    for (const std::string& word : command.words)
      if (word.find('/') != std::string::npos) make_folder_of(word, true);
}

// ------------------------------------------------------------------ time step

double two_digits_up(double x)
{
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1);
  return std::stod(fmt::format("{:.2g}", std::ceil(x / unit * (1 - 1e-12)) * unit));
}

/// Stretch and time step: the deck's own where the limits of mpm soften allow it.
void choose_time_step(Converted& c, bool may_stretch)
{
  const PlannedDeck& d = c.planned;
  c.deck_step = deck::largest_time_step(d.scene);
  const double allowed = d.plan.time_step / d.scene.stretch;
  if (!(c.deck_step > 0) || !(allowed > 0) || allowed >= c.deck_step) return;
  if (!may_stretch || !deck::may_be_stretched(d.scene)) {
    c.bound = may_stretch ? "liquid bridges and heat, which have no form for a stretched law" : "--no-stretch";
  } else {
    const deck::Softening s = deck::soften(d.scene, d.plan, d.options, {});
    c.conversion.stretch = std::clamp(two_digits_up(c.deck_step / allowed), 1.0, s.stretch);
    c.bound = s.bound;
  }
  const double step = c.conversion.stretch * allowed;
  if (step < c.deck_step) c.conversion.step_factor = two_digits_up(c.deck_step / step);
}

/// Moduli as the law has them; those of rigid walls, which serve friction alone, rise with the particles'.
void choose_moduli(Converted& c, const MaterialsFile& file)
{
  const PlannedDeck& d = c.planned;
  const std::set<int> of_particles = particle_types(d.scene);
  double rise = 1;
  for (int type = 1; type <= d.scene.types; ++type) {
    const auto m = d.options.materials.find(type);
    if (m == d.options.materials.end() || !(m->second.youngs_modulus > 0)) continue;
    const std::string& name = d.scene.material_names[static_cast<std::size_t>(type) - 1];
    if (!file.materials.contains(name) && !file.particles.contains(name)) continue;
    c.conversion.youngs_modulus[type] = m->second.youngs_modulus;
    c.conversion.poisson_ratio[type] = m->second.poisson_ratio;
    const auto of_deck = d.scene.materials.find(type);
    if (of_particles.contains(type) && of_deck != d.scene.materials.end() && of_deck->second.youngs_modulus)
      rise = std::max(rise, m->second.youngs_modulus / *of_deck->second.youngs_modulus);
  }
  for (int type = 1; type <= d.scene.types; ++type) {
    if (c.conversion.youngs_modulus.contains(type)) continue;
    const auto of_deck = d.scene.materials.find(type);
    if (of_deck != d.scene.materials.end() && of_deck->second.youngs_modulus)
      c.conversion.youngs_modulus[type] = std::min(*of_deck->second.youngs_modulus * rise, 1e12);
  }
}

// ------------------------------------------------------------------ conversion

/// As liggghts -var takes them.
deck::Presets presets_of(const DeckOptions& o)
{
  deck::Presets presets;
  for (std::size_t k = 0; k + 1 < o.variables.size(); k += 2) presets.push_back({o.variables[k], {o.variables[k + 1]}});
  return presets;
}

fs::path choose_folder(const ConvertRequest& r)
{
  fs::path folder = r.folder.empty() ? fs::path(fs::path(r.deck).filename().string() + ".mpm") : fs::path(r.folder);
  std::error_code ignored;
  const fs::path of_deck = fs::path(r.deck).parent_path().empty() ? fs::path(".") : fs::path(r.deck).parent_path();
  if (fs::equivalent(folder, of_deck, ignored))
    fail("-o", "this is the deck's own folder: the original would be lost", folder.string());
  if (fs::exists(folder) && !fs::is_directory(folder)) fail("-o", "is no folder", folder.string());
  fs::create_directories(folder);
  return folder;
}

/// Runs that last another time than the original's.
void compare_times(Converted& c, const deck::Scene& now)
{
  const std::vector<deck::Run>&before = c.planned.scene.runs, &after = now.runs;
  if (before.size() != after.size()) {
    c.result.left.push_back(fmt::format("the converted deck has {} runs, the original {}", after.size(), before.size()));
    return;
  }
  std::set<std::string> told;
  for (std::size_t k = 0; k < before.size(); ++k) {
    const double was = before[k].steps * before[k].time_step, is = after[k].steps * after[k].time_step;
    if (before[k].steps <= 1 || std::abs(is / was - 1) < 0.01 + 2 / after[k].steps) continue;
    const std::string text = fmt::format("{}: lasts {:.4g} s, {:.4g} s in the original", before[k].where, is, was);
    if (told.insert(text).second) c.result.left.push_back(text);
  }
}

Converted convert(ConvertRequest& r)
{
  Converted c;
  const MaterialsFile file = read_materials(r.options.materials_file);
  const deck::Presets presets = presets_of(r.options);
  deck::Scene scene = deck::read_scene(r.deck, presets);
  r.options.materials = scene.material_names = names_of_types(scene, r.options, file);
  scene.stretch = 1;
  deck::require_contact_model(scene);
  c.planned = plan_with_answers(scene, r, c.accepted);
  c.conversion.materials = scene.material_names;
  choose_time_step(c, !r.no_stretch);
  choose_moduli(c, file);
  c.folder = choose_folder(r);
  c.deck = c.folder / fs::path(r.deck).filename();
  copy_data(c);
  std::optional<deck::Scene> probe;
  if (const auto files = deck::probe_deck(scene, c.conversion); !files.empty()) {
    write_files(scene, c.folder, files);
    probe = deck::read_scene(c.deck.string(), presets);
    // its files stand under other names only where the deck is not in the folder from which LIGGGHTS reads it
    for (deck::DeckCommand& command : probe->commands)
      for (const auto& [path, text] : files)
        if (name_in_folder(scene, path) == command.file) {
          command.file = path;
          break;
        }
  }
  c.result = deck::convert(scene, c.conversion, probe ? &*probe : nullptr);
  write_law_of(c, file);
  write_files(scene, c.folder, c.result.files);
  compare_times(c, deck::read_scene(c.deck.string(), presets));
  return c;
}

// ------------------------------------------------------------------ check

/// A folder that is removed in the end.
class Scratch
{
 public:
  explicit Scratch(const fs::path& folder) : path_(folder) { fs::create_directories(path_); }
  ~Scratch()
  {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::set<std::string> files_below(const fs::path& folder)
{
  std::set<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.insert(fs::relative(entry.path(), folder).string());
  return files;
}

/// Names without the number of the step.
std::set<std::string> without_numbers(const std::set<std::string>& files)
{
  std::set<std::string> names;
  for (const std::string& file : files) {
    std::string name;
    for (const char ch : file) {
      const bool digit = ch >= '0' && ch <= '9';
      if (!digit) name += ch;
      else if (name.empty() || name.back() != '*') name += '*';
    }
    names.insert(name);
  }
  return names;
}

struct Trial
{
  deck::ShortRun run;
  std::set<std::string> written;
};

/// Runs a deck in a copy of its data.
Trial try_deck(const fs::path& data, const fs::path& scratch, const std::map<std::string, std::string>& files,
               const deck::Scene& scene, const std::string& name, const deck::Presets& presets, long long steps)
{
  fs::copy(data, scratch, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  write_files(scene, scratch, files);
  const std::set<std::string> before = files_below(scratch);
  Trial trial;
  trial.run = deck::short_run(scratch.string(), deck::words_of(name, presets), steps);
  const std::set<std::string> after = files_below(scratch);
  std::set<std::string> written;
  std::set_difference(after.begin(), after.end(), before.begin(), before.end(), std::inserter(written, written.end()));
  trial.written = without_numbers(written);
  return trial;
}

Checked check(const Converted& c, const deck::Presets& presets)
{
  constexpr long long steps = 300;
  const deck::Scene& scene = c.planned.scene;
  const Scratch scratch(fs::temp_directory_path() / fmt::format("granulaw-check-{}", getpid()));
  const std::string name = c.deck.filename().string();
  const Trial before = try_deck(c.folder, scratch.path() / "original", deck::command_files(scene), scene, name, presets, steps);
  const double done = before.run.ended ? before.run.steps : static_cast<double>(steps);
  const Trial after = try_deck(c.folder, scratch.path() / "converted", {}, scene, name, presets,
                               static_cast<long long>(std::ceil(done * c.conversion.step_factor)));
  Checked result{before.run, after.run, {}, {}};
  std::set_difference(before.written.begin(), before.written.end(), after.written.begin(), after.written.end(),
                      std::back_inserter(result.files_missing));
  std::set_difference(after.written.begin(), after.written.end(), before.written.begin(), before.written.end(),
                      std::back_inserter(result.files_new));
  return result;
}

// ------------------------------------------------------------------ output

std::string state_line(const deck::ShortRun& run)
{
  if (!run.ended) return "stopped: " + deck::complaint(run.said);
  return fmt::format("{:.0f} steps, {:.4g} s, {:.0f} particles, kinetic energy {:.4g}", run.steps, run.time, run.particles, run.kinetic_energy);
}

std::vector<std::string> check_lines(const Checked& checked)
{
  std::vector<std::string> lines{"check, original: " + state_line(checked.before), "check, converted: " + state_line(checked.after)};
  if (!checked.files_missing.empty()) lines.push_back(fmt::format("check: only the original wrote {}", fmt::join(checked.files_missing, ", ")));
  if (!checked.files_new.empty()) lines.push_back(fmt::format("check: only the converted deck wrote {}", fmt::join(checked.files_new, ", ")));
  return lines;
}

ordered_json state_json(const deck::ShortRun& run)
{
  if (!run.ended) return {{"ended", false}, {"sentence", printable(deck::complaint(run.said))}};
  return {{"ended", true}, {"steps", run.steps}, {"time", json_number(run.time)}, {"particles", run.particles}, {"kinetic_energy", json_number(run.kinetic_energy)}};
}

std::string as_code(const std::string& text)
{
  std::string code;
  for (const char ch : printable(text)) code += ch == '|' ? std::string("\\|") : std::string(1, ch);
  return code.empty() ? "" : "`" + code + "`";
}

std::string time_step_line(const Converted& c)
{
  if (!(c.deck_step > 0)) return "nothing moves: the time step stays";
  const double now = c.deck_step / c.conversion.step_factor;
  std::string text = fmt::format("{:.4g} s", c.deck_step);
  if (c.conversion.step_factor > 1) text += fmt::format(" becomes {:.4g} s, every count of steps {:g} times as large", now, c.conversion.step_factor);
  else text += " stays";
  if (c.conversion.stretch > 1) text += fmt::format("; stretch {:g}", c.conversion.stretch);
  if (c.conversion.step_factor > 1 && !c.bound.empty()) text += fmt::format(" (no more by the {})", c.bound);
  return text;
}

std::string run_line(const Converted& c)
{
  return fmt::format("cd {} && liggghts-mpm -in {}", c.folder.string(), c.deck.filename().string());
}

std::string page(const Converted& c, const ConvertRequest& r)
{
  const PlannedDeck& d = c.planned;
  std::string text = fmt::format("# {}, converted to model mpm\n\nMade by `{}`. Run it:\n\n    {}\n\n", r.deck, command_line, run_line(c));
  text += "| | |\n|---|---|\n";
  for (int t = 1; t <= d.scene.types; ++t) {
    const std::string& name = c.conversion.materials[static_cast<std::size_t>(t) - 1];
    const auto young = c.conversion.youngs_modulus.find(t);
    text += fmt::format("| atom type {} | {}{}{} |\n", t, name, d.options.materials.contains(t) ? "" : ", rigid",
                        young == c.conversion.youngs_modulus.end() ? "" : fmt::format(", E {:.4g} Pa", young->second));
  }
  text += fmt::format("| law.h5 | {} |\n", c.law_pairs.empty() ? "none: no particle has a law" : fmt::format("{}", fmt::join(c.law_pairs, ", ")));
  text += fmt::format("| time step | {} |\n", time_step_line(c));
  for (const deck::PairPlan& p : d.plan.pairs)
    text += fmt::format("| {} {}:{} | up to {:.3g} m/s, overlap {:.3g} R*, I {:.3g}; time step {} |\n", types_text(p.meeting), p.meeting.name_a,
                        p.meeting.name_b, p.speed, p.overlap * c.conversion.stretch, p.damage_number,
                        std::isfinite(p.time_step) && p.time_step > 0 ? fmt::format("{:.3g} s, times the stretch", p.time_step) : "any");
  for (const std::string& answer : c.accepted) text += fmt::format("| taken from the deck | {} |\n", answer);
  if (c.checked) {
    text += "\n## Check\n\n";
    for (const std::string& line : check_lines(*c.checked)) text += fmt::format("- {}\n", printable(line));
  }
  text += "\n## Changed lines\n\n| line of the original | before | after | reason |\n|---|---|---|---|\n";
  for (const deck::Change& change : c.result.changes)
    text += fmt::format("| {} | {} | {} | {} |\n", change.where, change.before.empty() ? "(added)" : as_code(change.before),
                        change.after.empty() ? "(removed)" : as_code(change.after), printable(change.why));
  text += "\n## Not converted\n\n";
  for (const std::string& left : c.result.left) text += fmt::format("- {}\n", printable(left));
  for (const std::string& note : d.scene.notes) text += fmt::format("- not followed by the plan: {}\n", printable(note));
  for (const std::string& path : c.restarts)
    text += fmt::format("- {}: a restart file of the original. Its contacts are of another model: convert and run the deck that writes it, "
                        "and put the new file here\n", path);
  if (c.result.left.empty() && d.scene.notes.empty() && c.restarts.empty()) text += "Nothing is left.\n";
  return text;
}

ordered_json to_json(const Converted& c, const ConvertRequest& r)
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
  root["time_step_s"] = {{"deck", json_number(c.deck_step)}, {"converted", json_number(c.deck_step / c.conversion.step_factor)}};
  root["stretch"] = c.conversion.stretch;
  root["steps_factor"] = c.conversion.step_factor;
  root["taken_from_deck"] = c.accepted;
  root["changes"] = changes;
  root["not_converted"] = c.result.left;
  root["not_followed"] = c.planned.scene.notes;
  if (c.checked)
    root["check"] = {{"original", state_json(c.checked->before)}, {"converted", state_json(c.checked->after)},
                     {"files_missing", c.checked->files_missing}, {"files_new", c.checked->files_new}};
  return root;
}

void print(const Converted& c)
{
  fmt::print("wrote {}, {}, {}\n", c.deck.string(), (c.folder / c.conversion.law).string(), (c.folder / "conversion.md").string());
  fmt::print("materials: {}\n", fmt::join(c.conversion.materials, ", "));
  fmt::print("time step: {}\n", printable(time_step_line(c)));
  fmt::print("{} lines changed\n", c.result.changes.size());
  for (const std::string& left : c.result.left) fmt::print("not converted: {}\n", printable(left));
  if (c.checked)
    for (const std::string& line : check_lines(*c.checked)) fmt::print("{}\n", printable(line));
  fmt::print("{}\n", printable(run_line(c)));
}

void carry_out(ConvertRequest& r)
{
  Converted c = convert(r);
  if (r.check) c.checked = check(c, presets_of(r.options));
  write_text_atomically((c.folder / "conversion.md").string(), page(c, r));
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
  command.add_option("DECK", r->deck, "LIGGGHTS input script, of any normal model")->required();
  r->options.add_to(command, true);
  command.get_option("--materials-file")->required();
  command.get_option("--materials")->delimiter(',')->one_word()->description(
      "NAME,NAME,...: one for each atom type. A name that the materials file lacks stands for a rigid wall's\n"
      "material (default: the deck's own, or the only one of the file)");
  command.add_option("-o,--output", r->folder, "folder to write (default: DECK.mpm, here)");
  command.add_flag("--no-stretch", r->no_stretch, "real contacts: the time step follows from them");
  command.add_flag("--accept-defaults", r->accept_defaults, "answer what the deck does not say by the defaults from the deck");
  command.add_flag("--check", r->check,
                   "run 300 steps of the original and as much time of the converted deck, in copies, and compare particles,\n"
                   "kinetic energy and files. Exit code 1: only the converted deck stops");
  command.add_flag("--json", r->json, "as JSON");
  command.callback([r] { carry_out(*r); });
}

}  // namespace

extern const Command convert_command{
    "convert",
    "Makes a deck of model mpm, with its law, from a LIGGGHTS deck of another normal model (hertz, hooke,\n"
    "hooke/stiffness, hooke/hysteresis, ...). The original is not touched. It writes FOLDER/DECK with its\n"
    "includes and the files it reads, FOLDER/law.h5, and FOLDER/conversion.md. The last has each changed line with\n"
    "its reason, and the lines that could not be converted. The particles get the real moduli of the materials file.\n"
    "The law is stretched as far as the limits of mpm soften allow, so that the time step is near the deck's. If it\n"
    "must be shorter, all counts of steps grow with it (docs/guide/convert-hertz.md).\n"
    "Exit code 3: a number is needed that the deck does not say; the sentence names the option, with a default\n"
    "from the deck.\n"
    "Example: mpm convert in.hopper --materials-file materials.toml --materials bead,steel -o hopper-mpm",
    define};

}  // namespace granulaw
