#pragma once

#include <optional>
#include <string>
#include <vector>

#include "law/law_material.hpp"

namespace granulaw {

/// What was measured. The columns of each file: measurement_file.hpp.
enum class MeasurementKind {
  restitution,  ///< e of a sphere that hits a wall, or its like, against the impact speed
  platens,      ///< force on a sphere between two platens against the displacement of one towards the other
  flat,         ///< force of one contact with a flat against its overlap
  indenter,     ///< force of a spherical indenter against its displacement towards the specimen's middle
  contact_radius,         ///< m, of the flattened area, against the impact speed
  residual_displacement,  ///< m, residual overlap after an impact, against its speed
  contact_time,           ///< s, against the impact speed
  hardness,               ///< Pa, Vickers: force over the dent's area
  onset_force             ///< N, at which a contact with a flat begins to yield
};

bool is_curve(MeasurementKind kind);  ///< force against displacement
bool is_impact(MeasurementKind kind);

/// What an impact is against.
enum class ImpactPartner {
  rigid_wall,
  like_sphere  ///< the speed is that of approach
};

/// One measured value. SI.
struct Datum
{
  double x = 0;   ///< impact speed or displacement; 0 where the kind has neither
  double y = 0;   ///< what was measured
  double sd = 0;  ///< its standard deviation; 0: not stated
  int line = 0;   ///< of the file
};

/// The values of one file.
struct Measurement
{
  MeasurementKind kind = MeasurementKind::restitution;
  std::string source;  ///< leads messages: the file's path
  std::vector<Datum> data;
  double radius = 0;           ///< m, of the sphere; infinity: a thick flat specimen, which an indenter meets
  double indenter_radius = 0;  ///< m; of the kind indenter
  std::optional<LawMaterial> indenter;  ///< its material; none: rigid
  ImpactPartner partner = ImpactPartner::rigid_wall;
  std::optional<LawMaterial> wall;  ///< restitution: a thick wall of this material in place of the rigid one
  bool fit_offset = false;          ///< curves: the displacement of first touch is unknown
  bool fit_compliance = false;      ///< curves: the machine gives way in proportion to the force

  /// Curves: index of the datum of largest displacement; what follows is unloading.
  std::size_t reversal() const;
  /// Curves: contacts that share the displacement.
  double contacts() const { return kind == MeasurementKind::platens ? 2 : 1; }
  /// Curves: R* of a contact.
  double effective_radius() const;
};

}  // namespace granulaw
