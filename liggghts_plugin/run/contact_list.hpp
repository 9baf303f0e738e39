#pragma once

#include <vector>

#include "compute_pair_gran_local.h"
#include "liggghts_plugin/engine/liggghts.hpp"

namespace granulaw::plugin {

/// LIGGGHTS's compute pair/gran/local and wall/gran/local, with three words more for contacts of our models.
/// Their columns stand behind LIGGGHTS's own, in this order:
///
///   contactRadius     the law's own (m)
///   largestOverlap    since first touch (m); stretched, as the overlap
///   dissipatedEnergy  by the normal law since first touch (J)
///
/// Where none of LIGGGHTS's words is said, its `id` is: particles, or mesh and triangle, come first.
class ContactList : public LAMMPS_NS::ComputePairGranLocal
{
 public:
  /// `words`: which of the three are said; LIGGGHTS's own are in `arg`.
  ContactList(LAMMPS_NS::LAMMPS* lmp, int& iarg, int narg, char** arg, const bool (&words)[3]);

  void init() override;
  void init_cpgl(bool requestflag) override;
  void add_pair(int i, int j, double fx, double fy, double fz, double tor1, double tor2, double tor3,
                double* hist, const double* contact_point) override;
  void add_wall_2(int i, double fx, double fy, double fz, double tor1, double tor2, double tor3, double* hist,
                  double rsq, double* normal) override;

 private:
  const class ContactInquiry* contacts() const;
  /// Fills our columns of the row before `ipair`.
  void fill(const struct ContactPlace& contact);

  bool radius_ = false, overlap_ = false, dissipated_ = false;
  int first_ = 0;  // of our columns
};

/// `arg` of such a compute without our words; `ours`: which of them it has.
std::vector<char*> stock_words_of_list(int narg, char** arg, bool (&ours)[3]);
/// From now on the deck's computes pair/gran/local and wall/gran/local are ContactList.
void provide_contact_list(LAMMPS_NS::LAMMPS* lmp);

}  // namespace granulaw::plugin
