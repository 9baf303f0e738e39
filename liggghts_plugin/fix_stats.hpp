#pragma once

#include <memory>
#include <string>

#include "liggghts_plugin/liggghts.hpp"
#include "liggghts_plugin/session.hpp"

namespace granulaw::plugin {

/// fix ID all granulaw/stats [file FILE]: what the normal contacts of models mpm and thornton did since the
/// pair style was set. Added by pair_style itself as `fix granulaw all granulaw/stats` if the deck adds none.
///
/// Global scalar: energy dissipated by normal contacts, J. Global vector (all since the pair style was set):
///   1, 2   energy dissipated in particle-particle, particle-wall contacts, J
///   3, 4   contacts begun, particle-particle, particle-wall
///   5, 6   largest approach speed at first touch, m/s
///   7, 8   largest overlap/R*
///   9      contact-steps beyond the law's table
///   10     largest I = rho V^2/Y at first touch (0 for thornton)
class FixStats : public LAMMPS_NS::Fix
{
 public:
  static constexpr int vector_length = 11;

  FixStats(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);

  int setmask() override { return 0; }
  void post_run() override;
  double compute_scalar() override;
  double compute_vector(int n) override;

 private:
  /// The ledger summed (or its largest values) over ranks. Collective.
  ContactLedger total() const;
  void write_json(const ContactLedger& sum, const std::string& path) const;

  std::shared_ptr<Session> session_;
  std::string path_;
};

}  // namespace granulaw::plugin
