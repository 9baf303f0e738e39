#include "liggghts_plugin/loop/command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "base/error.hpp"
#include "liggghts_plugin/confine/confinement.hpp"
#include "liggghts_plugin/contact/superquadric.hpp"
#include "liggghts_plugin/engine/deck_units.hpp"
#include "liggghts_plugin/engine/fix_style.hpp"
#include "liggghts_plugin/engine/private_members.hpp"
#include "liggghts_plugin/run/contact_history.hpp"
#include "liggghts_plugin/run/contact_list.hpp"
#include "liggghts_plugin/run/fix_step.hpp"
#include "liggghts_plugin/run/heat_conduction.hpp"
#include "liggghts_plugin/run/runaway.hpp"

namespace granulaw::plugin {

GRANULAW_EXPOSE(RestartIds, LAMMPS_NS::Modify, id_restart_global);
GRANULAW_EXPOSE(RestartStates, LAMMPS_NS::Modify, state_restart_global);

namespace {

using Words = std::vector<std::string>;

/// Options that a wall's command leaves open come from the pair style; LIGGGHTS's own words of it go to
/// `rest`.
void inherit(Setup& setup, Words& rest)
{
  Options& options = setup.options;
  const bool own_switch = options.tangential_damping_on.has_value();
  options.inherit(*setup.session->pair_options);
  if (!own_switch && options.tangential_damping_on)
    rest.insert(rest.end(), {"tangential_damping", *options.tangential_damping_on ? "on" : "off"});
}

/// Options that walls and the statistics take from the pair style.
void share_with_session(Setup& setup)
{
  Session& session = *setup.session;
  Options& options = setup.options;
  session.dissipated_energy = options.dissipated_energy;
  options.energy = options.energy || options.dissipated_energy;
  session.pair_options = options;
  session.pair_law = setup.law;
  session.energy = options.energy ? &session.tally : nullptr;
  session.contact_map = options.contact_map;
}

/// Reads our own words; `rest` stays for LIGGGHTS.
void read_setup(LAMMPS_NS::LAMMPS* lmp, const CommandModels& models, Setup& setup, const Words& words,
                Words& rest)
{
  const bool is_wall = setup.wall != nullptr;
  Session& session = *setup.session;
  setup.own = setup.options = parse_options(models.normal, is_wall, setup.where, words, rest);
  if (is_wall && session.pair_options) inherit(setup, rest);
  if (models.read_keywords) models.read_keywords(lmp, setup);
  if (setup.options.dissipated_energy && is_wall && !session.dissipated_energy)
    fail(setup.where, "'computeDissipatedEnergy on' counts walls with the pair style's: say it there");
  if (!is_wall) share_with_session(setup);
  setup.energy = session.energy != nullptr;
  setup.contact_map = session.contact_map;
  if (setup.options.beyond_range == BeyondRange::crush) session.crushes = true;
}

/// Notes the command's models and words, as restart files keep them.
void note_meaning(const CommandModels& models, Setup& setup)
{
  const Options& options = setup.options;
  const auto bit = [](bool said, long bit) { return said ? bit : 0l; };
  setup.meaning = {models.ids.hash() | bit(setup.energy, HistoryMeaning::energy) |
                       bit(setup.contact_map, HistoryMeaning::contact_map) |
                       bit(options.body_compliance.value_or(false), HistoryMeaning::body_compliance) |
                       bit(options.beyond_range == BeyondRange::crush, HistoryMeaning::crush) |
                       bit(says_confinement(options), HistoryMeaning::confinement) |
                       bit(options.deformable_wall, HistoryMeaning::deformable_wall) |
                       bit(options.tangential_computed.value_or(false), HistoryMeaning::computed_stiffness),
                   options.stretch.value_or(1.0)};
  setup.session->meanings[setup.command()] = setup.meaning;
}

/// no_history is a dashpot capped at the Coulomb limit: without the dashpot there is no friction at all.
void refuse_no_friction(const CommandModels& models, const Setup& setup, const Words& rest)
{
  if (models.ids.tangential != cm::TANGENTIAL_NO_HISTORY) return;
  const auto off = std::find(rest.begin(), rest.end(), "tangential_damping");
  if ((off != rest.end() && *(off + 1) == "off") || setup.options.tangential_damping == 0.0)
    fail(setup.where, "'tangential no_history' without tangential damping has no friction at all");
}

/// sjkr and its like, whose pull goes with cohesionEnergyDensity or a liquid: LIGGGHTS's ids end at 12.
bool is_liggghts_cohesion(const ModelIds& ids) { return ids.cohesion != cm::COHESION_OFF && ids.cohesion <= 12; }

/// One and the same deck would have two adhesions.
void refuse_two_cohesions(const Setup& setup)
{
  const auto pair = setup.session->meanings.find(pairs_record);
  if (!setup.wall || pair == setup.session->meanings.end()) return;
  const ModelIds here = ModelIds::of(setup.meaning.combination), there = ModelIds::of(pair->second.combination);
  for (const auto& [one, other] : {std::pair(here, there), std::pair(there, here)})
    if (is_liggghts_cohesion(one) && other.cohesion != cm::COHESION_OFF && !is_liggghts_cohesion(other))
      fail(setup.where, fmt::format("the deck has both '{}' and '{}', between particles and with walls: choose one of them",
                                    describe_pieces({0, 0, here.cohesion, 0, 0}).substr(1), describe_pieces({0, 0, there.cohesion, 0, 0}).substr(1)));
}

void warn_stretched_cohesion(LAMMPS_NS::LAMMPS* lmp, const CommandModels& models, const Setup& setup)
{
  const double s = setup.options.stretch.value_or(1.0);
  if (!is_liggghts_cohesion(models.ids) || s <= 1.0) return;
  if (!setup.session->first_time("stretched cohesion") || lmp->comm->me != 0) return;
  lmp->error->warning(
      FLERR,
      fmt::format("{}: 'stretch {:g}' does not reach into the cohesion model: cohesionEnergyDensity must "
                  "be the real one divided by {:g}, the square of the factor",
                  setup.where, s, s * s)
          .c_str());
}

/// Cohesion pulls in proportion to the area of contact, and so does plastic flow push: 2.8 Y.
void warn_strong_cohesion(LAMMPS_NS::LAMMPS* lmp, const Setup& setup)
{
  if (setup.wall || !setup.law || !is_liggghts_cohesion(ModelIds::of(setup.meaning.combination))) return;
  const int types = lmp->atom->ntypes;
  LAMMPS_NS::Fix* density = lmp->modify->find_fix_property("cohesionEnergyDensity", "property/global", "peratomtypepair",
                                                           types, types, setup.where.c_str(), false);
  const auto& names = setup.options.own_words("materials");
  if (!density || static_cast<int>(names.size()) != types) return;
  const double s = setup.options.stretch.value_or(1.0), unit = DeckUnits::of(lmp->update->unit_style, setup.where).pressure();
  const auto pressure_of = [&](int type) {
    const auto found = setup.law->law.bodies.find(names[static_cast<std::size_t>(type)]);
    return found == setup.law->law.bodies.end() ? std::numeric_limits<double>::infinity()
                                                : 2.8 * found->second.material.yield_stress;
  };
  for (int i = 0; i < types; ++i)
    for (int j = i; j < types; ++j) {
      const double pull = s * s * density->compute_array(i, j) * unit, push = std::min(pressure_of(i), pressure_of(j));
      if (!(pull > 0.5 * push) || !setup.session->first_time("strong cohesion") || lmp->comm->me != 0) continue;
      lmp->error->warning(
          FLERR, fmt::format("{}: cohesionEnergyDensity of types {} and {} is {:.4g} Pa, more than half of the contact "
                             "pressure of yield, 2.8 Y = {:.4g} Pa: cohesion pulls the particles into each other; where "
                             "the modulus is lowered for the time step, give the real one and its yield stress",
                             setup.where, i + 1, j + 1, pull, push)
                     .c_str());
    }
}

/// Mostly one line of two was changed.
void warn_of_other_tangential(LAMMPS_NS::LAMMPS* lmp, const Setup& setup)
{
  const auto pair = setup.session->meanings.find(pairs_record);
  if (!setup.wall || pair == setup.session->meanings.end()) return;
  const auto tangential = [](const HistoryMeaning& meaning) { return ModelIds::of(meaning.combination).tangential; };
  const int at_wall = tangential(setup.meaning), of_pairs = tangential(pair->second);
  if (at_wall == of_pairs || !setup.session->first_time(setup.where + " tangential") || lmp->comm->me != 0) return;
  const auto words = [](int id) {
    const std::string name = describe_pieces({.normal = 0, .tangential = id, .cohesion = 0, .rolling = 0, .surface = 0});
    return name.empty() ? std::string("tangential off") : name.substr(1);
  };
  lmp->error->warning(FLERR, fmt::format("{}: it has '{}' and the pair style '{}': walls and particles turn and slide by different laws",
                                         setup.where, words(at_wall), words(of_pairs))
                                 .c_str());
}

/// A restart file whose contacts keep another number of values. LIGGGHTS refuses it, too, but names no cause.
/// Contacts with meshes it refuses alone.
void refuse_other_histories(LAMMPS_NS::LAMMPS* lmp, const Setup& setup)
{
  auto* pair = dynamic_cast<PairGran*>(lmp->force->pair);
  if (!setup.wall && !pair) return;  // pair_style hybrid
  const std::string history = setup.wall ? std::string("history_") + setup.wall->id : "contacthistory";
  const int values = setup.wall ? setup.wall->dnum() : pair->dnum_pair();
  for (int k = 0; k < lmp->modify->nfix_restart_global; ++k) {
    if (history != (lmp->modify->*exposed(RestartIds{}))[k]) continue;
    double written = 0.0;  // both kinds of fixes write the number first
    std::memcpy(&written, (lmp->modify->*exposed(RestartStates{}))[k], sizeof written);
    if (static_cast<int>(written) != values)
      fail(setup.where,
           "the restart file has another number of values for each contact (other models, keywords or version of the "
           "plug-in); use those",
           std::to_string(static_cast<int>(written)), std::to_string(values));
  }
}

/// The fixes and computes of ours that a deck may name.
void provide_observers(LAMMPS_NS::LAMMPS* lmp)
{
  provide_heat_conduction(lmp);
  provide_contact_list(lmp);
  provide_stats_fix(lmp);
}

/// The fixes that come with our models.
void provide_fixes(LAMMPS_NS::LAMMPS* lmp, const Options& options)
{
  provide_contact_histories(lmp);
  provide_step_fix(lmp);
  provide_observers(lmp);
  provide_runaway_fix(lmp);
  provide_confinement(lmp, options);
}

}  // namespace

CommandStyle::CommandStyle(LAMMPS_NS::LAMMPS* lmp, FixWallGran* wall) : lmp_(lmp) { setup_.wall = wall; }

CommandStyle::~CommandStyle()
{
  if (!setup_.session) return;
  setup_.session->one_size.erase(&setup_);
  const auto own = setup_.session->styles.find(setup_.wall);
  if (own != setup_.session->styles.end() && own->second == this) setup_.session->styles.erase(own);
}

void CommandStyle::read(const CommandModels& models, int nargs, char** args,
                        const std::function<void(int, char**)>& call)
{
  std::optional<UnfinishedFix> unfinished;  // the constructor of a wall's fix is running
  if (setup_.wall) unfinished.emplace(lmp_, setup_.wall);
  setup_.session = Session::of(lmp_);
  setup_.where = setup_.wall ? fmt::format("fix {} wall/gran model {}", setup_.wall->id, models.normal.name)
                             : fmt::format("pair_style gran model {}", models.normal.name);
  // The factory counts the words down but leaves `args` on the last one where nothing is left.
  std::vector<char*> pointers(args, args + std::max(0, nargs));
  Words of_surface, rest;
  if (models.ids.superquadric()) of_surface = take_curvature_words(setup_.where, pointers);
  read_setup(lmp_, models, setup_, Words(pointers.begin(), pointers.end()), rest);
  rest.insert(rest.end(), of_surface.begin(), of_surface.end());
  note_meaning(models, setup_);
  setup_.session->styles[setup_.wall] = this;
  if (!models.read_keywords) {
    DeckUnits::of(lmp_->update->unit_style, setup_.where);
    provide_observers(lmp_);
    return provide_confinement(lmp_, setup_.options);
  }
  refuse_shape(lmp_, setup_, models.ids.superquadric());
  refuse_no_friction(models, setup_, rest);
  warn_stretched_cohesion(lmp_, models, setup_);
  pointers.clear();
  for (std::string& word : rest) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  call(static_cast<int>(rest.size()), pointers.data());
  refuse_other_histories(lmp_, setup_);
  provide_fixes(lmp_, setup_.options);
}

void CommandStyle::plan(const ModelInfo& normal, std::int64_t hash, int nargs, char** args)
{
  guarded(lmp_, [&] { read({normal, nullptr, ModelIds::of(hash)}, nargs, args, {}); });
}

void CommandStyle::begin_run(const std::function<void()>& init)
{
  guarded(lmp_, [&] {
    init();
    check_run(lmp_, setup_);
    check_confinement(lmp_, setup_);
    warn_strong_cohesion(lmp_, setup_);
    warn_of_other_tangential(lmp_, setup_);
    refuse_two_cohesions(setup_);
    if (setup_.wall)
      require_step_fix(lmp_);
    else
      provide_fixes(lmp_, setup_.options);  // the box did not exist when pair_style stood before create_box
  });
}

}  // namespace granulaw::plugin
