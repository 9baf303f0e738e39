#include <algorithm>
#include <array>

#include "base/error.hpp"
#include "calibrate/kind/kind.hpp"
#include "solver/material/law_table.hpp"

namespace granulaw {

extern const Kind restitution_kind, contact_radius_kind, residual_displacement_kind,
    contact_time_kind;                                     // impacts.cpp
extern const Kind platens_kind, flat_kind, indenter_kind;  // curves.cpp
extern const Kind hardness_kind, brinell_30_kind, brinell_10_kind, brinell_5_kind;  // hardness.cpp
extern const Kind onset_force_kind;                        // numbers.cpp

std::span<const Kind* const> kinds()
{
  static constexpr std::array all{&restitution_kind,  &contact_radius_kind, &residual_displacement_kind,
                                  &contact_time_kind, &platens_kind,        &flat_kind,
                                  &indenter_kind,     &hardness_kind,       &brinell_30_kind,
                                  &brinell_10_kind,   &brinell_5_kind,      &onset_force_kind};
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

Prediction same_value(const Measurement& m, double value, double sd)
{
  Prediction p;
  p.values.assign(m.data.size(), value);
  p.errors = {std::vector<double>(m.data.size(), sd)};
  p.scatter.assign(m.data.size(), 0.0);
  return p;
}

std::optional<FlowShown> flow_shown(const Measurement& m, const CandidateMaterial& material)
{
  if (!m.kind->flow_strain || m.ratio_to_yield) return std::nullopt;
  const double strain = m.kind->flow_strain(material);
  return FlowShown{strain, flow_stress(solver_material(material), strain)};
}

void legendre(double t, double out[3])
{
  t = std::clamp(t, -1.0, 1.0);
  out[0] = 1, out[1] = std::sqrt(3.0) * t, out[2] = std::sqrt(5.0) * 0.5 * (3 * t * t - 1);
}

}  // namespace granulaw
