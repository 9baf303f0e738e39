#pragma once

#include "granulaw_words.hpp"  // before LAMMPS's headers

#include "pair.h"

namespace granulaw::lammps {

class FixGranulawHistory;

/// pair_style granulaw FILE keyword value ...; pair_coeff * * MATERIAL ... (docs/reference/pair_granulaw.md).
class PairGranulaw : public LAMMPS_NS::Pair
{
 public:
  explicit PairGranulaw(LAMMPS* lmp);
  ~PairGranulaw() override;
  void compute(int eflag, int vflag) override;
  void settings(int narg, char** arg) override;
  void coeff(int narg, char** arg) override;
  void init_style() override;
  double init_one(int i, int j) override { return radius_[i] + radius_[j]; }
  void write_restart(FILE* file) override;
  void read_restart(FILE* file) override;
  double single(int i, int j, int itype, int jtype, double rsq, double factor_coul, double factor_lj, double& fforce) override;
  int pack_forward_comm(int n, int* list, double* buffer, int, int*) override;
  void unpack_forward_comm(int n, int first, double* buffer) override;

  bool has_materials() const { return !material_.empty(); }
  const LawFile& file() const { return file_; }
  const std::string& material(int type) const { return material_[type]; }
  const Words& words() const { return words_; }
  const BodyMass& masses() const { return masses_; }
  const LAMMPS_NS::NeighList& neighbours() const { return *list; }
  /// Largest radius of a type's particles; larger ones would pass through each other.
  double radius(int type) const { return radius_[type]; }
  /// Of the contact law with most history values.
  int values() const { return values_; }
  bool changes_sign(int place) const;

 private:
  /// The atoms' arrays as a loop over contacts reads them.
  struct Particles
  {
    const double *const *x, *const *v, *const *omega;
    const double *radius, *mass, *inverse_mass;  // inverse_mass: null where no body is rigid or frozen
  };
  Particles particles() const;
  /// True if the two touch; sets the motion and the levers from their centres.
  static bool touches(const Particles& of, int i, int j, granulaw_motion& m, double& lever_i, double& lever_j);
  void refresh_masses();
  void find_sizes();
  void check_densities();
  const ContactLaw& law(int itype, int jtype) const { return laws_[itype * (ntypes_ + 1) + jtype]; }
  /// History of the contact of i with its neighbour j; null: none is open.
  const double* history_of(int i, int j) const;

  LawFile file_;
  Words words_;                              // of pair_style
  std::vector<std::string> material_;        // of each type
  std::vector<ContactLaw> laws_;             // of each pair of types
  std::vector<double> radius_, least_;       // of each type: largest and least radius
  std::vector<std::vector<std::string>> said_;  // pair_style and pair_coeff, as a restart file has them
  std::vector<double> inverse_mass_;         // of each atom, where any is rigid or frozen
  BodyMass masses_;
  FixGranulawHistory* history_ = nullptr;
  int ntypes_ = 0, values_ = 0;
  bool densities_checked_ = false;
};

}  // namespace granulaw::lammps
