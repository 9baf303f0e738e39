#pragma once

#include <functional>

#include "liggghts_plugin/engine/liggghts.hpp"

namespace granulaw::plugin {

/// All contacts of a particle at once, in the place of the loops over pairs and walls: docs/theory/confined.md. `confinement on`:
/// of all particles; `auto`: of pressed ones, and contacts of the others are the loops'.
class Confinement
{
 public:
  using ContactData = LIGGGHTS::ContactModels::SurfacesIntersectData;
  using ForceData = LIGGGHTS::ContactModels::ForceData;
  /// What a contact between particles does to i and j, for those who watch contacts.
  using Observer = std::function<void(ContactData&, const ForceData& on_i, const ForceData& on_j)>;
  /// What a wall's loop has to do with a contact: all, it is the loop's; nothing yet, as the contacts are being collected; nothing, it
  /// is open; add the force.
  enum class AtWall { apart, collected, open, acts };

  virtual ~Confinement() = default;
  /// Before the loops of a step: which particles are pressed. Takes over the contacts of those that were not. Collective.
  virtual void choose(PairGran& pair) = 0;
  bool takes_all = true;          ///< `on`
  bool takes_some = true;         ///< false: no particle of any rank is pressed, and compute() would do nothing
  bool asks_walls = true;         ///< false: at_wall() would say `apart`
  const char* pressed = nullptr;  ///< by index, of particles and ghosts; null: none is, or all are

  /// The forces between particles of this step, of contacts that have a pressed one. Calls the walls' loops to collect their contacts.
  /// Collective. `observer`: null if none.
  virtual void compute(PairGran& pair, const Observer* observer) = 0;
  /// From the loop of a wall: `contact` with radi, r and en. `on_i`: the force on the particle.
  virtual AtWall at_wall(const FixWallGran& wall, const ContactData& contact, const double* wall_velocity, int mesh, int triangle, ForceData& on_i) = 0;
};

struct Options;
struct Setup;

/// True: `confinement on` or `auto` is said, by the command or the pair style that it inherits from.
bool says_confinement(const Options& options);
/// Adds `fix granulaw_confined all granulaw/confined` where that is said and the box exists.
void provide_confinement(LAMMPS_NS::LAMMPS* lmp, const Options& options);
/// Before a run: throws Error where the deck has what the law does not know.
void check_confinement(LAMMPS_NS::LAMMPS* lmp, const Setup& setup);

}  // namespace granulaw::plugin
