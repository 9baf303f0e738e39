#pragma once

#include <cmath>
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
  double x = 0;            ///< impact speed or displacement; 0 where the kind has neither
  double y = 0;            ///< what was measured
  double sd = 0;           ///< its standard deviation; 0: not stated
  int line = 0;            ///< of the file
  double relative_sd = 0;  ///< over 0: none was stated, and it is this share of the true value

  /// Of a true value that is assumed: what is far too low has no smaller noise for that.
  double sd_at(double value) const { return relative_sd > 0 ? relative_sd * std::abs(value) : sd; }
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
  std::optional<LawMaterial> ball;  ///< restitution: the sphere's; what is fitted is the thick wall's
  bool fit_offset = false;          ///< curves: the displacement of first touch is unknown
  bool fit_compliance = false;      ///< curves: the machine gives way in proportion to the force

  /// Impacts: density of the sphere, kg/m^3, where what is fitted is of this density.
  double sphere_density(double fitted_density) const { return ball ? ball->density : fitted_density; }
  /// Curves: index of the datum of largest displacement; what follows is unloading.
  std::size_t reversal() const;
  /// Curves: number of data on loading. Where the curve turned between two rows, the datum of largest
  /// displacement may be the first on unloading: its force is below that of the datum before.
  std::size_t loading_rows() const;
  /// Curves with unloading: how far beyond the largest displacement, m, the curve may have turned: the
  /// spacing of the rows there. 0: no datum is on unloading.
  double turn_gap() const;
  /// Curves: contacts that share the displacement.
  double contacts() const { return kind == MeasurementKind::platens ? 2 : 1; }
  /// Curves: R* of a contact.
  double effective_radius() const;
};

}  // namespace granulaw
