#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>

#include "liggghts_plugin/energy_books.hpp"
#include "liggghts_plugin/ledger.hpp"
#include "liggghts_plugin/loaded_law.hpp"
#include "liggghts_plugin/options.hpp"

namespace LAMMPS_NS {
class LAMMPS;
class FixWallGran;
}  // namespace LAMMPS_NS

namespace granulaw::plugin {

/// What the pair style, the walls and the statistics fix of one LIGGGHTS instance share.
class Session
{
 public:
  /// The session of `lmp`; made if there is none. It lives as long as somebody holds it.
  static std::shared_ptr<Session> of(LAMMPS_NS::LAMMPS* lmp);

  ContactLedger ledger;
  EnergyBooks* energy = nullptr;  ///< &books with `energy on`, else null
  bool contact_map = false;       ///< `contactMap on`
  EnergyBooks books;

  /// What walls of model `mpm` inherit: set by the pair style.
  std::optional<Options> pair_options;
  std::shared_ptr<const LoadedLaw> pair_law;

  /// Largest inertia number the laws in use answer for; 0 if none says.
  double inertia_limit = 0;

  /// True the first time it is asked about `what`: a warning is given once.
  bool first_time(const std::string& what) { return warned_.insert(what).second; }

 private:
  std::set<std::string> warned_;
};

/// One command's setup, handed to the contact model: LIGGGHTS builds the model before it reads the words, and
/// keeps it out of reach. The wrapper (styles.hpp) owns the setup and makes it `current` while it calls the
/// model's postSettings; it outlives the model's use of it.
struct Setup
{
  std::shared_ptr<Session> session;
  Options options;
  std::shared_ptr<const LoadedLaw> law;    ///< mpm only
  std::string where;                       ///< "pair_style gran model mpm", "fix w wall/gran model mpm"
  LAMMPS_NS::FixWallGran* wall = nullptr;  ///< null for pairs

  static const Setup* current;
};

/// Registers the fix style `granulaw/stats`; if the simulation box exists adds `fix granulaw all
/// granulaw/stats` where there is no such fix, and the per-atom property with `energy on`.
void provide_stats_fix(LAMMPS_NS::LAMMPS* lmp);

/// Ends the run with "ERROR: MESSAGE" on all ranks (each must call it). error->all does this too, but
/// in 3.8.0 it adds a "special message" from freed memory: bytes of garbage in one run of eight (seen).
[[noreturn]] void stop_all(LAMMPS_NS::LAMMPS* lmp, const std::string& message);
/// Ends the run from one rank. Unlike error->one it reaches the user from every rank and through a pipe: that
/// one prints to a stream which MPI_Abort never flushes and other ranks than 0 do not have.
[[noreturn]] void stop_one(LAMMPS_NS::LAMMPS* lmp, const std::string& message);

/// Stops with one sentence unless this is the LIGGGHTS the plug-in was built for. `parent_size` is sizeof of
/// the pair style or fix as the plug-in's headers have it, `parent` the object LIGGGHTS allocated (most
/// derived).
void check_liggghts(LAMMPS_NS::LAMMPS* lmp, const void* parent, std::size_t parent_size, const char* what);

}  // namespace granulaw::plugin
