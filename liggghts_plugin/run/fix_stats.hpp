#pragma once

#include <memory>
#include <string>

#include "liggghts_plugin/books/energy_series.hpp"
#include "liggghts_plugin/books/stats_text.hpp"
#include "liggghts_plugin/deck/session.hpp"
#include "liggghts_plugin/engine/liggghts.hpp"

namespace granulaw::plugin {

/// fix ID all granulaw/stats [file FILE] [every N]: what the normal contacts of our models did
/// since one of them was first named. Added by pair_style or fix wall/gran itself as `fix granulaw all
/// granulaw/stats` if the deck adds none. At the start of a run it prints the table of the laws and checks
/// the time step; at the end it prints a line and writes FILE, which it also does every N steps. The counts
/// survive restart files.
///
/// Global scalar: energy dissipated by normal contacts, J. Global vector (all since then):
///   1, 2   energy dissipated in particle-particle, particle-wall contacts, J
///   3, 4   contacts begun, particle-particle, particle-wall
///   5, 6   largest approach speed at first touch, m/s
///   7, 8   largest overlap/R*
///   9      contact-steps beyond the law's table
///   10     largest I = rho V^2/Y at first touch (0 for thornton)
///   11     contacts that began faster than the law's inertia or rate axis goes
///   12     contacts that came deeper than 90 % of the table
///   13     time step allowed by the stiffest contact so far, s (0: no contact yet)
///   14     elastic energy that contacts hold now, J (energy on; else 0)
///   15     work taken by all forces but the normal law's and waves (friction, ...), J (energy on; else 0)
///   16     contacts that began slower than the slowest impact of a rate law
///   17     contacts that began deeper than one step's motion can bring them (inserted into each other, mesh
///          edges)
///   18     elastic energy that those held when they began, J
///   19     energy that waves took, J
/// Global array: a row for each pair of atom types, then one for each atom type with each wall's
/// (row_of_types); columns: contacts begun, ended, energy dissipated by them (J), work of the other forces
/// (J, energy on), largest approach speed (m/s), largest overlap/R*, contacts of f[17], energy that waves
/// took (J). Per atom with `energy on`, J: elastic energy now, dissipated by normal contacts, work of the
/// other forces and waves.
class FixStats : public LAMMPS_NS::Fix
{
 public:
  static constexpr int vector_length = places(&Quantity::vector), array_columns = places(&Quantity::column);
  static constexpr int time_step_place = 12;  // in the vector, where frequency2 stands

  FixStats(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);
  ~FixStats() override;

  int setmask() override;
  void setup_pre_force(int) override;
  void setup(int vflag) override;
  void pre_force(int vflag) override;
  void pre_exchange() override { warn_of_long_steps(); }
  void end_of_step() override;
  void post_run() override;
  double compute_scalar() override;
  double compute_vector(int n) override;
  double compute_array(int row, int column) override;
  void write_restart(FILE* file) override;
  void restart(char* buffer) override;
  void grow_arrays(int nmax) override;
  void copy_arrays(int from, int to, int delete_flag) override;
  /// Writes the files from one rank: `message` ends the run.
  void write_at_stop(const std::string& message);

 private:
  void read_keywords(int narg, char** arg);
  /// Contacts deeper than PairInfo::deep_overlap. `sum`: with the contacts that are open.
  DeepContacts deep_contacts(const ContactStatistics& sum) const;
  /// Books what open contacts did, before the contact statistics are read.
  void settle();
  /// The contact statistics summed (or its largest values) over ranks. Collective.
  ContactStatistics total();
  /// `with_open`: as the ranks keep it, with the contacts that are open (ContactStatistics::Pair::overlap).
  ContactStatistics sum_of_ranks(bool with_open);
  double stored_energy() const;
  /// LIGGGHTS reads the energies of the particles by an address: in a run that of the property, between runs
  /// that of a copy, since a command may remove the property.
  void find_energies();
  void keep_energies();
  bool writes_stats() const;
  /// A row of the energies over time. Collective.
  void add_energies();
  void write_json(const ContactStatistics& sum, const DeepContacts& deep, const std::string& path) const;
  void write_files(const ContactStatistics& sum, const DeepContacts& deep) const;
  void print(const std::string& text) const;
  /// Once for each `what`.
  void warn(const std::string& what, const std::string& text) const;
  void warn_of_clumps() const;
  void warn_of_lost_contacts() const;
  /// Warns if a contact of this run was stiffer than the time step allows, once for each step. Collective.
  void warn_of_long_steps() const;
  void warn_of_sizes() const;
  void warn_of_step_check() const;
  void warn_of_laws_without_checksum() const;
  void warn_of_laws_without_radii() const;
  /// Stops where a file that is to be written later cannot be. Collective.
  void check_files() const;
  /// Particles that have several contacts deeper than PairInfo::deep_overlap now. Collective.
  double crowded_particles() const;
  /// True in the one fix that speaks, if a deck has several.
  bool speaks() const;
  DeckUnits deck_units() const;

  std::shared_ptr<Session> session_;
  std::string path_, last_table_;
  std::string stopped_;  ///< the message that ends the run
  double** kept_energies_ = nullptr;  // of the particles, between runs
  bool in_run_ = false, settled_ = false;
  double largest_dt_ = 0;
  int every_ = 0;  ///< steps between two files; 0: at the end of a run alone
  EnergySeries energies_;
  double crowded_ = 0;  ///< largest of crowded_particles() where it was asked: every N steps and at the end
  ContactStatistics rows_;  // of compute_array: total() of step_of_rows_
  LAMMPS_NS::bigint step_of_rows_ = -1;
};

}  // namespace granulaw::plugin
