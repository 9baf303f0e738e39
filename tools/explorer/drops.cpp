#include "base/error.hpp"
#include "calibrate/calibrate.hpp"
#include "calibrate/measurement_file.hpp"
#include "calibration_output.hpp"
#include "request.hpp"

namespace granulaw {

namespace {

const char* const source = "drops.csv";  // leads sentences

/// The bodies of the drops that `mpm calibrate` has options for: --partner like, --wall NAME.
void set_partner(Measurement& m, const Request& r)
{
  m.radius = r.radius;
  const bool own_wall = r.partner == Request::Partner::thick_wall && r.one_material;
  if (r.partner == Request::Partner::sphere || own_wall)
    fail(source, "one body is fitted", own_wall ? "a wall of the sphere's own material" : "two spheres that differ",
        "a rigid wall, its like, or a deformable wall of a known material");
  if (r.partner == Request::Partner::like) m.partner = ImpactPartner::like_sphere;
  if (r.partner == Request::Partner::thick_wall) m.counterpart = r.second;
}

}  // namespace

Json drops_json(const Atlas& atlas, const Json& json)
{
  Json state = json;
  if (state.contains("material")) state["material"]["yield_stress"] = nullptr;
  state["speed"] = 1.0;
  const Request r = request_of(state);

  Measurement m = parse_measurement(json.value("data", ""), source);
  if (m.kind != kinds().front()) fail(source, "only restitution is fitted here; mpm calibrate takes all kinds (docs/guide/calibrate.md)");
  set_partner(m, r);
  complete_standard_deviations(m, number_or(json, "relative_sd", source, 0.01));

  CalibrationRequest request;
  request.fit = {Parameter::yield_stress};
  request.known = r.first;
  request.known.yield_stress = 0;
  request.known.hardening_modulus = number_or(json.at("material"), "hardening_modulus", source, 0);
  request.measurements = {m};
  const CalibrationProblem problem(atlas, request);
  return calibration_json(problem, calibrate(problem));
}

}  // namespace granulaw
