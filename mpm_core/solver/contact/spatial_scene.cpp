#include "solver/contact/spatial_scene.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "solver/contact/spatial_contact.hpp"

namespace granulaw {

namespace {

std::array<double, 3> as_array(const Vector3& v)
{
  return {v[0], v[1], v[2]};
}

/// The same impulse on the mirrored bodies: components along the mirrors cancel where the plane crosses them.
void add_mirrored(const SpatialBody& body, const Plane& plane, PlaneTally& tally)
{
  for (int d = 0; d < 3; ++d)
    if (body.mirrored[d] && std::abs(plane.normal[d]) < 1e-9) {
      tally.impulse[d] = 0, tally.centre[d] = 0;
      for (int e = 0; e < 3; ++e)
        if (e != d) tally.torque[e] = 0;
    }
  tally.impulse *= plane.copies, tally.torque *= plane.copies, tally.centre *= plane.copies;
}

}  // namespace

void SpatialScene::end_sample(double time, std::vector<PlaneTrace>& traces)
{
  auto& planes = static_cast<SpatialContact&>(*contact);
  const SpatialBody& body = bodies.front();
  const Vector3 now = centre + Vector3(body.travel[0], body.travel[1], body.travel[2]);
  std::vector<PlaneTally> tallies = planes.take_tallies();
  traces.resize(tallies.size());
  for (std::size_t k = 0; k < tallies.size(); ++k) {
    const Plane& plane = planes.planes()[k];
    PlaneTally& tally = tallies[k];
    add_mirrored(body, plane, tally);
    const double push = plane.normal.dot(tally.impulse);
    const Vector3 torque = tally.torque - now.cross(tally.impulse);
    const Vector3 arm = push > 0 ? Vector3(tally.centre / push - now) : Vector3(Vector3::Zero());
    traces[k].normal = as_array(plane.normal);
    traces[k].samples.push_back({plane.position - plane.start, push / time, as_array(tally.impulse / time),
                                 as_array(torque / time), as_array(arm),
                                 planes.contact_axes(body, static_cast<int>(k))});
  }
}

}  // namespace granulaw
