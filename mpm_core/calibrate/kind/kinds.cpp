#include <algorithm>
#include <array>

#include "base/error.hpp"
#include "calibrate/kind/kind.hpp"

namespace granulaw {

extern const Kind restitution_kind, contact_radius_kind, residual_displacement_kind,
    contact_time_kind;                                     // impacts.cpp
extern const Kind platens_kind, flat_kind, indenter_kind;  // curves.cpp
extern const Kind hardness_kind, onset_force_kind;         // numbers.cpp

std::span<const Kind* const> kinds()
{
  static constexpr std::array all{&restitution_kind,  &contact_radius_kind, &residual_displacement_kind,
                                  &contact_time_kind, &platens_kind,        &flat_kind,
                                  &indenter_kind,     &hardness_kind,       &onset_force_kind};
  return all;
}

const Kind& kind_named(const std::string& name, const std::string& where)
{
  std::vector<std::string> names;
  for (const Kind* kind : kinds()) {
    if (kind->name == name) return *kind;
    names.emplace_back(kind->name);
  }
  fail_unknown(where, "no kind of measurement", name, names);
}

void legendre(double t, double out[3])
{
  t = std::clamp(t, -1.0, 1.0);
  out[0] = 1, out[1] = std::sqrt(3.0) * t, out[2] = std::sqrt(5.0) * 0.5 * (3 * t * t - 1);
}

}  // namespace granulaw
