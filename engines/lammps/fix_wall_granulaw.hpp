#pragma once

#include "granulaw_words.hpp"  // before LAMMPS's headers

#include <algorithm>

#include "fix.h"
#include "region.h"

namespace granulaw::lammps {

/// fix ID group wall/granulaw xplane|yplane|zplane LO HI, zcylinder R, or region ID; then [of MATERIAL] and keywords
/// (docs/reference/pair_granulaw.md). File, materials and keywords are pair_style's.
class FixWallGranulaw : public LAMMPS_NS::Fix
{
 public:
  FixWallGranulaw(LAMMPS* lmp, int narg, char** arg);
  ~FixWallGranulaw() override;
  int setmask() override { return LAMMPS_NS::FixConst::POST_FORCE | LAMMPS_NS::FixConst::POST_RUN; }
  void init() override;
  void setup(int vflag) override { post_force(vflag); }
  void post_force(int) override;
  void post_run() override { Books::warn(lmp, books_, warned_, where_.c_str()); }
  void write_restart(FILE* file) override;
  void restart(char* buffer) override;
  void grow_arrays(int n) override { walls_.resize(static_cast<std::size_t>(n) * stride_); }
  void copy_arrays(int i, int j, int) override { std::copy_n(of(i), stride_, of(j)); }
  void set_arrays(int i) override { std::fill_n(of(i), stride_, 0.0); }
  int pack_exchange(int i, double* buffer) override;
  int unpack_exchange(int i, double* buffer) override;
  int pack_restart(int i, double* buffer) override;
  void unpack_restart(int i, int nth) override;
  int size_restart(int) override { return 1 + stride_; }
  int maxsize_restart() override { return 1 + stride_; }
  /// Energy that the contacts store.
  double compute_scalar() override;
  double compute_vector(int k) override;
  double memory_usage() override { return static_cast<double>(walls_.capacity() * sizeof(double)); }

 private:
  /// A wall near a particle.
  struct Near
  {
    int wall = 0;  // from 1 on
    double normal[3], distance, velocity[3] = {0, 0, 0};
  };
  int walls_near(int i, std::vector<Near>& found);
  void set_motion(int i, const Near& wall, granulaw_motion& m, double& lever) const;
  double* of(int i) { return &walls_[static_cast<std::size_t>(i) * stride_]; }
  /// Of atom i: number and history of a wall that it touches; a free one if it has none. Null: all are taken.
  double* slot(int i, int wall);

  enum class Kind { planes, cylinder, region } kind_ = Kind::planes;
  std::string where_, region_id_;
  int axis_ = 0;
  double place_[2] = {0, 0};  // of the planes, or the cylinder's radius
  LAMMPS_NS::Region* region_ = nullptr;
  bool moves_ = false, rigid_plastic_ = false;
  LawFile file_;  // the laws' file stays
  std::vector<ContactLaw> laws_;  // of each type
  BodyMass masses_;
  int values_ = 0, slots_ = 0, stride_ = 0;
  std::vector<double> walls_;  // of each atom, slot by slot: number of the wall, its history
  Books books_;
  std::array<double, 3> force_{};  // on the particles of this rank, in the last step
  std::array<double, 4> warned_{};
};

}  // namespace granulaw::lammps
