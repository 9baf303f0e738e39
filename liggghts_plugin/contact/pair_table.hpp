#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "law/contact_limits.hpp"
#include "contact/body_behind.hpp"
#include "contact/damping.hpp"
#include "contact/element.hpp"
#include "contact/pair.hpp"
#include "contact/plastic_shear.hpp"
#include "liggghts_plugin/contact/normal_physics.hpp"
#include "liggghts_plugin/contact/superquadric.hpp"
#include "liggghts_plugin/deck/session.hpp"

namespace granulaw::plugin {

/// Tangential force as the deck sets it.
struct TangentialChoice
{
  double damping = 0.0;         ///< fraction of critical
  bool computed = false;        ///< stiffness from the law's contact radius, not from Hertz's
  double** friction = nullptr;  ///< coefficient, by types; null: no friction
  double** beside = nullptr;    ///< number of the piece beside the laws, by types
  std::function<double(int, int)> range_of_beside{};  ///< its range, by types, where it has one
};

/// Which pair of types a contact belongs to; at a wall `jtype` is the wall's.
inline PairKey pair_key(const Setup& setup, int itype, int jtype)
{
  if (!setup.wall) return {PairKey::particles, std::min(itype, jtype), std::max(itype, jtype)};
  return {setup.options.deformable_wall ? PairKey::deformable_wall : PairKey::rigid_wall, itype, jtype};
}

/// Data of each pair of atom types for the contact loop: the law, and numbers derived from the moduli. In the
/// deck's units, stretched.
template <NormalPhysics Physics, class Tangential, class Beside = NothingBeside>
class PairTable
{
 public:
  using Contact = typename Physics::Contact;
  using Element = ContactElement<Contact, Tangential, Beside>;

  // Members read at every step come first.
  struct alignas(64) Entry
  {
    using Element = PairTable::Element;
    double largest_overlap = -1.0;    // over R*, that the law holds for; -1: no law for this pair of types
    ContactStatistics::Pair* counts = nullptr;  // this pair of types in the contact statistics
    Element element;
    ShearPair shear;  // Mindlin's, stretched
    double damage_number_per_speed2 =
        0.0;  // I = rho V^2/Y of the yielding body over (relative speed)^2, s^2/m^2
    double behind_i = 0.0, behind_j = 0.0;  // k/E*, stretched, of the bodies behind a contact (body_behind.hpp)
  };

  /// The law of a contact: one for as long as it lasts, as radii do not change. At a wall radius_j is not
  /// looked at.
  const Entry& of(int itype, int jtype, double radius_i, double radius_j) const
  {
    const std::size_t pair = pair_of(itype, jtype);
    if (laws_ == 1) return entries_[pair];
    return entries_[pair * laws_ + finders_[pair].nearest(radius_i, radius_j)];
  }

  /// True if waves take a part of the contacts of any pair. One answer for all, as a contact loop cannot
  /// foresee which types meet next.
  bool radiates() const { return radiates_; }

  /// `damping_ratio`: of each pair of types, at [i * (count + 1) + j].
  void resolve(const Physics& physics, const Setup& setup, const Types& types, const ParticleSizes& sizes,
               const TangentialChoice& tangential, const std::vector<double>& damping_ratio)
  {
    const bool is_wall = setup.wall != nullptr;
    stride_ = types.count + 1;
    find_choices(physics, setup, types.count, sizes);
    entries_.assign(choices_.size() * laws_, Entry{});
    for (int i = 1; i <= types.count; ++i)
      for (int j = 1; j <= types.count; ++j) {
        if (std::isnan(types.youngs_modulus[i]) || std::isnan(types.youngs_modulus[j])) continue;
        try {
          resolve_types(physics, setup, sizes, i, j);
        } catch (const granulaw::Error&) {
          if (types.can_meet(i, j, is_wall)) throw;
          continue;  // ElementHost::beyond_table says so if such particles meet after all
        }
        each_entry(i, j, [&](Entry& entry) {
          complete(entry, setup.options.stretch.value_or(1.0), tangential, tangential.friction ? tangential.friction[i][j] : 0.0,
                   in_shear(types, i, j, tangential.damping).stiffness, damping_ratio[static_cast<std::size_t>(i * stride_ + j)]);
          if constexpr (requires { Beside::range_property; })
            entry.element.beside = Beside(entry.element.normal, tangential.beside[i][j], tangential.range_of_beside(i, j));
          else if constexpr (Element::has_beside)
            entry.element.beside = Beside(entry.element.normal, tangential.beside[i][j]);
          complete_tangential(entry, in_shear(types, i, is_wall && !setup.options.deformable_wall ? 0 : j, tangential.damping));
          entry.behind_i = behind(types, i, setup.options.stretch.value_or(1.0));
          entry.behind_j = is_wall ? 0.0 : behind(types, j, setup.options.stretch.value_or(1.0));
        });
      }
    radiates_ = any_contact([](const Contact& contact) {
      if constexpr (Radiates<Contact>) return contact.radiation > 0.0;
      return false;
    });
  }

  /// Largest reach of the piece beside the laws over the sum of radii, at the smallest particles that can meet.
  double largest_reach(const ParticleSizes& sizes, bool is_wall) const
  {
    double largest = 0.0;
    for (int i = 1; i < stride_; ++i)
      for (int j = 1; j < stride_; ++j) {
        const double r_i = sizes.radius[i], r_j = is_wall ? 0.0 : sizes.radius[j], r_eff = smallest(sizes, i, is_wall ? 0 : j).r_eff;
        if (r_eff > 0.0 && usual_entry(i, j).largest_overlap >= 0.0)
          largest = std::max(largest, usual_entry(i, j).element.beside.reach(r_eff) / (r_i + r_j));
      }
    return largest;
  }

  /// Throws Error where the piece beside the laws does not hold for the smallest particles that can meet. `fault`: of the element's
  /// normal law and piece, of R* and m*; a sentence.
  template <class Fault>
  void check_beside(const Setup& setup, const Types& types, const ParticleSizes& sizes, Fault&& fault) const
  {
    const bool is_wall = setup.wall != nullptr;
    for (int i = 1; i < stride_; ++i)
      for (int j = 1; j < stride_; ++j) {
        const Smallest spheres = smallest(sizes, i, is_wall ? 0 : j);
        if (!types.can_meet(i, j, is_wall) || !(spheres.r_eff > 0.0)) continue;
        each_entry_in_use(i, j, sizes, [&](const Entry& entry, std::size_t) {
          if (entry.largest_overlap < 0.0) return;
          if (const std::string why = fault(entry.element, spheres.r_eff, spheres.m_eff); !why.empty())
            fail(setup.where, fmt::format("types {} and {}{}, R* {:.3g}: {}", i, j, is_wall ? " (wall)" : "", spheres.r_eff, why));
        });
      }
  }

  /// True if the law of any pair requires the mass of the bodies.
  bool needs_mass() const
  {
    return any_contact([](const Contact& contact) { return contact.needs_mass(); });
  }

  /// Finds each pair of types its line in the statistics, and writes there what the law says about it.
  void enter(LAMMPS_NS::LAMMPS* lmp, const Physics& physics, const Setup& setup, const Types& types,
             const ParticleSizes& sizes)
  {
    const bool is_wall = setup.wall != nullptr;
    for (int i = 1; i <= types.count; ++i)
      for (int j = 1; j <= types.count; ++j) {
        const Entry& usual = usual_entry(i, j);
        if (usual.largest_overlap < 0) continue;
        const PairKey key = pair_key(setup, i, j);
        ContactStatistics::Pair& counts = setup.session->statistics.pairs[key];
        each_entry(i, j, [&](Entry& entry) { entry.counts = &counts; });
        if (!is_wall && j < i) continue;  // described as i, j
        std::optional<PairInfo> all;
        each_entry_in_use(i, j, sizes, [&](const Entry& entry, std::size_t k) {
          const PairInfo one = describe(physics, entry.element.normal, key, is_wall, k, sizes);
          if (all)
            all->include(one);
          else
            all = one;
        });
        PairInfo& info = *all;
        info.needed = types.can_meet(i, j, is_wall);
        info.onset_speed = std::numeric_limits<double>::infinity();
        each_entry_in_use(i, j, sizes, [&](const Entry& entry, std::size_t) {
          add_limits(info, entry.element.normal, smallest(sizes, i, is_wall ? 0 : j), lmp->update->dt);
          if (info.needed) physics.check_sizes(i, j, is_wall, entry.element.normal, sizes);
          if constexpr (Element::deepens && requires { physics.check_flow_stress(entry.element.normal); })
            if (info.needed) physics.check_flow_stress(entry.element.normal);
          if (info.needed) refuse_rated(lmp, setup, entry.element.normal.min_speed(1.0, 1.0) > 0);
        });
        counts.info = info;
      }
  }

 private:
  /// Description of law `k` of the pair, with the error of the sizes that follow it.
  PairInfo describe(const Physics& physics, const Contact& contact, const PairKey& key, bool is_wall,
                    std::size_t k, const ParticleSizes& sizes) const
  {
    PairInfo info = physics.describe(contact, key);
    if constexpr (HasLawsBySize<Physics>)
      if (!is_wall && info.kind == name_of(info.stated.kind)) {  // no elastic types
        const SizeChoice& choice = choices_[pair_of(key.i, key.j)];
        info.stated = info.stated.at_distance(choice.distance(k, sizes.of_type(key.i), sizes.of_type(key.j)));
        info.kind = name_of(info.stated.kind);
      }
    return info;
  }

  /// Choice of contacts of each pair of types among its laws.
  void find_choices(const Physics& physics, const Setup& setup, int count, const ParticleSizes& sizes)
  {
    const SizeChoice one_law(ShareOf::smaller, {0.5});
    choices_.assign(static_cast<std::size_t>(stride_ * stride_), one_law);
    if constexpr (HasLawsBySize<Physics>)
      if (!setup.wall)
        for (int i = 1; i <= count; ++i)
          for (int j = 1; j <= count; ++j) choices_[pair_of(i, j)] = physics.laws_by_size(i, j);
    finders_.assign(choices_.size(), LawFinder{});
    laws_ = 1;
    for (int i = 1; i <= count; ++i)
      for (int j = 1; j <= count; ++j) {
        const SizeChoice& choice = choices_[pair_of(i, j)];
        laws_ = std::max(laws_, choice.count());
        finders_[pair_of(i, j)] = choice.finder(choice.usual(sizes.of_type(i), sizes.of_type(j)));
      }
  }

  /// Finds the law or laws of types i and j.
  void resolve_types(const Physics& physics, const Setup& setup, const ParticleSizes& sizes, int i, int j)
  {
    const bool rigid = setup.wall && !setup.options.deformable_wall;
    Entry* entries = first_entry(i, j);
    if constexpr (!HasLawsBySize<Physics>)
      entries[0].element.normal = physics.resolve(i, j, rigid, setup.where);
    else if (setup.wall)
      entries[0].element.normal =
          physics.resolve(i, j, rigid, setup.where, 1.0, std::numeric_limits<double>::infinity());
    else {
      const SizeChoice& choice = choices_[pair_of(i, j)];
      for (std::size_t k = 0; k < choice.count(); ++k) {
        const auto [radius_i, radius_j] = choice.radii_of(k, sizes.of_type(i), sizes.of_type(j));
        entries[k].element.normal = physics.resolve(i, j, rigid, setup.where, radius_i, radius_j);
      }
    }
  }

  std::size_t pair_of(int itype, int jtype) const
  {
    return static_cast<std::size_t>(itype * stride_ + jtype);
  }
  Entry* first_entry(int i, int j) { return &entries_[pair_of(i, j) * laws_]; }
  const Entry* first_entry(int i, int j) const { return &entries_[pair_of(i, j) * laws_]; }

  /// An entry that particles of the known sizes follow.
  const Entry& usual_entry(int i, int j) const { return first_entry(i, j)[finders_[pair_of(i, j)].usual]; }

  /// True if `holds` is true of the law of any pair.
  bool any_contact(const auto& holds) const
  {
    return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& entry) {
      return entry.largest_overlap >= 0.0 && holds(entry.element.normal);
    });
  }

  /// Each entry of the pair of types.
  template <class Visit>
  void each_entry(int i, int j, Visit&& visit)
  {
    for (std::size_t k = 0; k < choices_[pair_of(i, j)].count(); ++k) visit(first_entry(i, j)[k]);
  }
  /// The usual one, and each other that particles of the known sizes follow.
  template <class Visit>
  void each_entry_in_use(int i, int j, const ParticleSizes& sizes, Visit&& visit) const
  {
    const Entry& usual = usual_entry(i, j);
    const SizeChoice& choice = choices_[pair_of(i, j)];
    for (std::size_t k = 0; k < choice.count(); ++k) {
      const Entry& entry = first_entry(i, j)[k];
      if (&entry == &usual || choice.serves(k, sizes.of_type(i), sizes.of_type(j))) visit(entry, k);
    }
  }

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

  /// Lowers the speed of first yield, the largest time step, and the overlap that the step `dt` is short enough
  /// for, to what this law allows.
  static void add_limits(PairInfo& info, const Contact& contact, const Smallest& spheres, double dt)
  {
    const auto [r_eff, m_eff] = spheres;
    if (!(r_eff > 0)) return;
    info.onset_speed = std::min(info.onset_speed, onset_speed(contact, r_eff, m_eff));
    const auto stiffness = [&, r_eff = r_eff](double delta) {  // clang 14 captures no structured binding by itself
      return step_stiffness(contact, r_eff, delta);
    };
    const double deepest = contact.stiffness_range() * r_eff;
    const double dt_limit = largest_step_of(contact, r_eff, m_eff);
    const double dt_overlap = overlap_of_step(dt, m_eff, deepest, stiffness) / r_eff;
    const bool is_first = info.dt_limit == 0;
    info.dt_limit = is_first ? dt_limit : std::min(info.dt_limit, dt_limit);
    info.dt_overlap = is_first ? dt_overlap : std::min(info.dt_overlap, dt_overlap);
  }

  /// `j` 0: a rigid wall.
  static BodiesInShear in_shear(const Types& types, int i, int j, double damping_ratio)
  {
    const auto body = [&](int t) { return t > 0 ? ElasticBody{types.youngs_modulus[t], types.poisson_ratio[t]} : ElasticBody{}; };
    return BodiesInShear::of(body(i), body(j), damping_ratio, types.units.pressure());
  }

  /// k/E* of a type; stretched S^2, as forces are 1/S and overlaps S of the real ones.
  static double behind(const Types& types, int t, double stretch)
  {
    const double nu = types.poisson_ratio[t], e_star = plane_strain_modulus(types.youngs_modulus[t], nu);
    return stretch * stretch * far_field(nu) / (e_star / types.units.pressure());
  }

  /// Completes an entry with numbers that follow from the law and the moduli.
  static void complete(Entry& entry, double stretch, const TangentialChoice& tangential, double friction, double shear_moduli,
                       double damping_ratio)
  {
    const Contact& contact = entry.element.normal;
    entry.largest_overlap = contact.largest_overlap();
    if (stretch > 1.0) entry.largest_overlap = std::min(entry.largest_overlap, stretched_overlap_limit);
    entry.damage_number_per_speed2 = contact.damage_number_per_speed2();
    entry.shear = ShearPair::of(shear_moduli, friction, tangential.damping, stretch, tangential.computed);
    entry.element.yield_overlap = contact.yield_overlap();
    entry.element.damping = elastic_dashpot(damping_ratio, contact.pair_modulus(), stretch);
  }
  static void complete_tangential(Entry& entry, const BodiesInShear& bodies)
  {
    if constexpr (std::constructible_from<Tangential, const Contact&, const ShearPair&, const BodiesInShear&>)
      entry.element.tangential = Tangential(entry.element.normal, entry.shear, bodies);
    else if constexpr (std::constructible_from<Tangential, const ShearPair&>)
      entry.element.tangential = Tangential(entry.shear);
    else
      (void)entry, (void)bodies;
  }

  std::vector<Entry> entries_;  // laws_ for each pair of types; a pair with fewer leaves the last ones empty
  std::vector<SizeChoice> choices_;  // of each pair
  std::vector<LawFinder> finders_;   // of each pair
  std::size_t laws_ = 1;
  bool radiates_ = false;
  int stride_ = 0;
};

}  // namespace granulaw::plugin
