#pragma once

#include "contact/vector.hpp"
#include "liggghts_plugin/books/contact_statistics.hpp"
#include "liggghts_plugin/particles/particle_columns.hpp"

namespace granulaw::plugin {

/// Columns of each particle, under `beyondRange crush`: J taken beyond the law's table, largest overlap/R* of such a contact.
inline constexpr ParticleColumns::Spec crushed_particles{.name = "granulaw_crush", .columns = 2, .restart = true, .to_ghosts = false, .from_ghosts = false};

/// Energies of single particles and the work of all forces but the normal law's: only with `energy on`.
///
/// Each particle of a pair owns half of what their contact holds and loses; at a wall the particle owns all.
class EnergyTally
{
  using SurfacesIntersectData = LIGGGHTS::ContactModels::SurfacesIntersectData;
  using ForceData = LIGGGHTS::ContactModels::ForceData;

 public:
  /// Columns of the per-atom property, J: `stored` is the present step's, the others add up since the
  /// particle was made. `other_work` holds that of waves, too.
  enum Column : int { stored, dissipated, other_work, columns };
  /// Values of contact history that account() keeps: force and couple of the last step, newton flag "1".
  static constexpr int history_values = 6;

  /// Moves with the particles and into restart files.
  static constexpr ParticleColumns::Spec energies{.name = "granulaw_energy",
                                                  .columns = columns,
                                                  .restart = true,
                                                  .to_ghosts = false,
                                                  .from_ghosts = false};
  /// Column of `computeDissipatedEnergy on`, as LIGGGHTS's own models make it: energy, and six places that
  /// they work
  /// with.
  static constexpr ParticleColumns::Spec lost{.name = "dissipated_energy",
                                              .columns = 7,
                                              .restart = true,
                                              .to_ghosts = true,
                                              .from_ghosts = false,
                                              .fix_id = "dissipated_energy_"};

  ParticleColumns per_atom;                   ///< `energies`; false: not there yet
  ParticleColumns dissipated_energy;          ///< `lost`; false: not asked for

  /// The step of the contact computed last, as the element booked it.
  struct Booked
  {
    ContactStatistics::Pair* counts = nullptr;
    double law_force = 0;         ///< N, of the normal law alone
    double law_force_after = 0;  ///< N, the same where the next step begins: a tangential law may change the depth
    double deepened = 0;          ///< J, that the law lost and holds more by such a change
    double work = 0;              ///< J, of all but the normal law that stands elsewhere in the statistics
  };
  Booked booked;

  /// Adds the properties where they are asked for. Collective.
  static void provide(LAMMPS_NS::LAMMPS* lmp, bool energy, bool dissipated)
  {
    if (energy) ParticleColumns::provide(lmp, energies);
    if (dissipated) ParticleColumns::provide(lmp, lost);
  }
  /// The properties as the deck has them now.
  void find(LAMMPS_NS::LAMMPS* lmp, bool dissipated)
  {
    per_atom = ParticleColumns::find(lmp, energies);
    dissipated_energy = dissipated ? ParticleColumns::find(lmp, lost) : ParticleColumns();
  }

  /// Before the forces of a step, whose contacts add up what is stored.
  void begin_step(LAMMPS_NS::LAMMPS* lmp, bool dissipated)
  {
    find(lmp, dissipated);
    for (int a = 0; per_atom && a < lmp->atom->nlocal; ++a) per_atom.rows()[a][stored] = 0.0;
  }

  void share(const SurfacesIntersectData& sidata, Column column, double energy, int nlocal) const
  {
    if (!per_atom) return;
    add(sidata.i, column, sidata.is_wall ? energy : 0.5 * energy);
    if (!sidata.is_wall && sidata.j < nlocal) add(sidata.j, column, 0.5 * energy);
  }

  /// Books the work that the contact took from the particles over the last step, but for the normal law's:
  /// tangential, rolling and cohesive forces, damping, waves. `i_forces`: all that the contact does to i.
  ///
  /// The mean of this step's and the last one's force times the displacement between is the change of the
  /// kinetic energy by it, exactly, where velocity Verlet moves the particles: at this point of a step
  /// LIGGGHTS's velocities are those of the half step behind. Work held in tangential springs counts as taken
  /// until they give it back.
  void account(const SurfacesIntersectData& sidata, const ForceData& i_forces, double* last, double dt,
               int nlocal)
  {
    if (!sidata.computeflag) return;
    const double* n = sidata.en;
    double force[3], couple[3];
    for (int c = 0; c < 3; ++c) force[c] = i_forces.delta_F[c] - booked.law_force * n[c];
    Vector arm = cross(n, force);  // torque on i is -cri en x F, and the couple
    for (int c = 0; c < 3; ++c) couple[c] = i_forces.delta_torque[c] + sidata.cri * arm[c];

    if (sidata.shearupdate) {
      double mean_force[3], mean_couple[3], power = 0.0;
      for (int c = 0; c < 3; ++c) {
        mean_force[c] = 0.5 * (force[c] + last[c]);
        mean_couple[c] = 0.5 * (couple[c] + last[3 + c]);
      }
      arm = cross(n, mean_force);
      for (int c = 0; c < 3; ++c) {
        power += mean_force[c] * (sidata.v_i[c] - sidata.v_j[c]) +
                 (mean_couple[c] - sidata.cri * arm[c]) * sidata.omega_i[c];
        if (!sidata.is_wall) power -= (mean_couple[c] + sidata.crj * arm[c]) * sidata.omega_j[c];
      }
      const double taken = -power * dt;
      booked.counts->other_work += (sidata.is_wall || sidata.j < nlocal ? 1.0 : 0.5) * (taken - booked.work);
      share(sidata, other_work, taken - booked.deepened, nlocal);
    }
    for (int c = 0; c < 3; ++c) last[c] = force[c] + (booked.law_force - booked.law_force_after) * n[c], last[3 + c] = couple[c];
  }

 private:
  void add(int particle, Column column, double energy) const
  {
    per_atom.rows()[particle][column] += energy;
    if (dissipated_energy && column != stored) dissipated_energy.rows()[particle][0] += energy;
  }
};

}  // namespace granulaw::plugin
