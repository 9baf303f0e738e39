#pragma once

#include <vector>

#include "liggghts_plugin/particles/particle_columns.hpp"

namespace LAMMPS_NS {
class FixTemplateSphere;
}

namespace granulaw::plugin {

/// Mass and inertia of the rigid bodies that spheres are part of (fix multisphere, fix rigid), for each
/// sphere of this rank, ghosts included, whichever rank holds the body. A sphere that is released from its
/// body (broken clumps, boundaries) counts alone from the next step on.
class Bodies
{
 public:
  /// Adds the per-atom property that carries the numbers if the deck has bodies; collective. `inertia`:
  /// whether an effective mass at the point of contact will be asked for; else only fix rigid needs the
  /// property.
  static void provide(LAMMPS_NS::LAMMPS* lmp, bool inertia);

  /// True if spheres of one clump overlap, of templates or of clumps on this rank: a partner that touches
  /// both there meets both. Not collective.
  static bool overlap_themselves(LAMMPS_NS::LAMMPS* lmp);

  /// Smallest radius of a template's spheres, without those that lie within another sphere of their clump and so touch nothing.
  static double smallest_radius(LAMMPS_NS::FixTemplateSphere& particle);
  /// True for each such sphere of a clump on this rank; empty: there are no clumps. Not collective.
  static std::vector<bool> enclosed(LAMMPS_NS::LAMMPS* lmp);

  /// Before the forces of each step. Collective.
  void update(LAMMPS_NS::LAMMPS* lmp);

  /// True: fix freeze holds sphere `i`, so that the partner's mass alone counts.
  bool frozen(int i) const { return (atom_->mask[i] & freeze_bit_) != 0; }
  /// False: no sphere is part of a body, as far as contacts must know.
  bool known() const { return static_cast<bool>(values_); }
  /// kg, of the body that sphere `i` is part of; 0: none.
  double mass(int i) const { return row(i)[mass_column]; }
  /// 1/kg at a point of contact on sphere `i` with unit normal n: 1/m + n.[I^-1 (r x n) x r], r from the
  /// body's centre of mass to the sphere's centre. What an impulse along n changes the normal velocity there
  /// by. `sphere_mass` counts where the sphere is no part of a body.
  double inverse_mass(int i, const double* n, double sphere_mass) const;
  /// m, from the body's centre of mass to a point of contact on sphere `i` in the direction n from the sphere's
  /// centre, along n. The sphere's radius where it is no part of a body.
  double height(int i, const double* n, double sphere_radius) const;

 private:
  enum Column : int { mass_column, arm, inverse_inertia = 4, columns = 10 };  // xx yy zz xy xz yz

  static constexpr ParticleColumns::Spec spec();
  /// The numbers of sphere `i`.
  double* row(int i) const { return values_.rows()[i]; }
  /// Before a step's numbers come in.
  void clear() const;
  /// The spheres of bodies that this rank holds. The first is false where the deck has no fix rigid.
  bool fill_rigid(LAMMPS_NS::LAMMPS* lmp) const;
  void fill_clumps(LAMMPS_NS::LAMMPS* lmp) const;
  void fill(LAMMPS_NS::LAMMPS* lmp, int i, double body_mass, const double* centre, const double* moments,
            const double* ex, const double* ey, const double* ez) const;

  /// row(i), with the numbers of now.
  const double* looked_up(int i) const;
  /// Row of a sphere of a clump of this rank, with the numbers of now.
  void find_clump(LAMMPS_NS::LAMMPS* lmp, int i) const;

  static constexpr double not_looked_up = -1.0;  // in mass_column
  ParticleColumns values_;                       // false: no bodies
  const LAMMPS_NS::Atom* atom_ = nullptr;
  int freeze_bit_ = 0;                  // of the group that fix freeze holds; 0: there is none
  LAMMPS_NS::LAMMPS* alone_ = nullptr;  // of one rank: it has every clump and looks one up when it is asked
};

/// kg, the mass that the contact's normal velocity sees: where a sphere is part of a rigid body and is hit
/// beside its centre, less than the body's.
inline double contact_mass(const Bodies& bodies,
                           const LIGGGHTS::ContactModels::SurfacesIntersectData& contact)
{
  if (!bodies.known()) [[likely]]
    return contact.meff;
  const double n[3] = {contact.en[0], contact.en[1], contact.en[2]};  // contact may live in registers
  if (contact.is_wall) return 1.0 / bodies.inverse_mass(contact.i, n, contact.mi);
  double inverse = 0.0;
  if (!bodies.frozen(contact.i)) inverse += bodies.inverse_mass(contact.i, n, contact.mi);
  if (!bodies.frozen(contact.j)) inverse += bodies.inverse_mass(contact.j, n, contact.mj);
  return inverse == 0.0 ? contact.meff : 1.0 / inverse;
}

}  // namespace granulaw::plugin
