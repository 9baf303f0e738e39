#include "calibrate/atlas_errors.hpp"

#include <cmath>

namespace granulaw {

namespace {

template <class Checks, class Of>
double rms(const Checks& checks, const Of& of)
{
  if (checks.empty()) return 0;
  double sum = 0;
  for (const auto& c : checks) sum += of(c) * of(c);
  return std::sqrt(sum / static_cast<double>(checks.size()));
}

}  // namespace

const AtlasErrors& errors_of(const Atlas& atlas)
{
  static thread_local const Atlas* known = nullptr;
  static thread_local AtlasErrors errors;
  if (known != &atlas) {
    known = &atlas;
    errors.restitution = rms(atlas.checks(), [](const AtlasCheck& c) { return c.error_restitution; });
    errors.force = rms(atlas.checks(), [](const AtlasCheck& c) { return c.error_force; });
    const auto& presses = atlas.midplane().checks();
    errors.midplane_force = rms(presses, [](const MidplaneCheck& c) { return c.error_force; });
    errors.recovery = rms(presses, [](const MidplaneCheck& c) { return c.error_recovery; });
  }
  return errors;
}

}  // namespace granulaw
