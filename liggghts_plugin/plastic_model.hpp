#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "law/pair.hpp"
#include "liggghts_plugin/contact_work.hpp"
#include "liggghts_plugin/deck_units.hpp"
#include "liggghts_plugin/liggghts.hpp"
#include "liggghts_plugin/particle_sizes.hpp"
#include "liggghts_plugin/session.hpp"
#include "liggghts_plugin/superquadric.hpp"

namespace granulaw::plugin {

/// What a law needs to know about the atom types when a run begins. Index 0 is unused: types count from 1.
struct Types
{
  int count = 0;
  DeckUnits units;
  std::vector<double> youngs_modulus, poisson_ratio;  ///< Pa, -; NaN where no particle or wall has the type
  std::vector<int> of_particles;                      ///< type of a particle that exists or can be inserted
  std::vector<int> of_wall;                           ///< type of this wall (walls only)
  std::vector<double> density_low, density_high;      ///< kg/m^3 of existing particles; low > high: none
};

/// Collective. Throws Error if a property is missing or the units are neither SI nor cgs.
Types gather_types(LAMMPS_NS::LAMMPS* lmp, PropertyRegistry& registry, const Setup& setup);

/// Throws Error where the deck sets coefficientRestitution and does not say with `elasticDamping` whether it
/// is to be used: a Hertz deck's value holds the plastic loss that the law itself computes.
void refuse_unstated_restitution(LAMMPS_NS::LAMMPS* lmp, const Setup& setup);
/// The damping ratio Z of each pair of types, at [i * (count + 1) + j].
std::vector<double> damping_ratios(PropertyRegistry& registry, const Setup& setup, const Types& types);
/// A contact that begins deeper than so many times what the motion of a step can bring did not begin by
/// motion: particles were inserted into each other, or an edge of a mesh handed a pressed sphere over. Walls
/// may move at another point of the step than spheres, so that twice the motion is possible.
inline constexpr double sudden_start = 2.0;

/// The history policy that `mpm` and `thornton` share, and everything else that is not the law itself.
///
/// State: one scalar per contact, delta_max, the largest overlap since first touch (m), and, where the
/// physics latches it, a second one, the impact overlap X of the law's velocity axis (over lambda R*), set in
/// the first step from the approach speed. Both have newton flag "0" (the same number seen from either
/// particle), advance only when the step does (computeflag and shearupdate), and return to zero when the
/// geometric overlap ends. What follows from them for un- and reloading, the reversal, is kept beside them
/// once it was worked out; without it the same is worked out again, to the bit.
///
/// Physics is a value type without virtual calls:
///   name                                             "mpm", "thornton"
///   latches_impact                                   whether contacts keep X
///   Contact::reversal_values                             how many values they keep of their last reversal
///   Contact                                          law of one pair of types: force, dissipated, ...
///   prepare(lmp, registry, setup, types)             checks of the deck against the law
///   resolve(i, j, rigid, where) -> Contact           throws Error where there is no law for the pair
///   check_sizes(i, j, is_wall, contact, sizes)       throws Error where the pair's law is of another size
///
/// Everything that a Contact takes and gives is in the deck's units, and stretched (`stretch S`): delta_max
/// and the contact statistics' overlaps are the deck's own, S times the real ones; work needs no conversion,
/// because F(d/S)/S does the same work to S times the overlap. X stays the unstretched law's.
template <class Physics>
class PlasticModel : public NormalModelBase, public ContactInquiry
{
 public:
  PlasticModel(LAMMPS* lmp, IContactHistorySetup* hsetup, ContactModelBase* cmb)
      : NormalModelBase(lmp, hsetup, cmb)
  {
    history_offset_ = hsetup->add_history_value("delta_max", "0");
    cmb->add_history_offset("delta_max", history_offset_);
    if constexpr (Physics::latches_impact) {
      impact_offset_ = hsetup->add_history_value("impact_overlap", "0");
      cmb->add_history_offset("impact_overlap", impact_offset_);
    }
    if constexpr (keeps_reversals) {
      reversal_offset_ = hsetup->add_history_value("turn_overlap", "0");
      for (std::size_t k = 1; k < Physics::Contact::reversal_values; ++k)
        hsetup->add_history_value(fmt::format("turn_{}", k), "0");
    }
    if (superquadrics_built && atom->superquadric_flag)
      radius_offset_ = hsetup->add_history_value("curvature_radius", "0");
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
    if (setup_->session->contact_map) speed_offset_ = hsetup->add_history_value("impact_speed", "0");
    if (elastic_potential_)
      fail(setup_->where,
           "'computeElasticPotential' is not available with this model: 'energy on' gives the elastic energy "
           "of each "
           "particle's contacts, f_granulaw[1] in a dump");
    damping_ =
        tangential_damping_ ? setup_->options.tangential_damping.value_or(default_tangential_damping) : 0.0;
    tangential_computed_ = setup_->options.tangential_computed.value_or(false);
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
    const bool any_needs_mass = resolve_all(types, damping_ratios(registry, *setup_, types));
    Bodies::provide(lmp, any_needs_mass);
    open_tally(types);
  }

  double stressStrainExponent() { return 1.5; }

  void surfacesIntersect(SurfacesIntersectData& sidata, ForceData& i_forces, ForceData& j_forces)
  {
    if (sidata.contact_flags) *sidata.contact_flags |= CONTACT_NORMAL_MODEL;
    const double r_eff = effective_radius(sidata);
    const Entry& entry = this->entry(sidata.itype, sidata.jtype);
    const double delta = sidata.deltan;
    double& delta_max = sidata.contact_history[history_offset_];
    if (delta > entry.largest_overlap * r_eff) [[unlikely]] {
      check_stretched(sidata, r_eff);
      beyond_table(sidata, entry, r_eff);
    }
    if (sidata.is_wall && !layout_checked_) [[unlikely]]
      check_layout(sidata);

    double impact_overlap = 0.0;
    if constexpr (Physics::latches_impact)
      impact_overlap = delta_max == 0.0
                           ? entry.contact.impact_overlap(r_eff, contact_mass(sidata), -sidata.vn)
                           : sidata.contact_history[impact_offset_];
    double* const reversal = sidata.contact_history + reversal_offset_;
    if constexpr (keeps_reversals)
      if (update->ntimestep == first_step_) [[unlikely]]
        reversal[0] = 0.0;  // what a restart brings may be of another law
    const double law_force = entry.contact.force(r_eff, delta, delta_max, impact_overlap, reversal);
    const double root = std::sqrt(r_eff * delta);
    const double radius =
        tangential_computed_ ? entry.contact.contact_radius(r_eff, delta, delta_max, impact_overlap) : root;
    const double impedance = std::sqrt(root * sidata.meff);  // both dampings are proportional to it
    // of an undamped contact the law's force itself, to the bit: it is never negative
    sidata.gamman = damping_of(entry, r_eff, delta, delta_max, sidata.vn) * impedance;
    // below the residual overlap of a dent nothing touches, and nothing is damped
    const double normal_force = law_force > 0.0 ? std::max(0.0, law_force - sidata.gamman * sidata.vn) : 0.0;
    if (delta > delta_max && sidata.computeflag && sidata.shearupdate) {
      if constexpr (Physics::latches_impact) sidata.contact_history[impact_offset_] = impact_overlap;
      advance(sidata, entry, r_eff, impact_overlap, delta_max);
    }
    if (energy_) [[unlikely]]
      store_energy(sidata, entry, r_eff, delta_max, impact_overlap, law_force);

    sidata.Fn = normal_force;
    sidata.kn =
        delta > 0.0 ? law_force / delta : 0.0;  // secant: rolling model cdt takes kn*deltan as the force
    sidata.kt = entry.tangential * radius;
    sidata.gammat = tangential_computed_ ? 2.0 * damping_ * std::sqrt(sidata.kt * sidata.meff)
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
    double& delta_max = scdata.contact_history[history_offset_];
    if (delta_max == 0.0) return;  // near neighbours that never touched: leave their cache lines alone
    // it stays in the histogram, at its largest overlap
    if (speed_offset_ >= 0) [[unlikely]]
      scdata.contact_history[speed_offset_] = 0.0;
    delta_max = 0.0;
    if constexpr (Physics::latches_impact) scdata.contact_history[impact_offset_] = 0.0;
    if constexpr (keeps_reversals) scdata.contact_history[reversal_offset_] = 0.0;
  }

  ContactState state(const ContactPlace& contact) const override
  {
    const Entry& pair = entry(contact.itype, contact.jtype);
    const double delta_max = contact.history[history_offset_];
    double impact_overlap = 0.0;
    if constexpr (Physics::latches_impact) impact_overlap = contact.history[impact_offset_];
    return {pair.contact.contact_radius(contact.r_eff, contact.overlap, delta_max, impact_overlap), delta_max,
            pair.contact.dissipated(contact.r_eff, 0.0, delta_max, impact_overlap)};
  }

  void take_out(ContactStatistics& statistics, const ContactPlace& contact, double weight) const override
  {
    const double delta_max = contact.history[history_offset_];
    if (delta_max > 0.0)
      count(statistics.pairs[key(contact.itype, contact.jtype)], contact.history, delta_max,
            radius_at_largest(contact.history, contact.r_eff), -weight);
  }

  void beginPass(SurfacesIntersectData&, ForceData&, ForceData&) {}
  void endPass(SurfacesIntersectData&, ForceData&, ForceData&) {}

 private:
  static constexpr bool keeps_reversals = Physics::Contact::reversal_values > 0;

  // One pair of types, in the deck's units; what every step reads lies in the first cache line.
  struct alignas(64) Entry
  {
    double largest_overlap = -1.0;    // over R*, that the law answers for; -1: no law for this pair of types
    double tangential = 0.0;          // k_t over the contact radius: 8 G* (Mindlin), stretched
    double damping = 0.0;             // normal damping over sqrt(sqrt(R* d) m*)
    double tangential_damping = 0.0;  // Mindlin's, over the same
    double yield_overlap = 0.0;       // over R*
    typename Physics::Contact contact;
    ContactStatistics::Pair* counts = nullptr;  // this pair of types in the contact statistics
    double damage_number_per_speed2 =
        0.0;  // I = rho V^2/Y of the yielding body over (relative speed)^2, s^2/m^2
  };

  static double shear_compliance(double youngs_modulus, double poisson_ratio)
  {
    return 2.0 * (2.0 - poisson_ratio) * (1.0 + poisson_ratio) / youngs_modulus;
  }

  Entry& entry(int itype, int jtype) { return entries_[static_cast<std::size_t>(itype * stride_ + jtype)]; }
  const Entry& entry(int itype, int jtype) const
  {
    return entries_[static_cast<std::size_t>(itype * stride_ + jtype)];
  }

  PairKey key(int itype, int jtype) const
  {
    if (!setup_->wall) return {PairKey::particles, std::min(itype, jtype), std::max(itype, jtype)};
    return {setup_->options.deformable_wall ? PairKey::deformable_wall : PairKey::rigid_wall, itype, jtype};
  }

  // Entry::damping where the law is elastic, else 0. Elastic is a contact that never yielded, both ways; a
  // yielded one on its way back to delta_max, but not when it parts, so that the rebound of a plastic impact
  // is the law's own. Without a branch: in a bed contacts approach and part at random.
  static double damping_of(const Entry& entry, double r_eff, double delta, double delta_max, double vn)
  {
    const bool returns = (delta < delta_max) & (vn < 0.0);
    const bool elastic = std::max(delta, delta_max) <= entry.yield_overlap * r_eff;
    return entry.damping * static_cast<double>(returns | elastic);
  }

  [[gnu::noinline, gnu::cold]] void check_stretched(const SurfacesIntersectData& sidata, double r_eff)
  {
    if (stretch_ > 1.0 && sidata.deltan > stretched_overlap_limit * r_eff)
      stop_one(lmp, fmt::format("{}: 'stretch {:g}' takes the overlap of types {} and {} to {:.4g} R* at "
                                "{:.4g} m/s; {} R* is the limit: stretch less",
                                setup_->where, stretch_, sidata.itype, sidata.jtype, sidata.deltan / r_eff,
                                -sidata.vn * units_.length, stretched_overlap_limit));
  }

  /// True if the law of any pair asks for the mass of the bodies.
  bool resolve_all(const Types& types, const std::vector<double>& damping_ratio)
  {
    bool needs_mass = false;
    units_ = types.units;
    const bool is_wall = setup_->wall != nullptr, rigid = is_wall && !setup_->options.deformable_wall;
    stride_ = types.count + 1;
    entries_.assign(static_cast<std::size_t>(stride_ * stride_), Entry{});
    for (int i = 1; i <= types.count; ++i)
      for (int j = 1; j <= types.count; ++j) {
        const bool needed = types.of_particles[i] && (is_wall ? types.of_wall[j] : types.of_particles[j]);
        Entry& entry = entries_[static_cast<std::size_t>(i * stride_ + j)];
        if (std::isnan(types.youngs_modulus[i]) || std::isnan(types.youngs_modulus[j])) continue;
        try {
          entry.contact = physics_.resolve(i, j, rigid, setup_->where);
        } catch (const granulaw::Error&) {
          if (needed) throw;
          continue;  // beyond_table() says so if such particles meet after all
        }
        needs_mass = needs_mass || entry.contact.needs_mass();
        entry.largest_overlap = entry.contact.largest_overlap();
        if (stretch_ > 1.0) entry.largest_overlap = std::min(entry.largest_overlap, stretched_overlap_limit);
        entry.yield_overlap = entry.contact.yield_overlap();
        entry.damage_number_per_speed2 = entry.contact.damage_number_per_speed2();
        const double eight_shear_moduli =
            8.0 /
            (shear_compliance(types.youngs_modulus[i], types.poisson_ratio[i]) +
             shear_compliance(types.youngs_modulus[j], types.poisson_ratio[j])) /
            units_.pressure();
        // k_t,s(d) = k_t(d/s)/s^2; Mindlin's radius is of the stretched overlap: another 1/sqrt(s)
        entry.tangential = eight_shear_moduli * std::pow(stretch_, tangential_computed_ ? -2.0 : -2.5);
        entry.tangential_damping = 2.0 * damping_ * std::sqrt(entry.tangential);
        // sqrt(5) Z sqrt(k m) d^(1/4) makes e = exp(-pi Z/sqrt(1 - Z^2)) at every speed (Antypov & Elliott
        // 2011); k = 4/3 E* sqrt(R*), stretched 1/s^2.5
        entry.damping = std::sqrt(5.0) * damping_ratio[static_cast<std::size_t>(i * stride_ + j)] *
                        std::sqrt(4.0 / 3.0 * entry.contact.pair_modulus()) * std::pow(stretch_, -1.25);
      }
    return needs_mass;
  }

  /// Finds each pair of types its line in the statistics, and writes there what the law says about it.
  void open_tally(const Types& types)
  {
    const ParticleSizes sizes = particle_sizes(lmp);
    const bool is_wall = setup_->wall != nullptr;
    for (int i = 1; i <= types.count; ++i)
      for (int j = 1; j <= types.count; ++j) {
        Entry& entry = entries_[static_cast<std::size_t>(i * stride_ + j)];
        if (entry.largest_overlap < 0) continue;
        const PairKey key = this->key(i, j);
        entry.counts = &setup_->session->statistics.pairs[key];
        if (!is_wall && j < i) continue;  // described as i, j
        const double other_radius = is_wall ? 0.0 : sizes.radius[j];
        double r_eff = is_wall ? sizes.radius[i] : granulaw::effective_radius(sizes.radius[i], other_radius);
        double m_eff = is_wall ? sizes.mass[i] : granulaw::effective_mass(sizes.mass[i], sizes.mass[j]);
        if (!std::isfinite(r_eff) || !std::isfinite(m_eff)) r_eff = m_eff = 0.0;
        PairInfo info = describe(entry.contact, *setup_, key, r_eff, m_eff);
        info.needed = types.of_particles[i] && (is_wall ? types.of_wall[j] : types.of_particles[j]);
        if (info.needed) physics_.check_sizes(i, j, is_wall, entry.contact, sizes);
        if (info.needed) refuse_rated(lmp, *setup_, entry.contact.min_speed(1.0, 1.0) > 0);
        entry.counts->info = info;
      }
    energy_ = setup_->session->energy;
  }

  /// kg, the mass that the contact's normal velocity sees: where a sphere is part of a rigid body and is hit
  /// beside its centre, less than the body's.
  double contact_mass(const SurfacesIntersectData& sidata) const
  {
    const Bodies& bodies = setup_->session->bodies;
    if (!bodies.known()) [[likely]]
      return sidata.meff;
    if (sidata.is_wall) return 1.0 / bodies.inverse_mass(sidata.i, sidata.en, sidata.mi);
    // a frozen sphere leaves the other's mass as the effective one
    double inverse = 0.0;
    if (sidata.meff != sidata.mj) inverse += bodies.inverse_mass(sidata.i, sidata.en, sidata.mi);
    if (sidata.meff != sidata.mi) inverse += bodies.inverse_mass(sidata.j, sidata.en, sidata.mj);
    return inverse > 0.0 ? 1.0 / inverse : sidata.meff;
  }

  /// Part of a contact that this rank accounts for: see ContactStatistics.
  double weight(const SurfacesCloseData& scdata) const
  {
    return scdata.is_wall || scdata.j < atom->nlocal ? 1.0 : 0.5;
  }

  /// A step that takes the contact deeper than it ever was: statistics, then history.
  void advance(const SurfacesIntersectData& sidata, const Entry& entry, double r_eff, double impact_overlap,
               double& delta_max)
  {
    ContactStatistics::Pair& counts = *entry.counts;
    const double weight = this->weight(sidata);
    const double delta = sidata.deltan;
    bool sudden = false;
    if (delta_max == 0.0) {
      const double speed = std::max(0.0, -sidata.vn);
      counts.touches += weight;
      counts.speed.add(speed, weight);
      counts.speed_min = std::min(counts.speed_min, speed);
      counts.speed_max = std::max(counts.speed_max, speed);
      counts.damage_number_max =
          std::max(counts.damage_number_max, entry.damage_number_per_speed2 * speed * speed);
      const double mass = contact_mass(sidata);
      if (speed > entry.contact.max_speed(r_eff, mass)) counts.too_fast += weight;
      // one without approach follows the law at no rate: the file holds that
      if (speed > 0.0 && speed < entry.contact.min_speed(r_eff, mass)) counts.too_slow += weight;
      if (speed_offset_ >= 0) [[unlikely]]
        sidata.contact_history[speed_offset_] = speed;
      // of superquadrics rotations bring overlap, too
      sudden = !sidata.is_non_spherical && delta > sudden_start * overlap_of_a_step(sidata);
    }
    if (delta > counts.overlap_max * r_eff) counts.overlap_max = delta / r_eff;
    if (delta > near_edge * entry.largest_overlap * r_eff) [[unlikely]] {
      if (delta_max <= near_edge * entry.largest_overlap * r_eff) counts.near += weight;
      if (delta > entry.largest_overlap * r_eff && delta_max <= entry.largest_overlap * r_eff)
        counts.past += weight;
    }
    // Hertz's frequency grows as R* delta/m*^2 does: only a contact that leads by this measure is looked at
    if (r_eff * delta > counts.hardest * sidata.meff * sidata.meff) [[unlikely]] {
      counts.hardest = r_eff * delta / (sidata.meff * sidata.meff);
      counts.frequency2 = std::max(
          counts.frequency2, stiffness(entry.contact, r_eff, delta, impact_overlap) / contact_mass(sidata));
    }
    move_in_histogram(counts, sidata.contact_history, delta_max, delta, r_eff, weight);
    if (sudden) [[unlikely]] {  // no motion paid for what it holds
      counts.sudden += weight;
      counts.brought += weight * stored_energy(entry.contact, r_eff, delta, delta, impact_overlap);
    } else {
      const double dissipated = entry.contact.dissipated(r_eff, delta_max, delta, impact_overlap);
      counts.dissipated += weight * dissipated;
      if (energy_) [[unlikely]]
        energy_->share(sidata, EnergyTally::dissipated, dissipated, atom->nlocal);
    }
    delta_max = delta;
  }

  /// The largest overlap that the motion of the last step can have brought two spheres to that did not touch
  /// before: of |d n + v dt|^2 >= (d + delta)^2, with the velocities of the half step behind.
  double overlap_of_a_step(const SurfacesIntersectData& sidata) const
  {
    double speed2 = 0.0;
    for (int c = 0; c < 3; ++c) {
      const double v = sidata.v_i[c] - sidata.v_j[c];
      speed2 += v * v;
    }
    const double dt = update->dt;
    return std::abs(sidata.vn) * dt + 0.5 * speed2 * dt * dt / sidata.r;
  }

  /// R* at the contact's largest overlap, where that of superquadrics was another.
  double radius_at_largest(const double* history, double r_eff) const
  {
    return superquadrics_built && radius_offset_ >= 0 ? history[radius_offset_] : r_eff;
  }

  /// Moves a contact that grows from `from` to `to` (0: it begins) to its bin: see
  /// ContactStatistics::Pair::overlap.
  void move_in_histogram(ContactStatistics::Pair& counts, double* history, double from, double to,
                         double r_eff, double weight) const
  {
    // most steps stay within a bin; R* of superquadrics may change
    const bool stays = !superquadrics_built && from > 0.0 &&
                       counts.overlap.ends_above(counts.overlap.bin(from / r_eff), to / r_eff);
    if (!stays) [[unlikely]]
      change_bin(counts, history, from, to, r_eff, weight);
  }

  [[gnu::noinline]] void change_bin(ContactStatistics::Pair& counts, double* history, double from, double to,
                                    double r_eff, double weight) const
  {
    if (from > 0.0) count(counts, history, from, radius_at_largest(history, r_eff), -weight);
    count(counts, history, to, r_eff, weight);
    if (superquadrics_built && radius_offset_ >= 0) history[radius_offset_] = r_eff;
  }

  /// Counts a contact of largest overlap `delta` in the histograms: see ContactStatistics::Pair::overlap.
  void count(ContactStatistics::Pair& counts, const double* history, double delta, double r_eff,
             double weight) const
  {
    counts.count(counts.overlap.bin(delta / r_eff), speed_offset_ >= 0 ? history[speed_offset_] : -1.0,
                 weight);
  }

  /// Only with `energy on`: what the contact holds now, and the law's force for EnergyTally::account.
  [[gnu::noinline, gnu::cold]] void store_energy(const SurfacesIntersectData& sidata, const Entry& entry,
                                                 double r_eff, double delta_max, double impact_overlap,
                                                 double law_force)
  {
    energy_->law_force = law_force * (sidata.is_wall ? sidata.area_ratio : 1.0);
    energy_->counts = entry.counts;
    if (sidata.computeflag)
      energy_->share(sidata, EnergyTally::stored,
                     stored_energy(entry.contact, r_eff, sidata.deltan, delta_max, impact_overlap),
                     atom->nlocal);
  }

  [[gnu::noinline, gnu::cold]] void beyond_table(const SurfacesIntersectData& sidata, const Entry& entry,
                                                 double r_eff)
  {
    if (entry.largest_overlap < 0)
      stop_one(
          lmp,
          fmt::format("{}: no law for particles of type {} against {} {}; it was not among the pairs "
                      "that the deck could show when the run began",
                      setup_->where, sidata.itype, sidata.is_wall ? "a wall of type" : "type", sidata.jtype));
    if (sidata.computeflag && sidata.shearupdate) entry.counts->beyond += weight(sidata);
    // 5 %: the linear continuation is still within about a percent of the force there.
    if (setup_->options.stop_beyond_range.value_or(true) &&
        sidata.deltan > 1.05 * entry.largest_overlap * r_eff)
      stop_one(lmp,
               fmt::format("{}: overlap/R* {:.4g} of types {} and {} at {:.4g} m/s is more than 5 % beyond "
                           "the law's table, which ends at {:.4g}: build a deeper law, or say "
                           "'beyondRange continue'",
                           setup_->where, sidata.deltan / r_eff, sidata.itype, sidata.jtype,
                           -sidata.vn * units_.length, entry.largest_overlap));
  }

  /// In a library with another layout of SurfacesIntersectData these two would not agree.
  [[gnu::noinline, gnu::cold]] void check_layout(const SurfacesIntersectData& sidata)
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
  std::vector<Entry> entries_;
  int stride_ = 0;
  int history_offset_ = -1, impact_offset_ = -1;
  int reversal_offset_ = 0;           // of the values of its reversal
  LAMMPS_NS::bigint first_step_ = 0;  // of this run
  int radius_offset_ = -1;            // of R* at the largest overlap; superquadrics only
  int speed_offset_ = -1;             // of the approach speed at first touch; only with `contactMap on`
  double damping_ = 0.0, stretch_ = 1.0;
  DeckUnits units_;
  bool tangential_computed_ = false;
  EnergyTally* energy_ = nullptr;  // null: energy off
  bool tangential_damping_ = true, limit_force_ = false, elastic_potential_ = false;
  bool layout_checked_ = false;
};

}  // namespace granulaw::plugin
