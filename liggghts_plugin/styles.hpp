#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "liggghts_plugin/contact_list.hpp"
#include "liggghts_plugin/fix_style.hpp"
#include "liggghts_plugin/heat_conduction.hpp"
#include "liggghts_plugin/model_ids.hpp"
#include "liggghts_plugin/pair_loop.hpp"
#include "liggghts_plugin/plastic_model.hpp"
#include "liggghts_plugin/runaway.hpp"
#include "liggghts_plugin/superquadric.hpp"
#include "liggghts_plugin/wall_loop.hpp"

namespace granulaw::plugin {

/// Runs `work`; what it throws ends the run on all ranks with one sentence. Nothing that a single rank may
/// fail at is thrown here without the ranks having agreed on it (load_law).
template <class Work>
void guarded(LAMMPS* lmp, Work&& work)
{
  try {
    work();
  } catch (const std::exception& failure) {
    stop_all(lmp, failure.what());
  }
}

/// Reads the plug-in's own words from a command; `rest` stays for LIGGGHTS.
inline void read_setup(LAMMPS* lmp, Model model, Setup& setup, int nargs, char** args,
                       std::vector<std::string>& rest)
{
  // The factory counts the words down but leaves `args` on the last one where nothing is left.
  const std::vector<std::string> words(args, args + std::max(0, nargs));
  setup.options = parse_options(model, setup.wall != nullptr, setup.where, words, rest);
  Session& session = *setup.session;
  setup.own = setup.options;
  Options& options = setup.options;
  if (setup.wall && session.pair_options) {
    const bool own_switch = options.tangential_damping_on.has_value();
    options.inherit(*session.pair_options);
    if (!own_switch && options.tangential_damping_on)
      rest.insert(rest.end(), {"tangential_damping", *options.tangential_damping_on ? "on" : "off"});
  }
  if (model == Model::mpm) {
    if (setup.wall && options.law_path.empty()) {
      if (!session.pair_law)
        fail(setup.where, "'law FILE' is missing, and there is no pair_style gran model mpm to take it from");
      setup.law = session.pair_law;
    } else {
      if (options.law_path.empty()) fail(setup.where, "'law FILE' is missing");
      setup.law = load_law(lmp, options.law_path, setup.where);
    }
    if (options.materials.empty()) fail(setup.where, "'materials' is missing: one name for each atom type");
  }
  if (options.dissipated_energy && setup.wall && !session.dissipated_energy)
    fail(setup.where, "'computeDissipatedEnergy on' counts walls with the pair style's: say it there");
  if (!setup.wall) {
    session.dissipated_energy = options.dissipated_energy;
    options.energy = options.energy || options.dissipated_energy;
    session.pair_options = options;
    session.pair_law = setup.law;
    session.energy = options.energy ? &session.tally : nullptr;
    session.contact_map = options.contact_map;
  }
  setup.energy = session.energy != nullptr;
  setup.contact_map = session.contact_map;
}

/// Calls LIGGGHTS's own settings() with `rest`, our setup being current for the model's postSettings.
template <class Call>
void with_setup(const Setup& setup, const std::vector<std::string>& rest, Call&& call)
{
  std::vector<std::string> words = rest;
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  Setup::current = &setup;
  call(static_cast<int>(rest.size()), pointers.data());
  Setup::current = nullptr;
}

template <class Style, Model model>
void refuse_no_friction(const Setup& setup, const std::vector<std::string>& rest)
{
  // no_history is a dashpot capped at the Coulomb limit: without the dashpot there is no friction at all.
  if constexpr (Style::TANGENTIAL == cm::TANGENTIAL_NO_HISTORY) {
    const auto off = std::find(rest.begin(), rest.end(), "tangential_damping");
    if ((off != rest.end() && *(off + 1) == "off") || setup.options.tangential_damping == 0.0)
      fail(setup.where, "'tangential no_history' without tangential damping has no friction at all");
  }
}

/// Liquid bridges pull across a gap.
template <class Style>
inline constexpr bool has_bridges = Style::COHESION == cm::COHESION_EASO_CAPILLARY_VISCOUS ||
                                    Style::COHESION == cm::COHESION_WASHINO_CAPILLARY_VISCOUS;

/// The energy tally counts what happens in contact.
template <class Style>
void refuse_out_of_reach(const Setup& setup)
{
  if (has_bridges<Style> && setup.energy)
    fail(setup.where,
         "'energy on' does not book the work of liquid bridges that pull across a gap: leave it out");
}

template <class Style>
void warn_stretched_cohesion(LAMMPS* lmp, const Setup& setup)
{
  const double s = setup.options.stretch.value_or(1.0);
  if (Style::COHESION != cm::COHESION_OFF && s > 1.0 && setup.session->first_time("stretched cohesion") &&
      lmp->comm->me == 0)
    lmp->error->warning(
        FLERR,
        fmt::format("{}: 'stretch {:g}' does not reach into the cohesion model: cohesionEnergyDensity must "
                    "be the real one divided by {:g}, the square of the factor",
                    setup.where, s, s * s)
            .c_str());
}

/// Our own words of a command into `setup`; `call(nargs, args)` gets the others.
template <class Style, Model model, class Call>
void settle(LAMMPS* lmp, Setup& setup, int nargs, char** args, Call&& call)
{
  std::vector<std::string> rest;
  std::vector<char*> words(args, args + std::max(0, nargs));
  std::vector<std::string> of_surface;
  if constexpr (is_superquadric<Style>) of_surface = take_curvature_words(setup.where, words);
  read_setup(lmp, model, setup, static_cast<int>(words.size()), words.data(), rest);
  rest.insert(rest.end(), of_surface.begin(), of_surface.end());
  setup.combination = Style::HASHCODE | (setup.energy ? combination_energy : 0) |
                      (setup.contact_map ? combination_contact_map : 0);
  setup.session->combinations[setup.wall ? setup.wall->id : "pair"] = setup.combination;
  refuse_out_of_reach<Style>(setup);
  refuse_shape<Style>(lmp, setup);
  refuse_no_friction<Style, model>(setup, rest);
  warn_stretched_cohesion<Style>(lmp, setup);
  with_setup(setup, rest, std::forward<Call>(call));
}

/// LIGGGHTS's combination of the five models, and with `energy on` the work of all but the normal law.
template <class Style>
class TalliedModel : public cm::ContactModel<Style>
{
  using Base = cm::ContactModel<Style>;

 public:
  static constexpr bool acts_at_distance = has_bridges<Style>;

  TalliedModel(LAMMPS* lmp, LIGGGHTS::IContactHistorySetup* hsetup, bool is_wall, int64_t hash)
      : Base(lmp, hsetup, is_wall, hash), lmp_(lmp)
  {
  }

  void postSettings(LIGGGHTS::IContactHistorySetup* hsetup)
  {
    Base::postSettings(hsetup);
    tally_ = Setup::current->session->energy;
    if (!tally_) return;
    for (int k = 0; k < EnergyTally::history_values; ++k) {
      const int offset = hsetup->add_history_value(fmt::format("other_force_{}", k), "1");
      if (k == 0) offset_ = offset;
    }
  }

  void surfacesIntersect(cm::SurfacesIntersectData& sidata, cm::ForceData& i_forces, cm::ForceData& j_forces)
  {
    Base::surfacesIntersect(sidata, i_forces, j_forces);
    if (tally_) [[unlikely]]
      tally_->account(sidata, i_forces, &sidata.contact_history[offset_], lmp_->update->dt,
                      lmp_->atom->nlocal);
  }

  void surfacesClose(cm::SurfacesCloseData& scdata, cm::ForceData& i_forces, cm::ForceData& j_forces)
  {
    Base::surfacesClose(scdata, i_forces, j_forces);
    if (tally_ && scdata.contact_history)
      std::fill_n(&scdata.contact_history[offset_], EnergyTally::history_values, 0.0);
  }

 private:
  LAMMPS* lmp_;
  EnergyTally* tally_ = nullptr;
  int offset_ = -1;
};

/// The fixes that come with our models.
inline void provide_fixes(LAMMPS* lmp)
{
  provide_heat_conduction(lmp);
  provide_contact_list(lmp);
  provide_stats_fix(lmp);
  provide_runaway_fix(lmp);
}

/// pair_style gran with one of our models.
template <class Style, Model model>
class PairStyle final : public PairLoop<TalliedModel<Style>>, public CountedStyle
{
  using Base = PairLoop<TalliedModel<Style>>;

 public:
  PairStyle(LAMMPS* lmp, PairGran* parent, int64_t hash) : Base(lmp, parent, hash), lmp_(lmp), parent_(parent)
  {
  }
  ~PairStyle() override
  {
    if (!setup_.session) return;
    const auto own = setup_.session->styles.find(nullptr);
    if (own != setup_.session->styles.end() && own->second == this) setup_.session->styles.erase(own);
  }

  const ContactInquiry* contacts() const override { return setup_.contacts; }
  void take_out_open(ContactStatistics& statistics) const override
  {
    this->each_open_contact(*parent_, [&](int i, int j, double weight, const double* history) {
      const LAMMPS_NS::Atom& atom = *lmp_->atom;
      const double r_eff = granulaw::effective_radius(atom.radius[i], atom.radius[j]);
      setup_.contacts->take_out(statistics, {atom.type[i], atom.type[j], r_eff, 0.0, history}, weight);
    });
  }

  void settings(int nargs, char** args, LIGGGHTS::IContactHistorySetup* hsetup) override
  {
    guarded(lmp_, [&] {
      setup_.session = Session::of(lmp_);
      setup_.where = fmt::format("pair_style gran model {}", model_name(model));
      settle<Style, model>(lmp_, setup_, nargs, args,
                           [&](int n, char** words) { Base::settings(n, words, hsetup); });
      setup_.session->styles[nullptr] = this;
      this->set_bodies(&setup_.session->bodies);
      provide_fixes(lmp_);
    });
  }

  void init_granular() override
  {
    guarded(lmp_, [&] {
      Base::init_granular();
      check_run(lmp_, setup_, parent_->dnum());
      provide_fixes(lmp_);  // the box did not exist when pair_style stood before create_box
    });
  }

 private:
  LAMMPS* lmp_;
  PairGran* parent_;
  Setup setup_;
};

/// fix wall/gran with one of our models.
template <class Style, Model model>
class WallStyle final : public WallLoop<TalliedModel<Style>>, public CountedStyle
{
  using Base = WallLoop<TalliedModel<Style>>;

 public:
  WallStyle(LAMMPS* lmp, FixWallGran* parent, int64_t hash)
      : Base(lmp, parent, hash), lmp_(lmp), parent_(parent)
  {
  }
  ~WallStyle() override
  {
    if (setup_.session) setup_.session->styles.erase(parent_);
  }

  const ContactInquiry* contacts() const override { return setup_.contacts; }

  void take_out_open(ContactStatistics& statistics) const override
  {
    this->each_open_contact([&](int i, int wall_type, const double* history) {
      setup_.contacts->take_out(statistics,
                                {lmp_->atom->type[i], wall_type, lmp_->atom->radius[i], 0.0, history}, 1.0);
    });
  }

  double heat_overlap(const cm::SurfacesIntersectData& contact) const override
  {
    if (!setup_.options.heat_by_law.value_or(false)) return contact.deltan;
    // area pi a^2 of the law's own contact radius, which is less than R
    const double r = contact.radi;
    const double a =
        setup_.contacts->state({contact.itype, contact.jtype, r, contact.deltan, contact.contact_history})
            .contact_radius;
    return r - std::sqrt(std::max(0.0, r * r - a * a));
  }

  void settings(int nargs, char** args, LIGGGHTS::IContactHistorySetup* hsetup) override
  {
    guarded(lmp_, [&] {
      const UnfinishedFix unfinished(lmp_, parent_);  // we are in its constructor
      setup_.session = Session::of(lmp_);
      setup_.wall = parent_;
      setup_.where = fmt::format("fix {} wall/gran model {}", parent_->id, model_name(model));
      settle<Style, model>(lmp_, setup_, nargs, args,
                           [&](int n, char** words) { Base::settings(n, words, hsetup); });
      setup_.session->styles[parent_] = this;
      provide_fixes(lmp_);
    });
  }

  void init_granular() override
  {
    guarded(lmp_, [&] {
      Base::init_granular();
      check_run(lmp_, setup_, parent_->dnum());
    });
  }

 private:
  LAMMPS* lmp_;
  FixWallGran* parent_;
  Setup setup_;
};

template <class Style, Model model>
LIGGGHTS::PairStyles::IGranularPairStyle* make_pair_style(LAMMPS* lmp, PairGran* parent, int64_t hash)
{
  check_liggghts(lmp, dynamic_cast<void*>(parent), sizeof(PairGranProxy), "pair style");
  check_particles<Style>(lmp);
  return new PairStyle<Style, model>(lmp, parent, hash);
}

template <class Style, Model model>
LIGGGHTS::Walls::IGranularWall* make_wall_style(LAMMPS* lmp, FixWallGran* parent, int64_t hash)
{
  check_liggghts(lmp, dynamic_cast<void*>(parent), sizeof(FixWallGran), "fix wall/gran");
  check_particles<Style>(lmp);
  return new WallStyle<Style, model>(lmp, parent, hash);
}

template <int... ids>
using Ids = std::integer_sequence<int, ids...>;

/// What is built: every combination of these.
using BuiltTangential = Ids<cm::TANGENTIAL_OFF, cm::TANGENTIAL_HISTORY, cm::TANGENTIAL_NO_HISTORY>;
using BuiltCohesion = Ids<cm::COHESION_OFF, cm::COHESION_SJKR, cm::COHESION_SJKR2,
                          cm::COHESION_EASO_CAPILLARY_VISCOUS, cm::COHESION_WASHINO_CAPILLARY_VISCOUS>;
using BuiltRolling =
    Ids<cm::ROLLING_OFF, cm::ROLLING_CDT, cm::ROLLING_EPSD, cm::ROLLING_EPSD2, cm::ROLLING_EPSD3>;

template <int... ids>
constexpr bool contains(Ids<ids...>, int id)
{
  return ((ids == id) || ...);
}

template <int id, Model model, int tangential, int cohesion, int rolling, int surface = cm::SURFACE_DEFAULT>
void add_combination()
{
  using Style = cm::GranStyle<id, tangential, cohesion, rolling, surface>;
  LIGGGHTS::PairStyles::Factory::instance().addStyle("gran", Style::HASHCODE, &make_pair_style<Style, model>);
  LIGGGHTS::Walls::Factory::instance().addStyle("gran", Style::HASHCODE, &make_wall_style<Style, model>);
  if constexpr (surface == cm::SURFACE_DEFAULT && surface_is_built(cm::SURFACE_SUPERQUADRIC, cohesion))
    add_combination<id, model, tangential, cohesion, rolling, cm::SURFACE_SUPERQUADRIC>();
}

template <int id, Model model, int tangential, int cohesion, int... rolling>
void add_rolling(Ids<rolling...>)
{
  (add_combination<id, model, tangential, cohesion, rolling>(), ...);
}

template <int id, Model model, int tangential, int... cohesion>
void add_cohesion(Ids<cohesion...>)
{
  (add_rolling<id, model, tangential, cohesion>(BuiltRolling{}), ...);
}

template <int id, Model model, int... tangential>
void add_tangential(Ids<tangential...>)
{
  (add_cohesion<id, model, tangential>(BuiltCohesion{}), ...);
}

/// Registers what is built. Every other combination is refused in a sentence (register_refusals): LIGGGHTS
/// would say "Unknown normal model".
template <int id, Model model>
void register_model()
{
  cm::Factory::instance().addNormalModel(model_name(model), id);
  add_tangential<id, model>(BuiltTangential{});
}

/// Called by the static object in registration.cpp when the library is loaded.
void register_mpm();
void register_thornton();
/// A creator that refuses in a sentence, for every combination of model `id` that is not built.
void register_refusals(int id);

}  // namespace granulaw::plugin
