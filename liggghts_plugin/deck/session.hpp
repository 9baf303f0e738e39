#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "contact/pair.hpp"
#include "liggghts_plugin/books/contact_statistics.hpp"
#include "liggghts_plugin/books/energy_tally.hpp"
#include "liggghts_plugin/books/restart_record.hpp"
#include "liggghts_plugin/deck/loaded_law.hpp"
#include "liggghts_plugin/deck/options.hpp"
#include "liggghts_plugin/particles/bodies.hpp"

namespace LAMMPS_NS {
class LAMMPS;
class FixWallGran;
}  // namespace LAMMPS_NS

namespace granulaw::plugin {

/// State of one contact, from its history. Lengths and energies in the deck's units.
struct ContactState
{
  double contact_radius = 0;   ///< the law's own, of the real, unstretched contact
  double largest_overlap = 0;  ///< since first touch; stretched, as the overlap itself
  double dissipated = 0;       ///< by the normal law since first touch
};

/// Radius of a wall.
inline constexpr double flat = std::numeric_limits<double>::infinity();

/// A contact as LIGGGHTS's lists name it.
struct ContactPlace
{
  int itype = 0, jtype = 0;           ///< atom types; at a wall j is the wall's
  double radius_i = 0, radius_j = 0;  ///< radius_j infinity: a wall
  double overlap = 0;
  double* history = nullptr;

  double r_eff() const
  {
    return std::isfinite(radius_j) ? granulaw::effective_radius(radius_i, radius_j) : radius_i;
  }
};

/// What a contact leaves to another law. Deck's units.
struct HandedOver
{
  double largest_overlap = 0;  ///< 0: nothing
  double stored = 0;           ///< that the normal law would give back
  Vector shear{};              ///< force on the first body
};

/// A contact model, asked about single contacts.
class ContactInquiry
{
 public:
  virtual ~ContactInquiry() = default;
  virtual ContactState state(const ContactPlace& contact) const = 0;
  /// False: each step books what it does, and settle() has nothing to do.
  virtual bool books_later() const = 0;
  /// Books in the contact statistics what a contact that is open did since it was last booked.
  virtual void settle(const ContactPlace& contact, double weight) const = 0;
  /// Takes a contact that is open out of the contact statistics' histogram: see
  /// ContactStatistics::Pair::overlap.
  virtual void take_out(ContactStatistics& statistics, const ContactPlace& contact, double weight) const = 0;
  /// For another law that goes on with the contact; books here what it did. `normal`: from the second body to the first. Its
  /// history is to be cleared.
  virtual HandedOver hand_over(const ContactPlace& contact, const Vector& normal, double weight) const = 0;
};

/// A contact that is open on this rank.
struct OpenContact
{
  PairKey key;
  int i = 0, j = -1;  ///< indices of the particles; j -1: a wall
  double weight = 1;  ///< in sums over ranks (ContactStatistics)
  ContactPlace place;
};

/// A pair style or wall of ours.
class CountedStyle
{
 public:
  virtual ~CountedStyle() = default;
  virtual void each_open(const std::function<void(const OpenContact&)>& visit) const = 0;
  virtual const ContactInquiry* contacts() const = 0;

  /// To be called before the contact statistics are read.
  void settle_open() const
  {
    const ContactInquiry* const inquiry = contacts();
    if (inquiry && inquiry->books_later()) each_open([&](const OpenContact& open) { inquiry->settle(open.place, open.weight); });
  }
  /// Takes the contacts that are open on this rank out of the contact statistics' histograms.
  void take_out_open(ContactStatistics& statistics) const
  {
    each_open([&](const OpenContact& open) { contacts()->take_out(statistics, open.place, open.weight); });
  }
};

class Confinement;
struct Setup;

/// True: the process reads a deck for a plan (plan/planner.hpp), and writes nothing.
inline bool is_planning = false;

/// Data common to the pair style, the walls and the statistics fix of one LIGGGHTS instance.
class Session
{
 public:
  /// The session of `lmp`; made if there is none. It lives as long as somebody holds it.
  static std::shared_ptr<Session> of(LAMMPS_NS::LAMMPS* lmp);

  ContactStatistics statistics;
  EnergyTally* energy = nullptr;   ///< &tally with `energy on`, else null
  bool contact_map = false;        ///< `contactMap on`
  bool dissipated_energy = false;  ///< `computeDissipatedEnergy on`
  bool crushes = false;            ///< `beyondRange crush` of the pair style or a wall
  EnergyTally tally;
  Bodies bodies;
  Confinement* confinement = nullptr;  ///< all contacts of a particle at once (confine/confinement.hpp); null: `confinement off`

  /// What is done in each step before the forces, on all ranks (run/fix_step.hpp): for numbers that all contacts of a particle
  /// share.
  using Work = std::function<void(LAMMPS_NS::LAMMPS*)>;
  std::vector<Work> before_forces{[this](LAMMPS_NS::LAMMPS* lmp) { bodies.update(lmp); },
                                  [this](LAMMPS_NS::LAMMPS* lmp) { if (energy) energy->begin_step(lmp, dissipated_energy); }};

  /// Options that walls inherit: set by the pair style.
  std::optional<Options> pair_options;
  std::shared_ptr<const LoadedLaw> pair_law;

  /// Our pair style (key null) and walls.
  std::map<const LAMMPS_NS::FixWallGran*, const CountedStyle*> styles;
  /// Who knows the contacts of `wall`, null: those between particles. Null: another model.
  const ContactInquiry* contacts_of(const LAMMPS_NS::FixWallGran* wall) const
  {
    const auto found = styles.find(wall);
    return found == styles.end() ? nullptr : found->second->contacts();
  }

  /// Checks of atom types whose law holds for one radius, by command and type: each throws Error at another
  /// radius, in the deck's units. Radii and types may change in a run.
  std::map<const Setup*, std::map<int, std::function<void(double radius)>>> one_size;

  /// The histories of the restart file that this deck continues, by command (Setup::command). One that has been
  /// compared is taken out.
  std::map<std::string, HistoryMeaning> restarted;
  /// Those of the commands of this deck.
  std::map<std::string, HistoryMeaning> meanings;

  /// True the first time it is asked about `what`: a warning is given once.
  bool first_time(const std::string& what) { return warned_.insert(what).second; }

 private:
  std::set<std::string> warned_;
};

/// One command's setup. The style (CommandStyle) owns it, and gives it to the contact model, which LIGGGHTS builds before it
/// reads the words.
struct Setup
{
  std::shared_ptr<Session> session;
  Options options;
  std::shared_ptr<const LoadedLaw> law;      ///< null where the model reads none
  std::string where;                         ///< "pair_style gran model mpm", "fix w wall/gran model mpm"
  LAMMPS_NS::FixWallGran* wall = nullptr;    ///< null for pairs
  Options own;                               ///< what the command itself says, before a wall inherits
  bool energy = false, contact_map = false;  ///< whether contacts keep what these need
  HistoryMeaning meaning;
  mutable const ContactInquiry* contacts = nullptr;  ///< the model, once it has read its words

  /// The command's name in restart records: pairs_record, or the wall's id. A wall of the id "pair" is "fix pair": no id
  /// has a blank.
  std::string command() const;
};

/// Registers the fix style `granulaw/stats`; if the simulation box exists adds `fix granulaw all
/// granulaw/stats` where there is no such fix, and the per-atom property with `energy on`.
void provide_stats_fix(LAMMPS_NS::LAMMPS* lmp);

/// Ends the run with "ERROR: MESSAGE" on all ranks. Each must call it; where one does so alone, as nobody foresaw, it ends
/// the run by stop_one() after some seconds. error->all does this too, but
/// in 3.8.0 it adds a "special message" from freed memory: bytes of garbage in one run of eight (seen).
[[noreturn]] void stop_all(LAMMPS_NS::LAMMPS* lmp, const std::string& message);
/// Ends the run from one rank. Unlike error->one it reaches the user from every rank and through a pipe: that
/// one prints to a stream which MPI_Abort never flushes and other ranks than 0 do not have.
/// The files of fix granulaw/stats are written first.
[[noreturn]] void stop_one(LAMMPS_NS::LAMMPS* lmp, const std::string& message);

/// Writes the files of fix granulaw/stats with what this rank counted, and the message that ends the run.
void write_stats_at_stop(LAMMPS_NS::LAMMPS* lmp, const std::string& message);

/// In words: "model mpm tangential history rolling_friction epsd2, energy on, stretch 3".
std::string describe(const HistoryMeaning& meaning);

/// Throws Error where a run would go wrong with what the deck says around the contact models.
void check_run(LAMMPS_NS::LAMMPS* lmp, const Setup& setup);

/// Stops with one sentence unless this is the LIGGGHTS the plug-in was built for. `parent_size` is sizeof of
/// the pair style or fix as the plug-in's headers have it, `parent` the object LIGGGHTS allocated (most
/// derived).
void check_liggghts(LAMMPS_NS::LAMMPS* lmp, const void* parent, std::size_t parent_size, const char* what);

}  // namespace granulaw::plugin
