#pragma once

#include "liggghts_plugin/engine/liggghts.hpp"

namespace granulaw::plugin {

/// Numbers of each particle that its contacts share, in LIGGGHTS's per-atom property: they move with the
/// particle, begin at zero, and reach ghosts and restart files where the spec says so. A law that needs all
/// contacts of a particle has a spec of its own: contacts add to columns, and gather() and send() carry them.
class ParticleColumns
{
 public:
  struct Spec
  {
    const char* name;              ///< of the property
    int columns;                   ///< 2 or more
    bool restart;                  ///< written to restart files
    bool to_ghosts;                ///< send() is called
    bool from_ghosts;              ///< gather() is called
    const char* fix_id = nullptr;  ///< null: the property's name
  };

  /// Adds the property where the deck has none yet. Collective.
  static ParticleColumns provide(LAMMPS_NS::LAMMPS* lmp, const Spec& spec);
  /// The property as the deck has it now; false where it has none. A command between runs may remove it:
  /// asked for anew before the forces of each step.
  static ParticleColumns find(LAMMPS_NS::LAMMPS* lmp, const Spec& spec);

  ParticleColumns() = default;
  explicit operator bool() const { return fix_ != nullptr; }
  /// Rows of the particles of this rank, then of its ghosts. Fetched at each use, never kept over a command:
  /// the array moves when particles come in.
  double** rows() const { return fix_->array_atom; }
  /// Owners to ghosts. Collective.
  void send() const { fix_->do_forward_comm(); }
  /// Sums of ghosts to owners. Collective.
  void gather() const { fix_->do_reverse_comm(); }

 private:
  explicit ParticleColumns(LAMMPS_NS::FixPropertyAtom* fix) : fix_(fix) {}
  LAMMPS_NS::FixPropertyAtom* fix_ = nullptr;
};

}  // namespace granulaw::plugin
