#include "calibrate/leeb.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.hpp"
#include "calibrate/kind/kind.hpp"

namespace granulaw {

namespace {

const std::array<LeebDevice, 7>& devices()
{
  const LawMaterial carbide{"tungsten carbide", 14900, 625e9, 0.22}, nitride{"silicon nitride", 3200, 310e9, 0.27},
      diamond{"polycrystalline diamond", 3900, 900e9, 0.1};
  static const std::array<LeebDevice, 7> all{{{"D", 5.45e-3, 2.05, 1.5e-3, carbide},
                                              {"DC", 5.45e-3, 2.05, 1.5e-3, carbide},
                                              {"D+15", 7.75e-3, 1.70, 1.5e-3, carbide},
                                              {"S", 5.40e-3, 2.05, 1.5e-3, nitride},
                                              {"E", 5.45e-3, 2.05, 1.5e-3, diamond},
                                              {"C", 3.10e-3, 1.40, 1.5e-3, carbide},
                                              {"G", 20.0e-3, 3.00, 2.5e-3, carbide}}};
  return all;
}

/// 2 g h of the way between surface and coil, m^2/s^2.
constexpr double fall = 2 * 9.81 * 1e-3;

/// e at the surface, of the ratio of the speeds at the coil.
double at_surface(double ratio, double velocity)
{
  return std::sqrt(ratio * ratio * (velocity * velocity - fall) + fall) / velocity;
}

Estimate95 yield_shown(const Atlas& atlas, Measurement m, const CandidateMaterial& known)
{
  CalibrationRequest r;
  complete_standard_deviations(m, 0.01);
  r.measurements = {std::move(m)}, r.known = known, r.fit = {Parameter::yield_stress};
  CalibrationProblem problem(atlas, r);
  const Calibration c = calibrate(problem);
  if (!c.has_values()) fail(r.measurements.front().source, "no yield stress follows the reference block");
  const ParameterProfile& p = c.parameters.front().profile;
  return {p.value, p.within95.low, p.within95.high};
}

}  // namespace

const LeebDevice& leeb_device(const std::string& name, const std::string& where)
{
  std::vector<std::string> names;
  for (const LeebDevice& d : devices()) {
    if (d.name == name) return d;
    names.emplace_back(d.name);
  }
  if (name == "DL") fail(where, "the slender body of a DL device gives way: its rebound is not that of a mass", name, "D, DC, D+15, S, E, C, G");
  fail_unknown(where, "no impact device", name, names);
}

void make_drops(Measurement& m, const LeebDevice& device, double compliance)
{
  m.radius = device.radius;
  m.counterpart = device.ball, m.counterpart_is_ball = true;
  m.body = {device.mass, compliance};
  for (Datum& d : m.data) {
    const double e = at_surface(d.y, device.velocity);
    d.sd *= d.y / e;  // de/dL, but for the small fall
    d.x = device.velocity, d.y = e;
  }
}

Estimate95 usual_rate_factor(double compliance)
{
  if (compliance > 0) return {1.15, 1.0, 1.35};
  return {1.25, 1.05, 1.5};
}

Estimate95 rate_factor_of(const Atlas& atlas, Measurement drops, double leeb_hardness, double brinell_hardness,
                          const CandidateMaterial& known)
{
  const double velocity = drops.data.front().x;
  drops.source = "--reference";
  drops.data = {{.x = velocity, .y = at_surface(leeb_hardness / 1000, velocity)}};
  Measurement block;
  block.kind = &kind_named("Brinell hardness 30", "--reference"), block.source = "--reference";
  block.data = {{.y = brinell_hardness * kilogram_force}};
  block.kind->check_rows(block);
  return over(yield_shown(atlas, drops, known), yield_shown(atlas, block, known));
}

Estimate95 over(const Estimate95& a, const Estimate95& b)
{
  const double value = a.value / b.value, down = std::hypot(std::log(a.value / a.low), std::log(b.high / b.value)),
               up = std::hypot(std::log(a.high / a.value), std::log(b.value / b.low));
  return {value, value * std::exp(-down), value * std::exp(up)};
}

}  // namespace granulaw
