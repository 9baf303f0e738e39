#pragma once

#include <list>
#include <map>
#include <memory>
#include <vector>

#include "calibrate/material_lattice.hpp"
#include "calibrate/measurement.hpp"
#include "characterise/composed_law.hpp"
#include "law/contact_curve.hpp"

namespace granulaw {

/// The slow law of a spherical indenter on a specimen, a sphere or thick and flat: composed of what the atlas
/// knows of both (docs/theory/pairs.md). A composed law takes some hundredths of a second. So shapes are
/// computed at the materials of a lattice and interpolated, as the atlas interpolates its own.
class IndenterModel
{
 public:
  /// Throws Error if the atlas does not know the indenter's material. `atlas` outlives this.
  IndenterModel(const Atlas& atlas, const Measurement& measurement, std::vector<Parameter> varied);

  struct Law
  {
    LawMaterial specimen;
    ContactCurve curve;
    double length = 0, force = 0;  ///< m, N: units of overlap and force
    double force_error = 0;        ///< sd, relative
  };
  /// Valid until the next call.
  const Law& law(const LawMaterial& specimen) const;

 private:
  struct Shape
  {
    LawShape shape;
    double log_onset = 0, log_end = 0;
  };
  LawMaterial on_lattice(const LawMaterial& specimen) const;
  LawMaterial indenter_on(const LawMaterial& specimen) const;
  const Shape& at(const MaterialLattice::Corner& corner) const;
  Shape compose(const LawMaterial& specimen) const;
  Law make(const LawMaterial& specimen) const;

  const Atlas* atlas_;
  double effective_radius_,
      radius_ratio_;  // m; of the indenter's radius to the specimen's, 0: thick and flat
  std::optional<LawMaterial> indenter_;
  MaterialLattice lattice_;
  mutable std::map<MaterialLattice::Key, Shape> known_;
  mutable std::list<Law> laws_;  // the last ones first
};

}  // namespace granulaw
