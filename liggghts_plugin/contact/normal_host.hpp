#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "law/plan_notes.hpp"
#include "liggghts_plugin/contact/contact_counts.hpp"
#include "liggghts_plugin/contact/normal_physics.hpp"
#include "liggghts_plugin/contact/pair_table.hpp"
#include "liggghts_plugin/contact/superquadric.hpp"
#include "liggghts_plugin/deck/loaded_law.hpp"
#include "liggghts_plugin/deck/session.hpp"
#include "liggghts_plugin/engine/liggghts.hpp"

namespace granulaw::plugin {

/// Gives each value of the list its place in LIGGGHTS's contact history; the place of the first.
inline int add_history(LIGGGHTS::IContactHistorySetup& history, std::span<const Kept> keeps)
{
  int first = -1;
  for (const Kept& one : keeps)
    for (std::size_t k = 1; k <= one.values; ++k) {
      const std::string name = one.values == 1 ? std::string(one.name) : fmt::format("{}_{}", one.name, k);
      const int place = history.add_history_value(name, one.turns_with_exchange ? "1" : "0");
      if (first < 0) first = place;
    }
  return first;
}

/// The history policy that all models share, and everything else that is not the law itself (NormalPhysics).
///
/// State: NormalState of the law. It advances only when the step does (computeflag and shearupdate), and
/// returns to zero when the geometric overlap ends.
///
/// Everything that a Contact takes and gives is in the deck's units, and stretched (`stretch S`): delta_max
/// and the contact statistics' overlaps are the deck's own, S times the real ones; work needs no conversion,
/// because F(d/S)/S does the same work to S times the overlap. X stays the unstretched law's.
template <NormalPhysics Physics>
class NormalHost : public NormalModelBase, public ContactInquiry
{
 public:
  NormalHost(LAMMPS* lmp, IContactHistorySetup* hsetup, ContactModelBase* cmb)
      : NormalModelBase(lmp, hsetup, cmb)
  {
    history_offset_ = add_history(*hsetup, State::keeps);
    cmb->add_history_offset("delta_max", history_offset_);
    if (superquadrics_built && atom->superquadric_flag)
      counts_.keep_radius_at(hsetup->add_history_value("curvature_radius", "0"));
  }

  void registerSettings(Settings& settings)
  {
    settings.registerOnOff("tangential_damping", tangential_damping_, true);
    settings.registerOnOff("limitForce", limit_force_);  // the force is never attractive: nothing to limit
    settings.registerOnOff("computeElasticPotential", elastic_potential_, false);
  }

  void postSettings(IContactHistorySetup* hsetup, ContactModelBase*)
  {
    setup_ = Setup::current;
    setup_->contacts = this;
    if (setup_->session->contact_map) counts_.keep_speed_at(hsetup->add_history_value("impact_speed", "0"));
    if (elastic_potential_)
      fail(setup_->where,
           "'computeElasticPotential' is not available with this model: 'energy on' gives the elastic energy "
           "of each "
           "particle's contacts, f_granulaw[1] in a dump");
    if (setup_->options.body_compliance.value_or(false))
      behind_offset_ = hsetup->add_history_value("body_compliance", "0");
    if (beyond_range() == BeyondRange::crush) crushed_offset_ = hsetup->add_history_value("crushed", "0");
    changes_overlap_ = behind_offset_ >= 0 || crushed_offset_ >= 0;
    tangential_.damping =
        tangential_damping_ ? setup_->options.tangential_damping.value_or(default_tangential_damping) : 0.0;
    tangential_.computed = setup_->options.tangential_computed.value_or(false);
    stretch_ = setup_->options.stretch.value_or(1.0);
  }

  void connectToProperties(PropertyRegistry& registry)
  {
    if (!setup_)
      fail(fmt::format("model {}", Physics::name), "repeat pair_style and pair_coeff after read_restart");
    const Types types = gather_types(lmp, registry, *setup_);
    physics_.prepare(lmp, registry, *setup_, types);
    refuse_unstated_restitution(lmp, *setup_);
    first_step_ = update->ntimestep;
    units_ = types.units;
    const ParticleSizes sizes = particle_sizes(lmp);
    pairs_.resolve(physics_, *setup_, types, sizes, tangential_, damping_ratios(registry, *setup_, types));
    Bodies::provide(lmp, pairs_.needs_mass() || behind_offset_ >= 0);
    pairs_.enter(lmp, physics_, *setup_, types, sizes);
    counts_.connect(lmp, *setup_->session);
    energy_ = setup_->session->energy;
  }

  double stressStrainExponent() { return 1.5; }

  void surfacesIntersect(SurfacesIntersectData& sidata, ForceData& i_forces, ForceData& j_forces)
  {
    if (sidata.contact_flags) *sidata.contact_flags |= CONTACT_NORMAL_MODEL;
    const double r_eff = effective_radius(sidata);
    const Entry& entry = entry_of(sidata);
    double* const kept = kept_of(sidata.contact_history);
    const double delta_max = State::largest(kept);
    if (sidata.is_wall && !layout_checked_) [[unlikely]]
      check_layout(sidata);
    if constexpr (!Law::keeps.empty())
      if (update->ntimestep == first_step_) [[unlikely]]
        State::forget_derived(kept);  // what a restart brings may be of another law
    if (changes_overlap_) [[unlikely]]
      sidata.deltan = changed_overlap(sidata, entry, r_eff, kept);
    if (sidata.deltan > entry.largest_overlap * r_eff) [[unlikely]] {
      if (began_beyond(sidata, entry, r_eff, delta_max)) {
        sidata.deltan = entry.largest_overlap * r_eff;  // a bounded force
        held_ = true;
        parts_freely_ = parts_freely(sidata, entry, r_eff);
      } else {
        check_stretched(sidata, r_eff);
        beyond_table(sidata, entry, r_eff);
      }
    }
    const double delta = sidata.deltan;
    const NormalForces now =
        advance_normal(entry.contact, {r_eff, delta, -sidata.vn, sidata.computeflag && sidata.shearupdate},
                       Radiates<Law> && pairs_.radiates(), kept, Books{*this, sidata, entry, r_eff});
    const double law_force = now.law, waves_force = now.waves;
    const double root = std::sqrt(r_eff * delta);
    const double radius = tangential_.computed
                              ? entry.contact.contact_radius(r_eff, delta, delta_max, now.impact_overlap)
                              : root;
    const double impedance = std::sqrt(root * sidata.meff);  // both dampings are proportional to it
    // of an undamped contact the law's force itself, to the bit: it is never negative
    sidata.gamman = damping_of(entry, r_eff, delta, delta_max, sidata.vn) * impedance;
    // below the residual overlap of a dent nothing touches, and nothing is damped
    // (std::max gives its first argument where that is no number, and the runaway fix ends the run)
    double normal_force =
        law_force <= 0.0 ? 0.0 : std::max((law_force + waves_force) - sidata.gamman * sidata.vn, 0.0);
    if (parts_freely_) [[unlikely]]  // a member: a local flag costs every contact, 2 % of the instructions in a chute
      normal_force = 0.0, parts_freely_ = false;
    if (Radiates<Law> && pairs_.radiates()) counts_.radiate(sidata, entry, waves_force, normal_force);
    if (energy_) [[unlikely]]
      store_energy(sidata, entry, r_eff, now.largest, now.impact_overlap, law_force);

    sidata.Fn = normal_force;
    sidata.kn =
        delta > 0.0 ? law_force / delta : 0.0;  // secant: rolling model cdt takes kn*deltan as the force
    sidata.kt = entry.tangential * radius;
    sidata.gammat = tangential_.computed ? 2.0 * tangential_.damping * std::sqrt(sidata.kt * sidata.meff)
                                         : entry.tangential_damping * impedance;

    const double force = sidata.is_wall ? normal_force * sidata.area_ratio : normal_force;
    for (int c = 0; c < 3; ++c) {
      i_forces.delta_F[c] += force * sidata.en[c];
      if (!sidata.is_wall) j_forces.delta_F[c] -= force * sidata.en[c];
    }
    add_normal_torque(sidata, atom->x, force, i_forces, j_forces);
  }

  void surfacesClose(SurfacesCloseData& scdata, ForceData&, ForceData&)
  {
    if (scdata.contact_flags) *scdata.contact_flags &= ~CONTACT_NORMAL_MODEL;
    if (!scdata.contact_history) return;
    double* const kept = scdata.contact_history + history_offset_;
    if (State::largest(kept) == 0.0)
      return;  // near neighbours that never touched: leave their cache lines alone
    counts_.forget_speed(scdata.contact_history);
    std::fill_n(kept, State::values, 0.0);
    for (const int offset : {behind_offset_, crushed_offset_})
      if (offset >= 0) scdata.contact_history[offset] = 0.0;
  }

  // For a tangential law of ours (OwnTangential).
  using Entry = typename PairTable<Physics>::Entry;
  const Entry& entry_of(const SurfacesIntersectData& sidata) const
  {
    return pairs_.of(sidata.itype, sidata.jtype, sidata.radi, sidata.radj);
  }
  double* kept_of(double* history) const { return history + history_offset_; }
  /// One for each entry, at its place().
  template <class Law>
  std::vector<Law> tangential_laws(double** friction) const
  {
    return pairs_.template tangential_laws<Law>(friction, [this](const auto& contact) {
      if constexpr (requires { physics_.check_flow_stress(contact); }) physics_.check_flow_stress(contact);
    });
  }
  std::size_t place(const Entry& entry) const { return pairs_.place(entry); }
  /// True of the contact at hand if its overlap and depth are held at the law's end until it parts; asked for once.
  bool was_held() { return std::exchange(held_, false); }
  /// For the statistics: the largest overlap stands at this place of the history, which the tangential law keeps by reach().
  void count_overlaps_at(int offset) { counts_.keep_largest_at(offset); }
  void reach(const SurfacesIntersectData& sidata, const Entry& entry, double r_eff, double largest) const
  {
    counts_.reach(sidata, entry, r_eff, largest);
  }
  /// Part of the overlap that belongs to the real contact.
  double per_stretch() const { return 1.0 / stretch_; }
  bool rigid_wall() const { return setup_->wall && !setup_->options.deformable_wall; }
  /// Books a depth that the tangential law changed from `from`.
  void change_depth(const SurfacesIntersectData& sidata, const Entry& entry, double r_eff, double from) const
  {
    double* const kept = kept_of(sidata.contact_history);
    const double latched = State::impact_overlap(kept), to = State::largest(kept);
    counts_.change_depth(sidata, entry, r_eff, latched, from, to);
    if (energy_)
      energy_->law_force_behind = entry.contact.force(r_eff, sidata.deltan, to, latched, kept + State::own) *
                                  (sidata.is_wall ? sidata.area_ratio : 1.0);
  }
  /// Books the mechanisms in the statistics; their work is no other work.
  void book(const SurfacesIntersectData& sidata, const Entry& entry, const Ledger& books) const
  {
    for (const MechanismText& m : mechanisms) {
      if (!m.in_statistics || books[m.which] == 0.0) continue;
      const double taken = counts_.weight(sidata) * books[m.which];
      entry.counts->taken[m.which] += taken;
      if (energy_) entry.counts->other_work -= taken;
    }
  }

  ContactState state(const ContactPlace& contact) const override
  {
    const Entry& pair = pairs_.of(contact.itype, contact.jtype, contact.radius_i, contact.radius_j);
    const double* const kept = contact.history + history_offset_;
    const double delta_max = State::largest(kept), impact_overlap = State::impact_overlap(kept),
                 r_eff = contact.r_eff();
    double copy[State::values];
    std::copy_n(kept, State::values, copy);
    const double now = std::max(contact.overlap - (crushed_offset_ >= 0 ? contact.history[crushed_offset_] : 0.0), 0.0);
    const double overlap = overlap_of_law(pair.contact, r_eff, now, kept_compliance(contact.history), copy);
    return {pair.contact.contact_radius(r_eff, overlap, delta_max, impact_overlap), delta_max,
            pair.contact.dissipated(r_eff, 0.0, delta_max, impact_overlap)};
  }

  void take_out(ContactStatistics& statistics, const ContactPlace& contact, double weight) const override
  {
    const double delta_max = contact.history[history_offset_];
    if (delta_max > 0.0)
      counts_.take_out(statistics.pairs[pair_key(*setup_, contact.itype, contact.jtype)], contact.history,
                       delta_max, contact.r_eff(), weight);
  }

  void beginPass(SurfacesIntersectData&, ForceData&, ForceData&) {}
  void endPass(SurfacesIntersectData&, ForceData&, ForceData&) {}

 private:
  using Law = typename Physics::Contact;
  using State = NormalState<Law>;

  /// Books that advance_normal requires in the steps that take a contact deeper than it was.
  struct Books
  {
    const NormalHost& model;
    const SurfacesIntersectData& sidata;
    const Entry& entry;
    double r_eff;

    double impact_overlap() const { return model.first_impact_overlap(entry, r_eff, sidata); }
    void deepen(double from, double latched, double* own) const
    {
      model.counts_.deepen(sidata, entry, r_eff, latched, from, own);
    }
  };

  /// X of a contact that begins.
  [[gnu::noinline]] double first_impact_overlap(const Entry& entry, double r_eff,
                                                SurfacesIntersectData sidata) const
  {
    if constexpr (LatchesImpact<Law>)
      return entry.contact.impact_overlap(r_eff, contact_mass(setup_->session->bodies, sidata), -sidata.vn);
    return 0.0;
  }

  BeyondRange beyond_range() const { return setup_->options.beyond_range.value_or(BeyondRange::stop); }

  /// The law's overlap: without what bodies behind the contact take, and what was crushed.
  [[gnu::noinline]] double changed_overlap(SurfacesIntersectData sidata, const Entry& entry, double r_eff, double* kept) const
  {
    double crushed = crushed_offset_ >= 0 ? sidata.contact_history[crushed_offset_] : 0.0;
    double overlap = std::max(sidata.deltan - crushed, 0.0);
    if (behind_offset_ >= 0)
      overlap = overlap_of_law(entry.contact, r_eff, overlap, compliance_behind(sidata, entry, State::largest(kept)), kept);
    return crushed_offset_ >= 0 && overlap > entry.largest_overlap * r_eff ? crush(sidata, entry, r_eff, overlap, kept) : overlap;
  }

  /// Beyond the table's end the force stays: the law's overlap, which is the end. What is beyond is lost for good.
  double crush(const SurfacesIntersectData& sidata, const Entry& entry, double r_eff, double overlap, double* kept) const
  {
    const double end = entry.largest_overlap * r_eff, from = State::largest(kept);
    if (end < 0.0) return overlap;  // there is no law
    double& crushed = sidata.contact_history[crushed_offset_];
    if (sidata.computeflag && sidata.shearupdate) {
      const double force = entry.contact.force(r_eff, end, std::max(from, end), State::impact_overlap(kept), kept + State::own);
      counts_.crush(sidata, entry, r_eff, force, overlap - end, crushed == 0.0, from == 0.0);
      crushed += overlap - end;
    }
    return end;
  }

  /// m/N, of the bodies behind the contact. It stays that of the first touch: while a clump turns over a contact the
  /// force is then a function of its overlap alone, and no closed path gains energy.
  [[gnu::noinline]] double compliance_behind(SurfacesIntersectData sidata, const Entry& entry, double delta_max) const
  {
    double& kept = sidata.contact_history[behind_offset_];
    const Bodies& bodies = setup_->session->bodies;
    if (delta_max > 0.0) return kept;
    if (!bodies.known() && !sidata.is_non_spherical) return 0.0;
    const auto [i, j] = bodies_at_contact(sidata, bodies, *atom);
    double sum = entry.behind_i * reach_behind(i.radius, i.height);
    if (!sidata.is_wall) sum += entry.behind_j * reach_behind(j.radius, j.height);
    if (sidata.computeflag && sidata.shearupdate) kept = sum;
    return sum;
  }
  double kept_compliance(const double* history) const { return behind_offset_ >= 0 ? history[behind_offset_] : 0.0; }

  // Entry::damping where the law is elastic, else 0. Elastic is a contact that never yielded, both ways; a
  // yielded one on its way back to delta_max, but not when it parts, so that the rebound of a plastic impact
  // is the law's own. Without a branch: in a bed contacts approach and part at random.
  static double damping_of(const Entry& entry, double r_eff, double delta, double delta_max, double vn)
  {
    const bool returns = (delta < delta_max) & (vn < 0.0);
    const bool elastic = std::max(delta, delta_max) <= entry.yield_overlap * r_eff;
    return entry.damping * static_cast<double>(returns | elastic);
  }

  /// m/s, for a message.
  double approach(const SurfacesIntersectData& sidata) const
  {
    if (!std::isfinite(sidata.vn))
      stop_one(lmp, fmt::format("{}: the velocity of particle {} or of what it touches is not a number",
                                setup_->where, atom->tag[sidata.i]));
    return 0.0 - sidata.vn * units_.length;  // 0 of two at rest, not -0
  }

  [[gnu::noinline, gnu::cold]] void check_stretched(SurfacesIntersectData sidata, double r_eff)
  {
    if (stretch_ > 1.0 && sidata.deltan > stretched_overlap_limit * r_eff)
      stop_one(lmp, fmt::format("{}: 'stretch {:g}' takes the overlap of types {} and {} to {:.4g} R* at "
                                "{:.4g} m/s; {} R* is the limit: stretch less",
                                setup_->where, stretch_, sidata.itype, sidata.jtype, sidata.deltan / r_eff,
                                approach(sidata), stretched_overlap_limit));
  }

  /// Only with `energy on`: what the contact holds now, and the law's force for EnergyTally::account.
  [[gnu::noinline, gnu::cold]] void store_energy(SurfacesIntersectData sidata, const Entry& entry,
                                                 double r_eff, double delta_max, double impact_overlap,
                                                 double law_force)
  {
    energy_->law_force = energy_->law_force_behind = law_force * (sidata.is_wall ? sidata.area_ratio : 1.0);
    energy_->counts = entry.counts;
    if (sidata.computeflag)
      energy_->share(sidata, EnergyTally::stored,
                     entry.contact.stored_energy(r_eff, sidata.deltan, delta_max, impact_overlap) +
                         energy_behind(kept_compliance(sidata.contact_history), law_force),
                     atom->nlocal);
  }

  /// True of a contact that no motion brought beyond the table: it began there, inserted into a body or at a mesh
  /// that was put there. Its largest overlap is the table's end from its first step on.
  [[gnu::noinline, gnu::cold]] bool began_beyond(SurfacesIntersectData sidata, const Entry& entry, double r_eff,
                                                 double delta_max) const
  {
    const double end = entry.largest_overlap * r_eff;
    if (entry.largest_overlap < 0 || beyond_range() != BeyondRange::stop) return false;
    return delta_max == 0.0 ? counts_.is_sudden(sidata) : delta_max == end;
  }

  /// True of such a contact that parts with the elastic energy of the table's end. No motion paid for its overlap:
  /// the force over the way beyond the table does no further work.
  [[gnu::noinline, gnu::cold]] bool parts_freely(SurfacesIntersectData sidata, const Entry& entry, double r_eff) const
  {
    const double end = entry.largest_overlap * r_eff;
    return sidata.vn > 0.0 && 0.5 * sidata.meff * sidata.vn * sidata.vn > entry.contact.stored_energy(r_eff, end, end, 0.0);
  }

  [[gnu::noinline, gnu::cold]] void beyond_table(SurfacesIntersectData sidata, const Entry& entry,
                                                 double r_eff)
  {
    if (entry.largest_overlap < 0)
      stop_one(
          lmp,
          fmt::format("{}: no law for particles of type {} against {} {}; it was not among the pairs "
                      "that the deck could show when the run began",
                      setup_->where, sidata.itype, sidata.is_wall ? "a wall of type" : "type", sidata.jtype));
    if (sidata.computeflag && sidata.shearupdate) entry.counts->beyond += counts_.weight(sidata);
    // 5 %: the linear continuation is still within about a percent of the force there.
    if (beyond_range() != BeyondRange::stop || !(sidata.deltan > 1.05 * entry.largest_overlap * r_eff))
      return;
    const double speed = approach(sidata);
    entry.counts->overlap_max = std::max(entry.counts->overlap_max, sidata.deltan / r_eff);
    stop_one(lmp, fmt::format("{}: overlap/R* {:.4g} of types {} and {} {} {:.4g} m/s is more than 5 % beyond "
                              "the law's table, which ends at {:.4g}{}, or say 'beyondRange crush'",
                              setup_->where, sidata.deltan / r_eff, sidata.itype, sidata.jtype,
                              speed < 0 ? "parting at" : "at", std::abs(speed), entry.largest_overlap,
                              remedy(entry, sidata.deltan / r_eff)));
  }

  /// " (what was planned): what holds this overlap".
  std::string remedy(const Entry& entry, double overlap) const
  {
    if constexpr (requires { entry.contact.law().curve->end(); }) {
      const granulaw::Law& law = setup_->law->law;
      const std::string &a = entry.counts->info.a, &b = entry.counts->info.b, planned = planned_text(law, a, b, stretch_);
      return fmt::format("{}: {}", planned.empty() ? "" : " (" + planned + ")",
                         remedy_beyond(law, a, b, overlap / stretch_, entry.largest_overlap / stretch_, entry.contact.law().curve->end()));
    }
    return ": build a deeper law";
  }

  /// In a library with another layout of SurfacesIntersectData these two would not agree.
  [[gnu::noinline, gnu::cold]] void check_layout(SurfacesIntersectData sidata)
  {
    if (sidata.is_non_spherical) return;
    const double distance = std::sqrt(sidata.delta[0] * sidata.delta[0] + sidata.delta[1] * sidata.delta[1] +
                                      sidata.delta[2] * sidata.delta[2]);
    if (distance == 0.0) return;  // on the axis of a cylinder, where LIGGGHTS gives no normal
    layout_checked_ = true;
    if (std::abs(sidata.radi - distance - sidata.deltan) > 1e-6 * sidata.radi)
      stop_one(lmp, fmt::format("{}: this LIGGGHTS lays out its contact data differently (was it built with "
                                "superquadrics?)",
                                setup_->where));
  }

  Physics physics_;
  const Setup* setup_ = nullptr;
  PairTable<Physics> pairs_;
  ContactCounts<Entry> counts_;
  EnergyTally* energy_ = nullptr;  // null: energy off
  int history_offset_ = -1;        // of State's values
  int behind_offset_ = -1;         // of the compliance of bodies behind a contact; -1: `bodyCompliance` is off
  int crushed_offset_ = -1;        // of the length crushed; -1: `beyondRange` is not crush
  bool changes_overlap_ = false;   // either of the two is there
  LAMMPS_NS::bigint first_step_ = 0;  // of this run
  TangentialChoice tangential_;
  double stretch_ = 1.0;
  DeckUnits units_;
  bool tangential_damping_ = true, limit_force_ = false, elastic_potential_ = false;
  bool layout_checked_ = false;
  bool held_ = false;          // the contact at hand began beyond the table; was_held() resets it
  bool parts_freely_ = false;  // the contact at hand began beyond the table and gets no force
};

}  // namespace granulaw::plugin
