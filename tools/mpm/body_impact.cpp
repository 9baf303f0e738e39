#include "body_impact.hpp"

#include <Eigen/Dense>

#include "characterise/shape/energetic_restitution.hpp"
#include "characterise/shape/orientations.hpp"
#include "solver/shape/rotation.hpp"

namespace granulaw {

namespace {

/// The mass by its impulse; the tensor of inertia is that of a homogeneous body of this mass.
RigidBody rigid_body(const Particle& particle, const Approach& thrown, const Rebound& rebound)
{
  const MassProperties of_one = shape_of(particle)->mass_properties();
  const double mass = rebound.impulse_normal / (thrown.velocity * (1 + rebound.normal));
  const auto& [x, y, z] = thrown.orientation;
  const Eigen::Matrix3d turned = rotation_to_plane(Vector3(x, y, z).normalized(), thrown.turn);
  return {mass, mass / of_one.volume * turned * of_one.inertia * turned.transpose()};
}

/// True where the normal of the first contact passes through the centre of mass.
bool is_central(const Particle& particle, const Approach& thrown)
{
  const auto& [x, y, z] = thrown.orientation;
  const Vector3 direction = Vector3(x, y, z).normalized();
  const SharedShape solid = shape_of(particle);
  Vector3 contact;
  solid->support(direction, &contact);
  constexpr double rounding = 1e-6;
  return effective_mass_share(solid->mass_properties(), contact, direction) > 1 - rounding;
}

}  // namespace

RunResult body_impact(const Particle& particle, const Approach& thrown, const Partner& partner, const RunOptions& options, CentreMotion& centre)
{
  RunResult result = impact(particle, thrown, partner, options);
  if (!result.rebound) return result;
  if (partner.particle) {  // two spheres, relative to each other: no planes
    centre.contacts = 1;
    centre.tangential_after = thrown.tangential_velocity == 0 ? 0 : result.rebound->tangential * thrown.tangential_velocity;
    return result;
  }
  const RigidMotion before{Vector3(thrown.tangential_velocity, 0, -thrown.velocity), Vector3(0, thrown.spin, 0)};
  const ContactWork work = contact_work(result, rigid_body(particle, thrown, *result.rebound), before);
  if (!is_central(particle, thrown)) {
    result.summary.restitution = work.restitution();
    result.summary.work_load = work.taken, result.summary.work_unload = work.given_back;
  }
  centre.tangential_after = work.velocity_after.x();
  centre.contacts = work.contacts;
  return result;
}

}  // namespace granulaw
