// `normal granulaw`, `tangential granulaw` and `rolling granulaw` of pair_style granular and fix wall/gran granular, and the fix that names the law file.
// Sources to copy into src/GRANULAR of a LAMMPS of 2025 or later (docs/reference/pair_granulaw.md). Checked against headers of that source by a compiler,
// not linked and not run: no such LAMMPS was at hand.
#ifndef GRAN_SUB_MOD_GRANULAW_H
#define GRAN_SUB_MOD_GRANULAW_H

#include <granulaw.h>

#include <memory>
#include <string>
#include <vector>

#include "fix.h"
#include "gran_sub_mod_normal.h"
#include "gran_sub_mod_rolling.h"
#include "gran_sub_mod_tangential.h"

namespace LAMMPS_NS {

/// fix ID all granulaw/law FILE MATERIAL1 MATERIAL2 ...: stands in front of pair_coeff; materials are numbers of the sub-models, 0 is a rigid wall.
/// f_ID[1..4]: energy that plastic flow, waves, friction and plastic shear took.
class FixGranulawLaw : public Fix {
 public:
  FixGranulawLaw(class LAMMPS *, int, char **);
  ~FixGranulawLaw() override { granulaw_close(law); }
  int setmask() override { return 0; }
  double compute_vector(int) override;
  const char *material(double number) const;    // "wall" of 0

  granulaw_law *law = nullptr;
  granulaw_pair units{};    // usual numbers, in the deck's units
  double own[GRANULAW_MECHANISMS] = {}, shared[GRANULAW_MECHANISMS] = {};    // shared: contacts that another rank computes, too

 private:
  std::vector<std::string> materials;
};

namespace Granular_NS {

  /// normal granulaw A B: numbers of the materials of i and j. One call of granulaw_advance serves the three sub-models.
  class GranSubModNormalGranulaw : public GranSubModNormal {
   public:
    GranSubModNormalGranulaw(class GranularModel *, class LAMMPS *);
    void coeffs_to_local() override { damp = 0.0; }
    void mix_coeffs(double *, double *) override;
    void init() override;
    double calculate_contact_radius() override;
    double calculate_forces() override;

    granulaw_answer now{};

   private:
    granulaw_motion motion() const;
    class FixGranulawLaw *fix = nullptr;
    std::shared_ptr<granulaw_contact_law> contact;
  };

  /// tangential granulaw MU Z PLASTIC: friction, damping ratio, 0 (history) or 1 (plastic).
  class GranSubModTangentialGranulaw : public GranSubModTangential {
   public:
    GranSubModTangentialGranulaw(class GranularModel *, class LAMMPS *);
    void coeffs_to_local() override { mu = coeffs[0], damp = coeffs[1]; }
    void calculate_forces() override;
    bool plastic() const { return coeffs[2] != 0.0; }
  };

  /// rolling granulaw: the couple of `tangential plastic`.
  class GranSubModRollingGranulaw : public GranSubModRolling {
   public:
    GranSubModRollingGranulaw(class GranularModel *, class LAMMPS *);
    void calculate_forces() override;
  };

}    // namespace Granular_NS
}    // namespace LAMMPS_NS

#endif
