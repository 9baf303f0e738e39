#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "law/pair.hpp"
#include "liggghts_plugin/normal_physics.hpp"
#include "liggghts_plugin/session.hpp"
#include "liggghts_plugin/superquadric.hpp"

namespace granulaw::plugin {

/// What the deck says of the tangential force.
struct TangentialChoice
{
  double damping = 0.0;   ///< fraction of critical
  bool computed = false;  ///< stiffness from the law's contact radius, not from Hertz's
};

/// Which pair of types a contact belongs to; at a wall `jtype` is the wall's.
inline PairKey pair_key(const Setup& setup, int itype, int jtype)
{
  if (!setup.wall) return {PairKey::particles, std::min(itype, jtype), std::max(itype, jtype)};
  return {setup.options.deformable_wall ? PairKey::deformable_wall : PairKey::rigid_wall, itype, jtype};
}

/// What the contact loop reads of each pair of atom types: the law, and what follows from the moduli. In the
/// deck's units, stretched.
template <NormalPhysics Physics>
class PairTable
{
 public:
  using Contact = typename Physics::Contact;

  // What every step reads lies in the first cache line.
  struct alignas(64) Entry
  {
    double largest_overlap = -1.0;    // over R*, that the law answers for; -1: no law for this pair of types
    double tangential = 0.0;          // k_t over the contact radius: 8 G* (Mindlin), stretched
    double damping = 0.0;             // normal damping over sqrt(sqrt(R* d) m*)
    double tangential_damping = 0.0;  // Mindlin's, over the same
    double yield_overlap = 0.0;       // over R*
    Contact contact;
    ContactStatistics::Pair* counts = nullptr;  // this pair of types in the contact statistics
    double damage_number_per_speed2 =
        0.0;  // I = rho V^2/Y of the yielding body over (relative speed)^2, s^2/m^2
  };

  Entry& at(int itype, int jtype) { return entries_[static_cast<std::size_t>(itype * stride_ + jtype)]; }
  const Entry& at(int itype, int jtype) const
  {
    return entries_[static_cast<std::size_t>(itype * stride_ + jtype)];
  }

  /// `damping_ratio`: of each pair of types, at [i * (count + 1) + j].
  void resolve(const Physics& physics, const Setup& setup, const Types& types,
               const TangentialChoice& tangential, const std::vector<double>& damping_ratio)
  {
    const bool is_wall = setup.wall != nullptr, rigid = is_wall && !setup.options.deformable_wall;
    stride_ = types.count + 1;
    entries_.assign(static_cast<std::size_t>(stride_ * stride_), Entry{});
    for (int i = 1; i <= types.count; ++i)
      for (int j = 1; j <= types.count; ++j) {
        if (std::isnan(types.youngs_modulus[i]) || std::isnan(types.youngs_modulus[j])) continue;
        try {
          at(i, j).contact = physics.resolve(i, j, rigid, setup.where);
        } catch (const granulaw::Error&) {
          if (types.can_meet(i, j, is_wall)) throw;
          continue;  // PlasticModel::beyond_table says so if such particles meet after all
        }
        complete(at(i, j), setup.options.stretch.value_or(1.0), tangential, eight_shear_moduli(types, i, j),
                 damping_ratio[static_cast<std::size_t>(i * stride_ + j)]);
      }
  }

  /// True if the law of any pair asks for the mass of the bodies.
  bool needs_mass() const
  {
    return std::any_of(entries_.begin(), entries_.end(), [](const Entry& entry) {
      return entry.largest_overlap >= 0.0 && entry.contact.needs_mass();
    });
  }

  /// Finds each pair of types its line in the statistics, and writes there what the law says about it.
  void enter(LAMMPS_NS::LAMMPS* lmp, const Physics& physics, const Setup& setup, const Types& types)
  {
    const ParticleSizes sizes = particle_sizes(lmp);
    const bool is_wall = setup.wall != nullptr;
    for (int i = 1; i <= types.count; ++i)
      for (int j = 1; j <= types.count; ++j) {
        Entry& entry = at(i, j);
        if (entry.largest_overlap < 0) continue;
        const PairKey key = pair_key(setup, i, j);
        entry.counts = &setup.session->statistics.pairs[key];
        if (!is_wall && j < i) continue;  // described as i, j
        PairInfo info = physics.describe(entry.contact, key);
        add_limits(info, entry.contact, smallest(sizes, i, is_wall ? 0 : j));
        info.needed = types.can_meet(i, j, is_wall);
        if (info.needed) physics.check_sizes(i, j, is_wall, entry.contact, sizes);
        if (info.needed) refuse_rated(lmp, setup, entry.contact.min_speed(1.0, 1.0) > 0);
        entry.counts->info = info;
      }
  }

 private:
  /// R* and m* of the smallest particles that can meet; 0: none is known.
  struct Smallest
  {
    double r_eff = 0.0, m_eff = 0.0;
  };

  /// `j` 0: at a wall.
  static Smallest smallest(const ParticleSizes& sizes, int i, int j)
  {
    Smallest found{sizes.radius[i], sizes.mass[i]};
    if (j > 0)
      found = {granulaw::effective_radius(sizes.radius[i], sizes.radius[j]),
               granulaw::effective_mass(sizes.mass[i], sizes.mass[j])};
    return std::isfinite(found.r_eff) && std::isfinite(found.m_eff) ? found : Smallest{};
  }

  /// Speed of first yield, and the time step that the stiffest contact allows.
  static void add_limits(PairInfo& info, const Contact& contact, const Smallest& spheres)
  {
    const auto [r_eff, m_eff] = spheres;
    info.onset_speed = std::numeric_limits<double>::infinity();
    if (!(r_eff > 0)) return;
    const double onset = contact.yield_overlap() * r_eff;
    if (contact.yield_overlap() < contact.largest_overlap())
      info.onset_speed = std::sqrt(2.0 * contact.stored_energy(r_eff, onset, onset, 0.0) / m_eff);
    double hardest = 0;
    constexpr int samples = 64;  // the stiffness varies slowly: it need not be largest at the end
    for (int k = 1; k <= samples; ++k)
      hardest =
          std::max(hardest, contact.stiffness(r_eff, contact.stiffness_range() * r_eff * k / samples, 0.0));
    info.dt_limit = dt_fraction * 2.0 * M_PI * std::sqrt(m_eff / hardest);
  }

  /// Pa, 8 G* of Mindlin's tangential stiffness.
  static double eight_shear_moduli(const Types& types, int i, int j)
  {
    const auto compliance = [&](int t) {
      const double nu = types.poisson_ratio[t];
      return 2.0 * (2.0 - nu) * (1.0 + nu) / types.youngs_modulus[t];
    };
    return 8.0 / (compliance(i) + compliance(j)) / types.units.pressure();
  }

  /// What follows from the law and the moduli.
  static void complete(Entry& entry, double stretch, const TangentialChoice& tangential, double shear_moduli,
                       double damping_ratio)
  {
    entry.largest_overlap = entry.contact.largest_overlap();
    if (stretch > 1.0) entry.largest_overlap = std::min(entry.largest_overlap, stretched_overlap_limit);
    entry.yield_overlap = entry.contact.yield_overlap();
    entry.damage_number_per_speed2 = entry.contact.damage_number_per_speed2();
    // k_t,s(d) = k_t(d/s)/s^2; Mindlin's radius is of the stretched overlap: another 1/sqrt(s)
    entry.tangential = shear_moduli * std::pow(stretch, tangential.computed ? -2.0 : -2.5);
    entry.tangential_damping = 2.0 * tangential.damping * std::sqrt(entry.tangential);
    // sqrt(5) Z sqrt(k m) d^(1/4) makes e = exp(-pi Z/sqrt(1 - Z^2)) at every speed (Antypov & Elliott
    // 2011); k = 4/3 E* sqrt(R*), stretched 1/s^2.5
    entry.damping = std::sqrt(5.0) * damping_ratio * std::sqrt(4.0 / 3.0 * entry.contact.pair_modulus()) *
                    std::pow(stretch, -1.25);
  }

  std::vector<Entry> entries_;
  int stride_ = 0;
};

}  // namespace granulaw::plugin
