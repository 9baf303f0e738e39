#pragma once

#include <string>
#include <vector>

#include "solver/shape/solid.hpp"

namespace granulaw {

/// A ball of a clump, m.
struct ClumpBall
{
  Vector3 centre;
  double radius;
};

/// The union of overlapping balls: LIGGGHTS's multisphere.
class ClumpSolid : public Solid
{
 public:
  /// Balls inside others are left out. `where` leads the Error if there is no ball or the union falls apart.
  ClumpSolid(const std::vector<ClumpBall>& balls, const std::string& where);

  double depth(const Vector3& x) const override;  ///< the distance itself, everywhere
  Vector3 outward_normal(const Vector3& x) const override;
  double support(const Vector3& direction, Vector3* where) const override;
  PrincipalRadii principal_radii(const Vector3& direction) const override;
  double finest_radius() const override { return finest_; }
  std::array<bool, 3> symmetric() const override;
  MassProperties mass_properties() const override;
  const char* kind() const override { return "clump"; }
  std::string definition() const override;

 private:
  /// Where the surfaces of two balls meet: centre + radius (cos(angle) along + sin(angle) across), on the
  /// surface of the union for the angles of `exposed`, pairs (from, to).
  struct Groove
  {
    Vector3 centre, along, across;
    double radius;
    std::vector<std::pair<double, double>> exposed;
  };
  struct Nearest
  {
    double distance;
    Vector3 outward;  // from the place to the surface, length 1
  };

  void add_groove(std::size_t i, std::size_t j);
  bool is_buried(const Vector3& point) const;
  Nearest nearest_from_inside(const Vector3& x) const;
  std::size_t nearest_ball(const Vector3& x) const;
  void check_connected(const std::string& where) const;

  std::vector<ClumpBall> balls_;
  std::vector<Groove> grooves_;
  std::vector<Vector3> corners_;  // ends of exposed arcs: where three balls meet
  double size_ = 0;               // m, largest radius
  double finest_ = 0;
};

/// Balls of LIGGGHTS's multisphere file (fix particletemplate/multisphere, spheres file): lines of x y z r,
/// '#' begins a comment; all times `scale`.
std::vector<ClumpBall> read_clump(const std::string& path, double scale);

}  // namespace granulaw
