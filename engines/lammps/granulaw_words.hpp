#pragma once

#include "lammps_fmt.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "atom.h"
#include "error.h"
#include "granulaw.h"
#include "pointers.h"

// pair_style granulaw and fix wall/granulaw: Granulaw's contact laws in LAMMPS, by granulaw.h.
namespace granulaw::lammps {

using LAMMPS_NS::LAMMPS;

struct Close
{
  void operator()(granulaw_law* law) const { granulaw_close(law); }
  void operator()(granulaw_contact_law* law) const { granulaw_close_contact(law); }
};

/// A law file in memory. Rank 0 reads it for all.
struct LawFile
{
  std::string path;
  std::shared_ptr<granulaw_law> law;

  static LawFile read(LAMMPS* lmp, const std::string& path);
  /// Of the file, SI; a sentence ends the run if it has none of this name.
  granulaw_material material(LAMMPS* lmp, const std::string& name) const;
};

/// Law of two materials as a loop over contacts uses it.
struct ContactLaw
{
  std::unique_ptr<granulaw_contact_law, Close> law;
  int values = 0;            ///< history of a contact: the law's, then three of the rolling spring
  double rolling = 0.0;      ///< coefficient of rolling friction
  double shear = 0.0;        ///< 8 G* of Mindlin's spring, stretched
  bool stops_beyond = true;  ///< stops at overlaps more than 5 % beyond the law's table
};

/// Values of the keywords that pair style and wall have in common.
struct Words
{
  granulaw_pair pair{};
  double rolling = 0.0;
  bool stops_beyond = true;

  /// Defaults, in the deck's units.
  static Words usual(LAMMPS* lmp);
  /// Reads keywords up to the first that is none; returns its place. `where` begins the sentence about a wrong value.
  int read(LAMMPS* lmp, int k, int narg, char** arg, const std::string& where);
  /// The law of a and b. b "wall": rigid. Radii of most bodies in the deck's units; 0: unknown.
  ContactLaw contact(LAMMPS* lmp, const LawFile& file, const std::string& a, const std::string& b, double radius_a, double radius_b) const;
};

/// What contacts took, and how many steps or contacts were out of the law's range.
struct Books
{
  static constexpr int size = GRANULAW_MECHANISMS + 4;
  std::array<double, size> own{}, shared{};  ///< shared: contacts that another rank computes, too

  double total(int k) const { return own[k] + 0.5 * shared[k]; }
  /// Those that a deck can name, in their places on the page: no adhesion, which these styles lack.
  static constexpr int values = size - 1;
  double value(int k) const { return total(k < GRANULAW_ADHESION ? k : k + 1); }
  /// Of all ranks. Collective.
  std::array<double, size> sums(MPI_Comm world) const;
  /// Into a restart file. Collective.
  void write(LAMMPS* lmp, FILE* file) const;
  /// What write() wrote; `before` is that of warn().
  void read(LAMMPS* lmp, const char* buffer, std::array<double, 4>& before);
  /// Books the bits of an answer. A contact more than 5 % beyond the table, or of a wrong size under a rate-dependent law, ends the run.
  static void range(LAMMPS* lmp, double* book, const ContactLaw& law, const granulaw_motion& m, const granulaw_answer& now, LAMMPS_NS::tagint atom);
  /// Warns on rank 0 about contacts out of range since `before`, which is set to the totals of now.
  static void warn(LAMMPS* lmp, const Books& books, std::array<double, 4>& before, const char* where);
};

/// Masses of rigid bodies and of frozen particles, where a deck has any.
class BodyMass
{
 public:
  void find(LAMMPS* lmp);
  bool any() const { return !rigid_.empty() || freeze_ != 0; }
  /// 1/m of the body of a local atom; 0: frozen.
  double inverse(const LAMMPS_NS::Atom& atom, int i) const;

 private:
  std::vector<int> rigid_;  // places in the list of fixes
  int freeze_ = 0;          // bits of frozen groups
  LAMMPS* lmp_ = nullptr;
};

[[noreturn]] inline void stop_all(LAMMPS* lmp, const std::string& sentence)
{
  lmp->error->all(FLERR, sentence);
}
[[noreturn]] inline void stop_one(LAMMPS* lmp, const std::string& sentence)
{
  lmp->error->one(FLERR, sentence);
}

/// n x v.
inline void cross(const double* n, const double* v, double* product)
{
  product[0] = n[1] * v[2] - n[2] * v[1];
  product[1] = n[2] * v[0] - n[0] * v[2];
  product[2] = n[0] * v[1] - n[1] * v[0];
}

/// Completes a motion whose normal and overlap are set. Levers: from the centres to the contact. b of a wall: omega of zeros, lever 0.
inline void set_velocities(granulaw_motion& m, const double* velocity, const double* omega_a, const double* omega_b, double lever_a, double lever_b)
{
  const double* n = m.normal;
  const double vn = velocity[0] * n[0] + velocity[1] * n[1] + velocity[2] * n[2];
  const double w[3] = {lever_a * omega_a[0] + lever_b * omega_b[0], lever_a * omega_a[1] + lever_b * omega_b[1], lever_a * omega_a[2] + lever_b * omega_b[2]};
  const double turn[3] = {omega_a[0] - omega_b[0], omega_a[1] - omega_b[1], omega_a[2] - omega_b[2]};
  m.approach = -vn;
  m.slide[0] = velocity[0] - vn * n[0] - (w[1] * n[2] - w[2] * n[1]);
  m.slide[1] = velocity[1] - vn * n[1] - (w[2] * n[0] - w[0] * n[2]);
  m.slide[2] = velocity[2] - vn * n[2] - (w[0] * n[1] - w[1] * n[0]);
  m.rolling[0] = turn[1] * n[2] - turn[2] * n[1];
  m.rolling[1] = turn[2] * n[0] - turn[0] * n[2];
  m.rolling[2] = turn[0] * n[1] - turn[1] * n[0];
}

/// Rolling friction as LIGGGHTS's `rolling_friction epsd2`: a spring k_t R*^2 with the limit mu_r R* F; adds to the couple on a.
inline void roll(const ContactLaw& law, const granulaw_motion& m, double r_eff, granulaw_answer& now, double* spring)
{
  const double k = law.shear * std::sqrt(r_eff * m.overlap) * r_eff * r_eff;
  double turn[3], torque[3];
  cross(m.normal, m.rolling, turn);  // n x (w x n): w without its part along n
  for (int c = 0; c < 3; ++c) torque[c] = spring[c] + turn[c] * (m.dt * k);
  const double size = std::sqrt(torque[0] * torque[0] + torque[1] * torque[1] + torque[2] * torque[2]);
  const double most = now.normal * r_eff * law.rolling, part = size > most ? most / size : 1.0;
  for (int c = 0; c < 3; ++c) {
    torque[c] *= part;
    now.couple[c] -= torque[c];
    if (!m.asked_again) spring[c] = torque[c];
  }
}

/// A step of one contact. Returns false if the motion has no number.
inline bool advance(const ContactLaw& law, const granulaw_motion& m, double* history, granulaw_answer& now, double* book)
{
  if (granulaw_advance(law.law.get(), 1, &m, history, &now, book, nullptr)) return false;
  if (law.rolling > 0.0) roll(law, m, std::isinf(m.radius_b) ? m.radius_a : m.radius_a * m.radius_b / (m.radius_a + m.radius_b), now, history + law.values - 3);
  return true;
}

}  // namespace granulaw::lammps
