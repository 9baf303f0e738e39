#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/impact_body.hpp"
#include "law/law_material.hpp"

namespace granulaw {

struct Kind;  // kind/kind.hpp

/// All kinds of measurement; the first is restitution.
std::span<const Kind* const> kinds();
/// Throws Error naming `where` and the nearest name.
const Kind& kind_named(const std::string& name, const std::string& where);

/// Partner of the sphere in an impact.
enum class ImpactPartner {
  wall,
  like_sphere  ///< the speed is that of approach
};

/// One measured value. SI.
struct Datum
{
  double x = 0;            ///< impact speed or displacement; 0 where the kind has neither
  double y = 0;            ///< the value
  double sd = 0;           ///< its standard deviation; 0: not stated
  int line = 0;            ///< of the file
  double relative_sd = 0;  ///< over 0: none was stated, and it is this fraction of the true value
  int rows = 1;            ///< of the file, of which x and y are the means

  /// Noise about an assumed true value: a measured value that is far too low has no smaller noise.
  double sd_at(double value) const { return relative_sd > 0 ? relative_sd * std::abs(value) : sd; }
};

/// Data of a curve from `first` until before `last` at displacements below one that was reached before: an
/// unloading, and the reloading that follows a partial one.
struct Unloading
{
  std::size_t first, last;
  /// Length, m, of the spacing of the data at the reversal point, beyond which the curve may have turned.
  double gap;
};

/// The values of one file.
struct Measurement
{
  const Kind* kind = kinds().front();
  std::string source;  ///< leads messages: the file's path
  std::vector<Datum> data;
  double radius = 0;           ///< m, of the sphere; infinity: a thick flat specimen, which an indenter meets
  double indenter_radius = 0;  ///< m; over 0: of a spherical indenter
  ImpactPartner partner = ImpactPartner::wall;
  /// Material of the body that is not fitted: an indenter, a deformable wall or the ball; none: rigid.
  std::optional<LawMaterial> counterpart;
  bool counterpart_is_ball = false;  ///< the ball is the counterpart, and a deformable wall is fitted
  ImpactBody body{};                 ///< impacts: what the sphere is fixed to
  bool is_leeb = false;              ///< the values were read as Leeb hardnesses, over 1000 (leeb.hpp)
  bool fit_offset = false;           ///< curves: the displacement of first touch is unknown
  bool fit_compliance = false;       ///< curves: the machine gives way in proportion to the force
  /// Known before the data: 95 % of the ratio of the value to the yield stress lie between, in place of the
  /// model's own ratio.
  std::optional<std::pair<double, double>> ratio_to_yield;
  std::vector<std::string> set_aside{};  ///< sentences on data of the file that are not used

  /// The law of the contact is composed of the laws of two bodies.
  bool is_composed() const { return counterpart || indenter_radius > 0; }
  /// Density of the sphere that drops, kg/m^3, where the fitted material has this one: of a sphere of the impact body's
  /// mass, where there is one.
  double sphere_density(double fitted) const;
  /// Speed on a rigid wall at which the sphere loses as much, over the impact's.
  double wall_share() const { return partner == ImpactPartner::like_sphere ? 0.5 : 1.0; }
  double largest_x() const;
  double largest_y() const;
  /// R* of a contact, m.
  double effective_radius() const;
  /// Curves: overlap of one contact over its R* at the largest displacement.
  double largest_overlap() const;
  /// Curves: index of the datum of largest displacement; unloading follows.
  std::size_t reversal() const;
  /// Curves: all unloadings in their order. The datum of largest displacement is the first of one if its
  /// force is below that of the datum before: the curve turned between the two. A displacement that recedes
  /// without a fall of the force is loading whose displacements scatter.
  std::vector<Unloading> unloadings() const;
};

/// Fills in the standard deviations that are not stated, as the kind does: of a curve its scatter, of other
/// kinds `relative_sd` of the value. Throws Error where a value is over Column::most by more than its noise.
void complete_standard_deviations(Measurement& measurement, double relative_sd);

/// The unknowns of a curve's machine.
struct MachineState
{
  double offset = 0;      ///< m, displacement at first touch
  double compliance = 0;  ///< m/N
  /// m, by Measurement::unloadings(): displacement at the reversal point, less the largest of the data there
  std::vector<double> beyond{};
};

}  // namespace granulaw
