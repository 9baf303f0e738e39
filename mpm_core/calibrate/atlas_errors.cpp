#include "calibrate/atlas_errors.hpp"

#include <cmath>

namespace granulaw {

namespace {

template <class Checks, class Of>
double rms_near(const Checks& checks, double stiffness, const Of& of)
{
  const double width = std::log(2.0);
  double sum = 0, weights = 0;
  for (const auto& c : checks) {
    const double distance = std::log(c.material.stiffness / stiffness) / width;
    const double weight = std::exp(-0.5 * distance * distance);
    sum += weight * of(c) * of(c), weights += weight;
  }
  return weights > 0 ? std::sqrt(sum / weights) : 0;
}

}  // namespace

AtlasErrors errors_of(const Atlas& atlas, double asked)
{
  const double stiffness =
      std::fmin(std::fmax(asked, atlas.grid().stiffnesses.front()), atlas.grid().stiffnesses.back());
  const auto& impacts = atlas.checks();
  const auto& presses = atlas.midplane().checks();
  AtlasErrors e;
  e.solver = rms_near(impacts, stiffness, [](const AtlasCheck& c) { return c.solver_estimate; });
  e.restitution = rms_near(impacts, stiffness, [](const AtlasCheck& c) { return c.error_restitution; });
  e.force =
      std::hypot(rms_near(impacts, stiffness, [](const AtlasCheck& c) { return c.error_force; }), e.solver);
  e.midplane_force = std::hypot(
      rms_near(presses, stiffness, [](const MidplaneCheck& c) { return c.error_force; }), e.solver);
  e.recovery = std::hypot(
      rms_near(presses, stiffness, [](const MidplaneCheck& c) { return c.error_recovery; }), 2 * e.solver);
  return e;
}

}  // namespace granulaw
