#include "characterise/shape/orientations.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

namespace granulaw {

std::vector<Vector3> contact_directions(const Shape& solid, int count)
{
  constexpr double quarter = std::numbers::pi / 2, golden = std::numbers::phi - 1;
  const std::array<bool, 3> planes = solid.symmetric();
  const double lowest = planes[2] ? 0 : -1;
  const double first_angle = planes[0] && !planes[1] ? -quarter : 0;
  const double angles = 4 * quarter / ((planes[0] ? 2 : 1) * (planes[1] ? 2 : 1));
  std::vector<Vector3> directions;
  for (int k = 0; k < count; ++k) {
    const double z = lowest + (1 - lowest) * (k + 0.5) / count, r = std::sqrt((1 - z) * (1 + z));
    const double turns = (k + 0.5) * golden, angle = first_angle + angles * (turns - std::floor(turns));
    directions.push_back({r * std::cos(angle), r * std::sin(angle), z});
  }
  return directions;
}

std::vector<Orientation> orientations_of(const Shape& solid, int count)
{
  const MassProperties mass = solid.mass_properties();
  std::vector<Orientation> orientations;
  for (const Vector3& direction : contact_directions(solid, count)) {
    Vector3 contact;
    solid.support(direction, &contact);
    orientations.push_back({direction, contact, solid.principal_radii(direction),
                            effective_mass_share(mass, contact, direction), (contact - mass.centre).dot(direction)});
  }
  return orientations;
}

double effective_mass_share(const MassProperties& mass, const Vector3& contact, const Vector3& normal)
{
  const Vector3 lever = (contact - mass.centre).cross(normal);
  return 1 / (1 + mass.volume * lever.dot(mass.inertia.ldlt().solve(lever)));
}

}  // namespace granulaw
