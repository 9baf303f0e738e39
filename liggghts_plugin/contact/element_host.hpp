#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

#include "base/error.hpp"
#include "law/plan_notes.hpp"
#include "liggghts_plugin/contact/contact_counts.hpp"
#include "liggghts_plugin/contact/normal_physics.hpp"
#include "liggghts_plugin/contact/pair_table.hpp"
#include "liggghts_plugin/contact/superquadric.hpp"
#include "liggghts_plugin/deck/keywords.hpp"
#include "liggghts_plugin/deck/loaded_law.hpp"
#include "liggghts_plugin/deck/session.hpp"
#include "liggghts_plugin/engine/liggghts.hpp"

namespace granulaw::plugin {

/// Gives each value of the list its place in LIGGGHTS's contact history; the place of the first.
inline int add_history(LIGGGHTS::IContactHistorySetup& history, std::span<const HistoryValue> history_values)
{
  int first = -1;
  for (const HistoryValue& one : history_values)
    for (std::size_t k = 1; k <= one.values; ++k) {
      const std::string name = one.values == 1 ? std::string(one.name) : fmt::format("{}_{}", one.name, k);
      const int place = history.add_history_value(name, one.changes_sign ? "1" : "0");
      if (first < 0) first = place;
    }
  return first;
}

/// The contact element (mpm_core/contact/element.hpp) in LIGGGHTS: takes the motion from LIGGGHTS's contact data, gives it the
/// forces, keeps the state in its contact history, and counts what the element's ledger has. All that is not the law itself.
///
/// The state advances only when the step does (computeflag and shearupdate), and returns to zero when the geometric overlap ends.
///
/// Everything that a Contact takes and gives is in the deck's units, and stretched (`stretch S`): the largest overlap
/// and the contact statistics' overlaps are the deck's own, S times the real ones; work needs no conversion,
/// because F(d/S)/S does the same work to S times the overlap. X stays the unstretched law's.
template <NormalPhysics Physics, class Tangential, class Beside = NothingBeside>
class ElementHost : public ContactInquiry
{
  using SurfacesIntersectData = cm::SurfacesIntersectData;
  using ForceData = cm::ForceData;
  using Law = typename Physics::Contact;
  using Table = PairTable<Physics, Tangential, Beside>;
  using Entry = typename Table::Entry;
  using Element = typename Table::Element;
  using State = NormalState<Law>;

 public:
  ElementHost(LAMMPS* lmp, LIGGGHTS::IContactHistorySetup& history, cm::ContactModelBase& contact)
      : lmp_(lmp), history_offset_(add_history(history, Element::history_values))
  {
    contact.add_history_offset("delta_max", history_offset_);
    if constexpr (Element::deepens) counts_.keep_largest_at(history.add_history_value("largest_overlap", "0"));
    if (superquadrics_built && lmp->atom->superquadric_flag)
      counts_.keep_radius_at(history.add_history_value("curvature_radius", "0"));
  }

  void registerSettings(Settings& settings)
  {
    settings.registerOnOff("tangential_damping", tangential_damping_, true);
    settings.registerOnOff("limitForce", no_limit_);  // the force is never attractive: nothing to limit
    settings.registerOnOff("computeElasticPotential", elastic_potential_, false);
    // LIGGGHTS's tangential models take these, and nothing in this version reads what they add up
    for (const char* word : {"heating_tracking", "heating_tangential_history", "heating_tangential_no_history"})
      settings.registerOnOff(word, no_heating_, false);
  }

  void postSettings(const Setup& setup, LIGGGHTS::IContactHistorySetup& history)
  {
    setup_ = &setup;
    setup.contacts = this;
    if (setup.session->contact_map) counts_.keep_speed_at(history.add_history_value("impact_speed", "0"));
    if (elastic_potential_)
      fail(setup.where,
           "'computeElasticPotential' is not available with this model: 'energy on' gives the elastic energy "
           "of each "
           "particle's contacts, f_granulaw[1] in a dump");
    if (setup.options.body_compliance.value_or(false)) behind_offset_ = history.add_history_value("body_compliance", "0");
    if (beyond_range() == BeyondRange::crush) crushed_offset_ = history.add_history_value("crushed", "0");
    changes_overlap_ = behind_offset_ >= 0 || crushed_offset_ >= 0;
    stretch_ = setup.options.stretch.value_or(1.0);
    rigid_wall_ = setup.wall && !setup.options.deformable_wall;
  }

  void connectToProperties(PropertyRegistry& registry)
  {
    if (!setup_) fail(fmt::format("model {}", Physics::name), "repeat pair_style and pair_coeff after read_restart");
    const Types types = gather_types(lmp_, registry, *setup_);
    physics_.prepare(lmp_, registry, *setup_, types);
    refuse_unstated_restitution(lmp_, *setup_);
    first_step_ = lmp_->update->ntimestep;
    units_ = types.units;
    const ParticleSizes sizes = particle_sizes(lmp_);
    TangentialChoice tangential{.damping = tangential_damping_ ? setup_->options.tangential_damping.value_or(usual_shear_damping) : 0.0,
                                .computed = setup_->options.tangential_computed.value_or(false)};
    if constexpr (!std::same_as<Tangential, Frictionless>) {
      registry.registerProperty("coeffFrict", &MODEL_PARAMS::createCoeffFrict);
      registry.connect("coeffFrict", tangential.friction, "tangential model");
    }
    if constexpr (Element::has_beside) {
      registry.registerProperty(Beside::property, &number_of_beside);
      registry.connect(Beside::property, tangential.beside, "cohesion model");
    }
    if constexpr (requires { Beside::range_property; })
      tangential.range_of_beside = [this](int i, int j) { return pair_number(lmp_, Beside::range_property, i, j, Beside::usual_range / units_.length); };
    pairs_.resolve(physics_, *setup_, types, sizes, tangential, damping_ratios(registry, *setup_, types));
    Bodies::provide(lmp_, pairs_.needs_mass() || behind_offset_ >= 0);
    pairs_.enter(lmp_, physics_, *setup_, types, sizes);
    if constexpr (requires { Beside::range_property; }) check_beside(types, sizes);
    // 1 %: neighbours are those of the step before
    if constexpr (Element::has_beside) lmp_->neighbor->register_contact_dist_factor(1.01 + pairs_.largest_reach(sizes, setup_->wall));
    if constexpr (has_rows) ParticleColumns::provide(lmp_, rows_of_beside);
    counts_.connect(lmp_, *setup_->session);
    energy_ = setup_->session->energy;
    // a wall may drop a contact that it does not close, energies need each step, and what changes R* or the law's overlap
    // would change what was booked
    books_later_ = BooksLater<Law> && !Element::deepens && !setup_->wall && !energy_ && !changes_overlap_ &&
                   !(superquadrics_built && lmp_->atom->superquadric_flag);
  }

  /// Before the forces between particles of a step. Collective.
  void begin_step() const
  {
    if constexpr (has_rows) ParticleColumns::find(lmp_, rows_of_beside).send();
  }

  /// One step: adds the element's forces. `beside()` adds those of LIGGGHTS's models that act along the normal, and may change
  /// contact.Fn, what friction grows with; none: nullptr.
  template <class Others>
  [[gnu::always_inline]] void surfacesIntersect(SurfacesIntersectData& contact, ForceData& on_i, ForceData& on_j, Others beside)
  {
    if (contact.contact_flags) *contact.contact_flags |= CONTACT_NORMAL_MODEL;
    const double r_eff = effective_radius(contact);
    const Entry& entry = entry_of(contact);
    double* const history = history_of(contact.contact_history);
    if (contact.is_wall && !layout_checked_) [[unlikely]]
      check_layout(contact);
    if constexpr (!Law::history_values.empty())
      if (lmp_->update->ntimestep == first_step_) [[unlikely]]
        begin_run(entry, r_eff, history);
    if (changes_overlap_) [[unlikely]]
      contact.deltan = changed_overlap(contact, entry, r_eff, history);
    if (contact.deltan > entry.largest_overlap * r_eff) [[unlikely]]
      beyond_law(contact, entry, r_eff, State::largest(history));
    const double shorter = shorter_lever(contact, entry);
    const bool advances = contact.computeflag && contact.shearupdate;
    const ContactMotion moves = motion(contact, r_eff, advances, shorter);
    Ledger ledger;
    Caller<Others> caller{*this, contact, entry, moves, history, on_i, on_j, beside, ledger};
    const ContactForce force = entry.element.touch(moves, history, ledger, caller);
    add_shear(contact, *lmp_->atom, force.shear, contact.cri - shorter, on_i, on_j);
    if constexpr (Element::deepens || Element::has_beside) add_normal(contact, force.normal - caller.pushed, on_i, on_j);
    if constexpr (Element::deepens) {
      add_couple(contact, force.couple, on_i, on_j);
      if (advances) counts_.reach_further(contact, entry, r_eff);
    }
    if (advances) counts_.book(contact, entry, ledger);
    if (energy_) [[unlikely]]
      book_energy(contact, entry, r_eff, force.law, caller.depth, caller.by_law, ledger);
  }

  /// True: it acts across gaps, and surfacesClose() adds a force.
  static constexpr bool acts_at_distance = Element::has_beside;
  /// True: also between neighbours that have not touched.
  static constexpr bool begins_apart = Element::begins_apart;

  void surfacesClose(SurfacesIntersectData& contact, ForceData& on_i, ForceData& on_j)
  {
    if constexpr (Element::has_beside)
      if (acts_across_gap(contact, on_i, on_j)) return;
    if (contact.contact_flags) *contact.contact_flags &= ~CONTACT_NORMAL_MODEL;
    if (!contact.contact_history) return;
    double* const history = history_of(contact.contact_history);
    if (State::largest(history) == 0.0 && !holds(history)) return;  // near neighbours that never touched: leave their cache lines alone
    if (books_later_) settle(entry_of(contact), effective_radius(contact), counts_.weight(contact), contact.contact_history);
    std::fill_n(history, Element::values, 0.0);
    counts_.forget(contact.contact_history);
    for (const int offset : {behind_offset_, crushed_offset_})
      if (offset >= 0) contact.contact_history[offset] = 0.0;
  }

  /// For EnergyTally::account: a contact that has no force of the element's, over a gap.
  void book_gap(const SurfacesIntersectData& contact) const
  {
    if constexpr (!Element::has_beside) energy_->booked = {.counts = entry_of(contact).counts};
  }

  ContactState state(const ContactPlace& contact) const override
  {
    const Law& law = pairs_.of(contact.itype, contact.jtype, contact.radius_i, contact.radius_j).element.normal;
    const double* const history = contact.history + history_offset_;
    const double delta_max = State::largest(history), impact_overlap = State::impact_overlap(history),
                 r_eff = contact.r_eff();
    double copy[State::values];
    std::copy_n(history, State::values, copy);
    const double now = std::max(contact.overlap - (crushed_offset_ >= 0 ? contact.history[crushed_offset_] : 0.0), 0.0);
    const double overlap = overlap_of_law(law, r_eff, now, stored_compliance(contact.history), copy);
    return {law.contact_radius(r_eff, overlap, delta_max, impact_overlap), delta_max,
            law.dissipated(r_eff, 0.0, delta_max, impact_overlap)};
  }

  bool books_later() const override { return books_later_; }
  void settle(const ContactPlace& contact, double weight) const override
  {
    if (State::largest(history_of(contact.history)) > 0.0)
      settle(pairs_.of(contact.itype, contact.jtype, contact.radius_i, contact.radius_j), contact.r_eff(), weight, contact.history);
  }

  void take_out(ContactStatistics& statistics, const ContactPlace& contact, double weight) const override
  {
    const double delta_max = contact.history[history_offset_];
    // types that have no law now have no counts, and all ranks must have the same
    const auto counts = statistics.pairs.find(pair_key(*setup_, contact.itype, contact.jtype));
    if (delta_max > 0.0 && counts != statistics.pairs.end())
      counts_.take_out(counts->second, contact.history, delta_max, contact.r_eff(), weight);
  }

  HandedOver hand_over(const ContactPlace& contact, const Vector& normal, double weight) const override
  {
    double* const history = history_of(contact.history);
    if (State::largest(history) == 0.0) return {};
    if (books_later_) settle(contact, weight);
    if (!(contact.overlap > 0)) return {};  // it ends
    const double r_eff = contact.r_eff();
    const Element& element = pairs_.of(contact.itype, contact.jtype, contact.radius_i, contact.radius_j).element;
    HandedOver found{State::largest(history), element.normal.stored_energy(r_eff, contact.overlap, State::largest(history), State::impact_overlap(history)), {}};
    ContactMotion at_rest;
    at_rest.r_eff = r_eff, at_rest.overlap = contact.overlap, at_rest.approach = 0.0, at_rest.advances = false;
    at_rest.m_eff = 1.0, at_rest.dt = lmp_->update->dt, at_rest.normal = normal;
    Ledger nothing;
    if constexpr (!Element::has_beside) found.shear = element.advance(at_rest, history, nothing).shear;
    return found;
  }

 private:
  /// The adapter's part in a step of the element.
  template <class Others>
  struct Caller
  {
    ElementHost& host;
    SurfacesIntersectData& contact;
    const Entry& entry;
    const ContactMotion& moves;
    double* history;
    ForceData &on_i, &on_j;
    Others& beside;
    const Ledger& ledger;
    double pushed = 0, depth = 0, by_law = 0;  // N, m and J, before the tangential law

    bool with_stiffness() const { return Radiates<Law> && host.pairs_.radiates(); }
    double impact_overlap(const Law&, const ContactMotion&) const { return host.first_impact_overlap(entry, moves.r_eff, contact); }
    bool books_later() const
    {
      if constexpr (Element::deepens || !BooksLater<Law>) return false;
      return host.books_later_;
    }
    void settle() const { host.settle(entry, moves.r_eff, host.counts_.weight(contact), contact.contact_history); }
    void deepens(double latched) const { host.counts_.look_at_stiffness(contact, entry, moves.r_eff, latched); }
    bool grows(double from, double latched) const { return host.counts_.grows(contact, entry, moves.r_eff, latched, from); }
    void press(const NormalForces& now, double& push, double& pressing)
    {
      if (host.parts_freely_) [[unlikely]]  // a member: a local flag costs every contact, 2 % of the instructions in a chute
        push = pressing = 0.0, host.parts_freely_ = false;
      host.add_normal(contact, push, on_i, on_j);
      pushed = push, depth = State::largest(history), by_law = ledger[Mechanism::plastic];
      if constexpr (!std::is_null_pointer_v<Others>) {
        const auto [k, dashpot] = entry.shear.contact(entry.element.normal, moves, history);
        contact.Fn = push, contact.kt = k, contact.gammat = dashpot;
        contact.kn = now.law / moves.overlap;  // secant: rolling model cdt takes kn*deltan as the force
        beside();
        pressing = contact.Fn;
      }
    }
  };

  const Entry& entry_of(const SurfacesIntersectData& contact) const
  {
    return pairs_.of(contact.itype, contact.jtype, contact.radi, contact.radj);
  }
  double* history_of(double* history) const { return history + history_offset_; }

  /// What a restart brings, or an earlier run, may be of another law; whatever it lost was booked.
  [[gnu::noinline, gnu::cold]] void begin_run(const Entry& entry, double r_eff, double* history) const
  {
    State::forget_derived(history);
    if constexpr (Element::has_beside) Beside::forget_derived(history + Element::beside_at);
    if constexpr (BooksLater<Law>)
      if (books_later_ && State::largest(history) > 0.0)
        entry.element.normal.settle(r_eff, State::largest(history), State::impact_overlap(history), history + State::own);
  }

  /// Books what a contact lost since it was last booked, and counts how deep it came. Not in the loop: contacts seldom turn.
  [[gnu::noinline]] void settle(const Entry& entry, double r_eff, double weight, double* contact_history) const
  {
    if constexpr (BooksLater<Law>) {
      const Law& law = entry.element.normal;
      double* const history = history_of(contact_history), *const own = history + State::own;
      const double largest = State::largest(history);
      if (entry.largest_overlap < 0.0 || !law.owes(r_eff, largest, own)) return;
      counts_.reach(entry, r_eff, law.booked(r_eff, own), largest, weight, contact_history);
      entry.counts->taken[Mechanism::plastic] += weight * law.settle(r_eff, largest, State::impact_overlap(history), own);
    }
  }

  /// Refuses surfaces for which the piece is not made, and what it does not go with.
  void check_beside(const Types& types, const ParticleSizes& sizes) const
  {
    for (const auto& [offset, word] : {std::pair(behind_offset_, "bodyCompliance on"), std::pair(crushed_offset_, "beyondRange crush")})
      if (offset >= 0) fail(setup_->where, fmt::format("'cohesion dent' is not made for '{}'", word));
    const double gravity = gravity_of(lmp_);
    pairs_.check_beside(*setup_, types, sizes, [&, this](const Element& element, double r_eff, double m_eff) {
      const double work = element.beside.length_of_w;
      if (!(work >= 0.0 && std::isfinite(work))) return fmt::format("'{}' must be 0 or more", Beside::property);
      if (!(element.beside.length_of_range > 0.0)) return fmt::format("'{}' must be over 0", Beside::range_property);
      const double bond = element.beside.smooth_pull_off(element.normal, r_eff) / (m_eff * gravity);  // of the stretched contact
      if (bond < 1.0 && bond * stretch_ >= 1.0)
        return fmt::format("the pull-off force is {:.3g} of the weight, with 'stretch {:g}' {:.3g}: particles that stick would fall off; at most "
                           "'stretch {:.3g}' here", bond * stretch_, stretch_, bond, bond * stretch_);
      return element.beside.fault(element.normal, r_eff);
    });
  }
  static bool holds([[maybe_unused]] const double* history)
  {
    if constexpr (Element::has_beside) return Beside{}.holds(history + Element::beside_at);
    return false;
  }
  /// Forces over a gap. True: the contact goes on.
  bool acts_across_gap(SurfacesIntersectData& contact, ForceData& on_i, ForceData& on_j)
  {
    if (!contact.contact_history) return false;
    const Entry& entry = entry_of(contact);
    if (!begins_apart && !holds(history_of(contact.contact_history))) {
      if (energy_) energy_->booked = {.counts = entry.counts};
      return false;
    }
    const double r_eff = effective_radius(contact);
    double parting = 0.0;
    for (int c = 0; c < 3; ++c) parting += (contact.v_i[c] - contact.v_j[c]) * contact.en[c];
    ContactMotion moves{{r_eff, contact.radsum - contact.r, -parting, contact.computeflag && contact.shearupdate}, contact.meff,
                        lmp_->update->dt, {contact.en[0], contact.en[1], contact.en[2]}, {}};
    add_rows(contact, moves);
    const Element& element = entry.element;
    double* const history = history_of(contact.contact_history);
    if (books_later_ && State::largest(history) > 0.0) settle(entry, r_eff, counts_.weight(contact), contact.contact_history);
    Ledger ledger;
    const double force = element.advance(moves, history, ledger).normal;
    if (moves.advances) counts_.book(contact, entry, ledger);
    if (energy_) energy_->booked = {.counts = entry.counts, .work = ledger[Mechanism::adhesion]};
    if (force != 0.0) add_normal(contact, force, on_i, on_j), contact.has_force_update = true;
    return element.beside.holds(history + Element::beside_at);
  }
  static constexpr bool has_rows = requires { Beside::particle_values; };
  /// The particles' own values, of a piece that has some.
  void add_rows(const SurfacesIntersectData& contact, ContactMotion& moves) const
  {
    if constexpr (has_rows) {
      double** const rows = ParticleColumns::find(lmp_, rows_of_beside).rows();
      moves.of_i = rows[contact.i], moves.of_j = contact.is_wall ? nullptr : rows[contact.j];
    }
  }
  static constexpr ParticleColumns::Spec rows_of_beside = [] {
    if constexpr (has_rows)
      return ParticleColumns::Spec{.name = Beside::particle_values, .columns = Beside::particle_count, .restart = true,
                                   .to_ghosts = true, .from_ghosts = false};
    else
      return ParticleColumns::Spec{};
  }();
  static MatrixProperty* number_of_beside(PropertyRegistry& registry, const char* caller, bool)
  {
    return MODEL_PARAMS::createPerTypePairProperty(registry, Beside::property, caller);
  }

  [[gnu::always_inline]] ContactMotion motion(const SurfacesIntersectData& s, double r_eff, bool advances, double shorter)
  {
    ContactMotion now{{r_eff, s.deltan, -s.vn, advances}, s.meff, lmp_->update->dt, {s.en[0], s.en[1], s.en[2]}, {s.vtr1, s.vtr2, s.vtr3}};
    if constexpr (Element::deepens) {
      if (std::exchange(at_table_end_, false)) now.dt = 0.0;
      double omega[3];  // walls do not turn
      for (int c = 0; c < 3; ++c) omega[c] = s.omega_i[c] - (s.is_wall ? 0.0 : s.omega_j[c]);
      now.rolling = cross(omega, s.en);
      if (shorter != 0.0)  // nearer to the centre the spin moves the surface less
        now.slide = sum(now.slide, cross(Vector{s.omega_i[0], s.omega_i[1], s.omega_i[2]}, now.normal), shorter);
    }
    add_rows(s, now);
    return now;
  }
  /// m, by which the tangential force acts nearer to the centre than LIGGGHTS has it. On a rigid wall that is at
  /// R - d, with the overlap d of the real contact; LIGGGHTS says R - d/2, which two like bodies have.
  double shorter_lever(const SurfacesIntersectData& s, const Entry& entry) const
  {
    if constexpr (requires { entry.element.tangential.yields(); })
      if (s.is_wall && rigid_wall_ && entry.element.tangential.yields()) return s.cri - (s.radi - s.deltan / stretch_);
    return 0.0;
  }

  void add_normal(const SurfacesIntersectData& s, double normal, ForceData& on_i, ForceData& on_j) const
  {
    const double force = s.is_wall ? normal * s.area_ratio : normal;
    for (int c = 0; c < 3; ++c) {
      on_i.delta_F[c] += force * s.en[c];
      if (!s.is_wall) on_j.delta_F[c] -= force * s.en[c];
    }
    add_normal_torque(s, lmp_->atom->x, force, on_i, on_j);
  }
  static void add_couple(const SurfacesIntersectData& s, const Vector& couple, ForceData& on_i, ForceData& on_j)
  {
    const double share = s.is_wall ? s.area_ratio : 1.0;
    for (int c = 0; c < 3; ++c) {
      on_i.delta_torque[c] += couple[c] * share;
      if (!s.is_wall) on_j.delta_torque[c] -= couple[c];
    }
  }

  /// X of a contact that begins.
  [[gnu::noinline]] double first_impact_overlap(const Entry& entry, double r_eff,
                                                SurfacesIntersectData sidata) const
  {
    if constexpr (LatchesImpact<Law>)
      return entry.element.normal.impact_overlap(r_eff, contact_mass(setup_->session->bodies, sidata), -sidata.vn);
    return 0.0;
  }

  BeyondRange beyond_range() const { return setup_->options.beyond_range.value_or(BeyondRange::stop); }

  /// The law's overlap: without what bodies behind the contact take, and what was crushed.
  [[gnu::noinline]] double changed_overlap(SurfacesIntersectData sidata, const Entry& entry, double r_eff, double* history) const
  {
    double crushed = crushed_offset_ >= 0 ? sidata.contact_history[crushed_offset_] : 0.0;
    double overlap = std::max(sidata.deltan - crushed, 0.0);
    if (behind_offset_ >= 0)
      overlap = overlap_of_law(entry.element.normal, r_eff, overlap, compliance_behind(sidata, entry, State::largest(history)), history);
    return crushed_offset_ >= 0 && overlap > entry.largest_overlap * r_eff ? crush(sidata, entry, r_eff, overlap, history) : overlap;
  }

  /// Beyond the table's end the force stays: the law's overlap, which is the end. What is beyond is lost for good.
  double crush(const SurfacesIntersectData& sidata, const Entry& entry, double r_eff, double overlap, double* history) const
  {
    const double end = entry.largest_overlap * r_eff, from = State::largest(history);
    if (end < 0.0) return overlap;  // there is no law
    double& crushed = sidata.contact_history[crushed_offset_];
    if (sidata.computeflag && sidata.shearupdate) {
      const double force = entry.element.normal.force(r_eff, end, std::max(from, end), State::impact_overlap(history), history + State::own);
      counts_.crush(sidata, entry, r_eff, force, overlap - end, crushed == 0.0, from == 0.0);
      crushed += overlap - end;
    }
    return end;
  }

  /// m/N, of the bodies behind the contact. It stays that of the first touch: while a clump turns over a contact the
  /// force is then a function of its overlap alone, and no closed path gains energy.
  [[gnu::noinline]] double compliance_behind(SurfacesIntersectData sidata, const Entry& entry, double delta_max) const
  {
    double& history = sidata.contact_history[behind_offset_];
    const Bodies& bodies = setup_->session->bodies;
    if (delta_max > 0.0) return history;
    if (!bodies.known() && !sidata.is_non_spherical) return 0.0;
    const auto [i, j] = bodies_at_contact(sidata, bodies, *lmp_->atom);
    double sum = entry.behind_i * reach_behind(i.radius, i.height);
    if (!sidata.is_wall) sum += entry.behind_j * reach_behind(j.radius, j.height);
    if (sidata.computeflag && sidata.shearupdate) history = sum;
    return sum;
  }
  double stored_compliance(const double* history) const { return behind_offset_ >= 0 ? history[behind_offset_] : 0.0; }

  /// m/s, for a message.
  double approach(const SurfacesIntersectData& sidata) const
  {
    if (!std::isfinite(sidata.vn))
      stop_one(lmp_, fmt::format("{}: the velocity of particle {} or of what it touches is not a number",
                                setup_->where, lmp_->atom->tag[sidata.i]));
    return 0.0 - sidata.vn * units_.length;  // 0 of two at rest, not -0
  }

  [[gnu::noinline, gnu::cold]] void check_stretched(SurfacesIntersectData sidata, double r_eff)
  {
    if (stretch_ > 1.0 && sidata.deltan > stretched_overlap_limit * r_eff)
      stop_one(lmp_, fmt::format("{}: 'stretch {:g}' takes the overlap of types {} and {} to {:.4g} R* at "
                                "{:.4g} m/s; {} R* is the limit: stretch less",
                                setup_->where, stretch_, sidata.itype, sidata.jtype, sidata.deltan / r_eff,
                                approach(sidata), stretched_overlap_limit));
  }

  /// Only with `energy on`: the part of the step that the element has booked, for EnergyTally::account, and the contact's energies.
  /// `depth`, `by_law`: depth behind the normal law, and what that lost; the tangential law may have taken the depth further.
  [[gnu::noinline, gnu::cold]] void book_energy(SurfacesIntersectData contact, const Entry& entry, double r_eff, double law_force,
                                                double depth, double by_law, Ledger ledger) const
  {
    const Law& law = entry.element.normal;
    double* const history = history_of(contact.contact_history);
    const double now = State::largest(history), delta = contact.deltan;  // now 0: it begins, in a step that keeps nothing
    const double latched = now > 0.0 ? State::impact_overlap(history) : first_impact_overlap(entry, r_eff, contact);
    const double share = contact.is_wall ? contact.area_ratio : 1.0, stored = law.stored_energy(r_eff, delta, now, latched);
    EnergyTally::Booked& booked = energy_->booked;
    booked = {.counts = entry.counts, .law_force = law_force * share, .law_force_after = law_force * share};
    if (now != depth) {
      booked.law_force_after = law.force(r_eff, delta, now, latched, history + State::own) * share;
      booked.deepened = ledger[Mechanism::plastic] - by_law + stored - law.stored_energy(r_eff, delta, depth, latched);
    }
    booked.work = booked.deepened + ledger[Mechanism::waves] + ledger[Mechanism::shear] + ledger[Mechanism::adhesion];
    const int nlocal = lmp_->atom->nlocal;
    energy_->share(contact, EnergyTally::dissipated, ledger[Mechanism::plastic], nlocal);
    if (contact.computeflag)
      energy_->share(contact, EnergyTally::stored, stored + energy_behind(stored_compliance(contact.contact_history), law_force), nlocal);
  }

  /// A contact deeper than the law's table. One that no motion brought there is given the force of the table's end, or none.
  void beyond_law(SurfacesIntersectData& contact, const Entry& entry, double r_eff, double delta_max)
  {
    if (!began_beyond(contact, entry, r_eff, delta_max)) {
      check_stretched(contact, r_eff);
      return beyond_table(contact, entry, r_eff);
    }
    contact.deltan = entry.largest_overlap * r_eff;
    at_table_end_ = Element::deepens;
    parts_freely_ = parts_freely(contact, entry, r_eff);
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
    return sidata.vn > 0.0 && 0.5 * sidata.meff * sidata.vn * sidata.vn > entry.element.normal.stored_energy(r_eff, end, end, 0.0);
  }

  [[gnu::noinline, gnu::cold]] void beyond_table(SurfacesIntersectData sidata, const Entry& entry,
                                                 double r_eff)
  {
    if (entry.largest_overlap < 0)
      stop_one(
          lmp_,
          fmt::format("{}: no law for particles of type {} against {} {}; it was not among the pairs "
                      "that the deck could show when the run began",
                      setup_->where, sidata.itype, sidata.is_wall ? "a wall of type" : "type", sidata.jtype));
    if (sidata.computeflag && sidata.shearupdate) entry.counts->beyond += counts_.weight(sidata);
    // 5 %: the linear continuation is still within about a percent of the force there.
    if (beyond_range() != BeyondRange::stop || !(sidata.deltan > 1.05 * entry.largest_overlap * r_eff))
      return;
    const double speed = approach(sidata);
    entry.counts->overlap_max = std::max(entry.counts->overlap_max, sidata.deltan / r_eff);
    stop_one(lmp_, fmt::format("{}: overlap/R* {:.4g} of types {} and {} {} {:.4g} m/s is more than 5 % beyond "
                              "the law's table, which ends at {:.4g}{}, or say 'beyondRange crush', or {}",
                              setup_->where, sidata.deltan / r_eff, sidata.itype, sidata.jtype,
                              speed < 0 ? "parting at" : "at", std::abs(speed), entry.largest_overlap,
                              remedy(entry, sidata.deltan / r_eff), for_pressed_beds));
  }

  /// " (what was planned): what holds this overlap".
  std::string remedy(const Entry& entry, double overlap) const
  {
    if constexpr (requires { entry.element.normal.law().curve->end(); }) {
      const granulaw::Law& law = setup_->law->law;
      const std::string &a = entry.counts->info.a, &b = entry.counts->info.b, planned = planned_text(law, a, b, stretch_);
      return fmt::format("{}: {}", planned.empty() ? "" : " (" + planned + ")",
                         remedy_beyond(law, a, b, overlap / stretch_, entry.largest_overlap / stretch_, entry.element.normal.law().curve->end()));
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
      stop_one(lmp_, fmt::format("{}: this LIGGGHTS lays out its contact data differently (was it built with "
                                "superquadrics?)",
                                setup_->where));
  }

  LAMMPS* lmp_;
  Physics physics_;
  const Setup* setup_ = nullptr;
  Table pairs_;
  ContactCounts<Entry> counts_;
  EnergyTally* energy_ = nullptr;  // null: energy off
  int history_offset_;             // of the element's values
  int behind_offset_ = -1;         // of the compliance of bodies behind a contact; -1: `bodyCompliance` is off
  int crushed_offset_ = -1;        // of the length crushed; -1: `beyondRange` is not crush
  bool changes_overlap_ = false;   // either of the two is there
  bool books_later_ = false;       // contacts that go deeper are booked when they turn
  bool rigid_wall_ = false;
  LAMMPS_NS::bigint first_step_ = 0;  // of this run
  double stretch_ = 1.0;
  DeckUnits units_;
  bool tangential_damping_ = true, no_limit_ = false, elastic_potential_ = false, no_heating_ = false;
  bool layout_checked_ = false;
  bool at_table_end_ = false;          // the contact at hand began beyond the table: its overlap stays at the table's end
  bool parts_freely_ = false;  // the contact at hand began beyond the table and gets no force
};

}  // namespace granulaw::plugin
