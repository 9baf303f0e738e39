#pragma once

#include <algorithm>
#include <cmath>

#include "contact/element.hpp"
#include "liggghts_plugin/books/energy_tally.hpp"
#include "liggghts_plugin/contact/normal_physics.hpp"
#include "liggghts_plugin/deck/session.hpp"
#include "liggghts_plugin/engine/shapes.hpp"
#include "liggghts_plugin/particles/bodies.hpp"

namespace granulaw::plugin {

/// A contact that begins deeper than so many times what the motion of a step can bring did not begin by
/// motion: particles were inserted into each other, or an edge of a mesh handed a pressed sphere over. Walls
/// may move at another point of the step than spheres, so that twice the motion is possible.
inline constexpr double sudden_start = 2.0;

/// Counts what contacts do in the statistics: in the steps that take them deeper than they were, or when they turn. `Entry`:
/// of a PairTable.
template <class Entry>
class ContactCounts
{
  using SurfacesIntersectData = cm::SurfacesIntersectData;

 public:
  void connect(LAMMPS_NS::LAMMPS* lmp, Session& session)
  {
    lmp_ = lmp;
    bodies_ = &session.bodies;
    energy_ = session.energy;
  }
  /// Places in a contact's history, -1: none. Of R* at the largest overlap (superquadrics), and of the
  /// approach speed at first touch (`contactMap on`).
  void keep_radius_at(int offset) { radius_offset_ = offset; }
  void keep_speed_at(int offset) { speed_offset_ = offset; }
  /// The same of the largest overlap, where a tangential law takes along the depth that the normal law keeps.
  void keep_largest_at(int offset) { largest_offset_ = offset; }

  /// Part of a contact that this rank accounts for, 1 or 0.5: see ContactStatistics. Without a branch: which
  /// neighbours are ghosts no processor can foresee.
  double weight(const cm::SurfacesCloseData& contact) const
  {
    const bool whole = contact.is_wall | (contact.j < lmp_->atom->nlocal);
    return 0.5 + 0.5 * static_cast<double>(whole);
  }

  /// The contact came to a larger overlap `delta` than it ever had: from `largest`, which is 0 if it begins.
  [[gnu::always_inline]] void reach(const Entry& entry, double r_eff, double largest, double delta, double weight, double* history) const
  {
    ContactStatistics::Pair& counts = *entry.counts;
    if (delta > counts.overlap_max * r_eff) counts.overlap_max = delta / r_eff;
    if (delta > near_edge * entry.largest_overlap * r_eff) [[unlikely]] {
      if (largest <= near_edge * entry.largest_overlap * r_eff) counts.near += weight;
      if (delta > entry.largest_overlap * r_eff && largest <= entry.largest_overlap * r_eff) counts.past += weight;
    }
    move_in_histogram(counts, history, largest, delta, r_eff, weight);
  }

  /// Hertz's frequency grows as R* delta/m*^2 does: only a contact that leads by this measure is looked at.
  [[gnu::always_inline]] void look_at_stiffness(const SurfacesIntersectData& contact, const Entry& entry, double r_eff,
                                                double impact_overlap) const
  {
    ContactStatistics::Pair& counts = *entry.counts;
    const double measure = r_eff * contact.deltan, mass2 = contact.meff * contact.meff;
    if (!(measure > counts.hardest * mass2)) [[likely]]
      return;
    counts.hardest = measure / mass2;
    counts.run_frequency2 = std::max(counts.run_frequency2, entry.element.normal.stiffness(r_eff, contact.deltan, impact_overlap) /
                                                                contact_mass(*bodies_, contact));
    counts.frequency2 = std::max(counts.frequency2, counts.run_frequency2);
  }

  /// A step that takes the law deeper than it ever was: from `delta_max`, which is 0 if it begins. False: no motion paid for it.
  [[gnu::always_inline]] bool grows(const SurfacesIntersectData& contact, const Entry& entry, double r_eff, double impact_overlap,
                                    double delta_max) const
  {
    ContactStatistics::Pair& counts = *entry.counts;
    const double weight = this->weight(contact), delta = contact.deltan;
    bool sudden = false;
    if (delta_max == 0.0) [[unlikely]]
      sudden = begin(counts, contact, entry, r_eff, weight);
    if constexpr (!Entry::Element::deepens) reach(entry, r_eff, delta_max, delta, weight, contact.contact_history);
    look_at_stiffness(contact, entry, r_eff, impact_overlap);
    if (sudden) [[unlikely]] {  // no motion paid for what it holds
      counts.sudden += weight;
      counts.brought += weight * entry.element.normal.stored_energy(r_eff, delta, delta, impact_overlap);
    }
    return !sudden;
  }

  /// reach(), where a tangential law takes the depth along and the history has the largest overlap beside it.
  void reach_further(const SurfacesIntersectData& contact, const Entry& entry, double r_eff) const
  {
    double& largest = contact.contact_history[largest_offset_];
    if (!(contact.deltan > largest)) return;
    reach(entry, r_eff, largest, contact.deltan, weight(contact), contact.contact_history);
    largest = contact.deltan;
  }

  /// Work that the element booked in a step.
  [[gnu::always_inline]] void book(const SurfacesIntersectData& contact, const Entry& entry, const Ledger& ledger) const
  {
    for (const MechanismText& m : mechanisms)
      if (m.in_statistics && ledger[m.which] != 0.0) entry.counts->taken[m.which] += weight(contact) * ledger[m.which];
  }

  /// A step that takes the contact from the table's end `by` deeper, at the law's force there. `first`: the first one.
  /// A contact that began there came by no motion, which paid nothing.
  void crush(const SurfacesIntersectData& contact, const Entry& entry, double r_eff, double force, double by, bool first, bool began) const
  {
    const double weight = this->weight(contact), work = began && is_sudden(contact) ? 0.0 : force * by * (contact.is_wall ? contact.area_ratio : 1.0);
    ContactStatistics::Pair& counts = *entry.counts;
    if (first) counts.past += weight;
    counts.beyond += weight;
    counts.crushed += weight * work;
    counts.taken[Mechanism::plastic] += weight * work;
    counts.overlap_max = std::max(counts.overlap_max, contact.deltan / r_eff);
    if (energy_) energy_->share(contact, EnergyTally::dissipated, work, lmp_->atom->nlocal);
    const ParticleColumns particles = ParticleColumns::find(lmp_, crushed_particles);
    if (!particles) return;
    const auto add = [&](int particle, double energy) {
      double* row = particles.rows()[particle];
      row[0] += energy;
      row[1] = std::max(row[1], contact.deltan / r_eff);
    };
    add(contact.i, contact.is_wall ? work : 0.5 * work);
    if (!contact.is_wall && contact.j < lmp_->atom->nlocal) add(contact.j, 0.5 * work);
  }

  /// True of a contact that begins in this step, deeper than motion can bring it.
  bool is_sudden(const SurfacesIntersectData& contact) const
  {
    return !contact.is_non_spherical && contact.deltan > sudden_start * overlap_of_a_step(contact);
  }

  /// A contact that ended stays in the histogram, at its largest overlap.
  void forget(double* history) const
  {
    for (const int offset : {speed_offset_, largest_offset_})
      if (offset >= 0) [[unlikely]]
        history[offset] = 0.0;
  }

  /// Takes a contact that is open out of the histograms.
  void take_out(ContactStatistics::Pair& counts, const double* history, double delta_max, double r_eff,
                double weight) const
  {
    count(counts, history, largest_offset_ < 0 ? delta_max : history[largest_offset_], radius_at_largest(history, r_eff), -weight);
  }

 private:
  /// Counts a contact in its first step. True if it began deeper than motion can bring it.
  [[gnu::noinline]] bool begin(ContactStatistics::Pair& counts, SurfacesIntersectData contact,
                               const Entry& entry, double r_eff, double weight) const
  {
    const double speed = std::max(0.0, -contact.vn);
    counts.touches += weight;
    counts.speed.add(speed, weight);
    counts.speed_min = std::min(counts.speed_min, speed);
    counts.speed_max = std::max(counts.speed_max, speed);
    counts.damage_number_max =
        std::max(counts.damage_number_max, entry.damage_number_per_speed2 * speed * speed);
    const double mass = contact_mass(*bodies_, contact);
    if (speed > entry.element.normal.max_speed(r_eff, mass)) counts.too_fast += weight;
    // one without approach follows the rate-independent law: the file holds that
    if (speed > 0.0 && speed < entry.element.normal.min_speed(r_eff, mass)) counts.too_slow += weight;
    if (speed_offset_ >= 0) [[unlikely]]
      contact.contact_history[speed_offset_] = speed;
    // of superquadrics rotations bring overlap, too
    return is_sudden(contact);
  }

  /// The largest overlap that the motion of the last step can have brought two spheres to that did not touch
  /// before: of |d n + v dt|^2 >= (d + delta)^2, with the velocities of the half step behind.
  double overlap_of_a_step(const SurfacesIntersectData& contact) const
  {
    double speed2 = 0.0;
    for (int c = 0; c < 3; ++c) {
      const double v = contact.v_i[c] - contact.v_j[c];
      speed2 += v * v;
    }
    const double dt = lmp_->update->dt;
    return std::abs(contact.vn) * dt + 0.5 * speed2 * dt * dt / contact.r;
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
    const double per_edge = per_lowest_edge(counts, r_eff);
    const bool stays =
        !superquadrics_built && from > 0.0 &&
        LogHistogram::ends_above_ratio(LogHistogram::bin_of_ratio(from * per_edge), to * per_edge);
    if (!stays) [[unlikely]]
      change_bin(counts, history, from, to, r_eff, weight);
  }
  /// 1/m: 1 over R* times the lowest edge of the histogram of overlap/R*. A contact leaves the bin that it
  /// entered, as every overlap is multiplied by this.
  static double per_lowest_edge(const ContactStatistics::Pair& counts, double r_eff)
  {
    return 1.0 / (r_eff * counts.overlap.first);
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
    counts.count(LogHistogram::bin_of_ratio(delta * per_lowest_edge(counts, r_eff)),
                 speed_offset_ >= 0 ? history[speed_offset_] : -1.0, weight);
  }

  LAMMPS_NS::LAMMPS* lmp_ = nullptr;
  const Bodies* bodies_ = nullptr;
  const EnergyTally* energy_ = nullptr;  // null: energy off
  int radius_offset_ = -1, speed_offset_ = -1, largest_offset_ = -1;
};

}  // namespace granulaw::plugin
