#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "solver/contact/planes.hpp"
#include "solver/contact/scene.hpp"
#include "solver/grid/spatial_grid.hpp"
#include "solver/run/setup.hpp"
#include "solver/shape/shape.hpp"

namespace granulaw {

/// A plane that touches the body from the given side, wherever that is.
Plane touching_plane(const Vector3& normal);

/// A particle among planes, before its grid is chosen; solver units. The frame of the scene: origin in the
/// solid's own, turned by `rotation`.
class SpatialSetup : public Setup
{
 public:
  /// `planes`: positions that are not a number become those where they touch. `may_mirror`: axes along which
  /// the motion is the same on both sides.
  SpatialSetup(const Particle& particle, const Eigen::Matrix3d& rotation, std::vector<Plane> planes,
               const std::array<bool, 3>& may_mirror, const RunOptions& options, const Attraction& attraction = {});
  /// In the place of the plane a second sphere, with the plane's friction.
  void meet(const Particle& other, const RunOptions& options);

  double e_star() const override { return e_star_; }
  double yield_stress() const override { return yield_; }
  double expected_overlap(double velocity) const override;
  int cells(const RunOptions& options, double deepest) const override;
  /// The second sphere; null: rigid planes.
  const SpatialSetup* partner() const { return partner_.get(); }
  /// Tensor of inertia of the whole body about its centre of mass; none of a body of several materials.
  std::optional<Eigen::Matrix3d> exact_inertia() const;
  /// Point of the body that touches the first plane.
  const Vector3& first_contact() const { return touches_.front().place; }
  std::unique_ptr<Drive> drive() const override;
  /// Traces of all planes as the caller listed them: mirrored ones are copied from the one computed.
  void give_planes(std::vector<PlaneTrace>& planes) const override;

  /// Planes at rest.
  Scene build(double deepest, int cells, double shift) const override;

 private:
  /// Place where a plane touches, and the surface there.
  struct Touch
  {
    Vector3 place;
    double sharper, flatter;  ///< principal radii
    Vector3 sharper_direction, flatter_direction;
  };
  SpatialSetup(const Particle& particle, const Scales& scale, const Eigen::Matrix3d& rotation,
               std::vector<Plane> planes, const std::array<bool, 3>& may_mirror, const RunOptions& options);
  double plastic_overlap_of(double mass, double velocity) const;
  Body body(double deepest, int cells, double shift) const;
  Vector3 to_body(const Vector3& x) const { return scale_.length * (rotation_.transpose() * x); }
  Touch touch_of(const Plane& plane) const;
  void find_mirrors(const std::array<bool, 3>& may_mirror);
  void drop_mirrored_planes();
  std::array<double, 2> block_of(const Touch& touch, double deepest) const;
  /// Edges of the cells along x, y and z at a contact; rounded edges that touch a plane need a quarter of
  /// their radius.
  Vector3 edges_of(const Touch& touch, const Vector3& normal, double deepest, int cells) const;
  SpatialSection section(double deepest, int cells, double shift) const;
  std::unique_ptr<Pull> pull_of(Planes& planes, const Body& body, double deepest, int cells) const;

  Particle particle_;
  SharedShape solid_;
  Eigen::Matrix3d rotation_;
  std::vector<Plane> planes_;
  Attraction attraction_;  ///< of the planes, SI units
  std::vector<Touch> touches_;
  std::vector<Plane> given_;
  std::vector<int> computed_;  ///< of each given plane the one that is computed: itself or its mirror image
  std::array<bool, 3> mirrored_{};
  bool drawn_, single_;  ///< grids can be drawn; points in single precision
  std::unique_ptr<SpatialSetup> partner_;
  double e_star_ = 1, yield_ = 0, mass_ = 0;
  Vector3 low_, high_;  ///< box of the body
};

}  // namespace granulaw
