#pragma once

#include <span>
#include <vector>

#include "contact/confined.hpp"

namespace granulaw {

/// A sphere between rigid, frictionless planes by the law of a confined particle: the centre stays where the forces balance.
/// Units of PlasticBody: lengths over R, forces over Y R^2, energies over Y R^3.
class BetweenPlanes
{
 public:
  /// Longest step, a part of the elastic range of any contact of a body with E*/Y below 3000.
  static constexpr double longest_step = 2e-5;

  /// `normals`: unit, from the centre to the plane; `overlaps`: negative, where a plane is apart. The body outlives this.
  BetweenPlanes(const PlasticBody& body, const std::vector<Vector>& normals, std::span<const double> overlaps);

  /// Moves every plane inwards by its way.
  void move(std::span<const double> ways);
  std::span<const double> forces() const { return forces_; }
  std::span<const double> areas() const { return areas_; }
  double work() const { return work_; }  ///< of the planes
  const Vector& centre() const { return centre_; }
  const ConfinedParticle& particle() const { return particle_; }

 private:
  void balance();

  const PlasticBody* body_;
  ConfinedParticle particle_;
  ConfinedRoom room_;
  std::vector<SideStep> steps_;
  std::vector<double> forces_, areas_, stiffness_;
  Vector centre_{}, shift_{};
  double work_ = 0;
};

}  // namespace granulaw
