#include "calibrate/forward_model.hpp"

#include <algorithm>
#include <cmath>

#include "base/scales.hpp"
#include "calibrate/atlas_errors.hpp"

namespace granulaw {

namespace {

// One standard deviation of what the model of each kind is off, relative; those without a source here:
// forward_model.hpp.
constexpr double radius_error = 0.01, residual_error = 0.005, time_error = 0.01, hardness_error = 0.07,
                 onset_error = 0.02;

/// How far single values depart from the smooth error, over it: half of its variance.
const double rough_share = std::sqrt(0.5);

/// Legendre's polynomials of degree 0 to 2 at t from -1 to 1, each of mean square 1.
void legendre(double t, double out[3])
{
  t = std::clamp(t, -1.0, 1.0);
  out[0] = 1, out[1] = std::sqrt(3.0) * t, out[2] = std::sqrt(5.0) * 0.5 * (3 * t * t - 1);
}

/// Speed on a rigid wall that an impact is as: each of two like spheres sees a wall at half the speed of
/// approach.
double wall_speed(const Measurement& m, double velocity)
{
  return m.partner == ImpactPartner::like_sphere ? 0.5 * velocity : velocity;
}

double impact_value(const Measurement& m, const SphereLaws::Impact& impact, double velocity)
{
  const double like = m.partner == ImpactPartner::like_sphere ? 2 : 1;
  switch (m.kind) {
    case MeasurementKind::contact_radius:
      return impact.contact_radius * m.radius;
    case MeasurementKind::residual_displacement:
      return like * impact.residual * m.radius;
    case MeasurementKind::contact_time:
      return impact.contact_time * m.radius / wall_speed(m, velocity);
    default:
      return impact.restitution;
  }
}

void predict_impacts(const Measurement& m, const LawMaterial& material, const SphereLaws& laws, Prediction& p)
{
  const AtlasErrors atlas = errors_of(*laws.atlas(), laws.material().stiffness);
  const double density = m.sphere_density(material.density),
               per_speed = std::sqrt(density / material.yield_stress),
               slow = std::log(yield_velocity(material.e_star(), material.yield_stress, density));
  constexpr double decades = 6.9;  // ln 1000: of V/V_y, over which the errors were measured
  for (const Datum& d : m.data) {
    const double speed = wall_speed(m, d.x), v = speed * per_speed;
    p.beyond = std::max(p.beyond, std::log(v / SphereLaws::fastest));
    const SphereLaws::Impact impact = laws.impact(v);
    p.values.push_back(impact_value(m, impact, d.x));
    if (m.kind != MeasurementKind::restitution) {
      const double share = m.kind == MeasurementKind::contact_radius          ? radius_error
                           : m.kind == MeasurementKind::residual_displacement ? residual_error
                                                                              : time_error;
      const double base =
          m.kind == MeasurementKind::residual_displacement ? impact.overlap * m.radius : p.values.back();
      p.errors[0].push_back(share * base);
      p.scatter.push_back(0);
      continue;
    }
    // none where nothing yields
    const double e = impact.restitution,
                 error = std::min(std::hypot(atlas.restitution, atlas.solver * e), 1 - e);
    double shape[3];
    legendre(2 * (std::log(speed) - slow) / decades - 1, shape);
    for (int k = 0; k < 3; ++k) p.errors[k].push_back(error / std::sqrt(3.0) * shape[k]);
    p.scatter.push_back(rough_share * error);
  }
}

/// Unloading from `top` where the overlap is this share of the recovery, the largest overlap less the
/// residual, above the residual.
double unloading_force(const ContactCurve::Reversal& top, double share)
{
  return share > 0 ? top.force * top.shape.at(std::min(share, 1.0)).value : 0.0;
}

CurveModel curve_model(const Measurement& m, const LawMaterial& material, const SphereLaws& laws)
{
  const double unit = 4.0 / 3.0 * material.e_star() * m.radius * m.radius;
  const AtlasErrors atlas = errors_of(*laws.atlas(), laws.material().stiffness);
  if (m.kind == MeasurementKind::platens)
    return {&laws.midplane(), m.radius, unit, atlas.midplane_force, atlas.recovery};
  return {&laws.free(), m.radius, unit, atlas.force, atlas.recovery};
}

}  // namespace

Prediction predict_curve(const Measurement& m, const CurveModel& model, const MachineState& machine)
{
  Prediction p;
  p.errors.resize(model_errors_of(m.kind));
  const ContactCurve& curve = *model.curve;
  const auto overlap = [&](const Datum& d) {
    return (d.x - machine.offset - machine.compliance * d.y) / m.contacts() / model.length;
  };
  const std::size_t loading = m.loading_rows();
  double x_m = 0;
  for (const Datum& d : m.data) x_m = std::max(x_m, overlap(d));
  x_m += std::max(0.0, machine.beyond) / m.contacts() / model.length;
  const ContactCurve::Reversal top = curve.reversal(std::max(x_m, 1e-12));
  // The checks' errors are each one curve's: smooth. Unloading is off by a share of what it recovers, however
  // far the press went.
  const double factor_error = model.force_error, recovery_error = model.recovery_error,
               recovery = x_m - top.residual;
  constexpr double span = 4.6;  // ln 100: of the overlap, over which the errors were measured
  for (std::size_t k = 0; k < m.data.size(); ++k) {
    const double x = overlap(m.data[k]);
    const bool unloads = k >= loading && x_m > curve.onset();
    double force = 0, stretched = 0, steep = 0, place = 1;
    if (unloads) {
      const double share = (x - top.residual) / recovery;
      force = unloading_force(top, share);
      stretched = unloading_force(top, 1 - (1 - share) / (1 - recovery_error)) - force;
      steep =
          0.5 * (unloading_force(top, share + recovery_error) - unloading_force(top, share - recovery_error));
    } else if (x > 0) {
      force = curve.loading(x).force;
      place = 1 + 2 * std::log(x / x_m) / span;
    }
    p.values.push_back(model.force * force);
    double shape[3];
    legendre(place, shape);
    for (int j = 0; j < 3; ++j)
      p.errors[j].push_back(model.force * force * factor_error / std::sqrt(3.0) * shape[j]);
    p.errors[3].push_back(model.force * stretched);
    p.scatter.push_back(rough_share * model.force * std::hypot(force * factor_error, steep));
  }
  return p;
}

double hardness_of(const CandidateMaterial& m)
{
  constexpr double representative_strain = 0.08;  // of a pyramid
  const double tan_beta = std::tan((90 - 70.3) * M_PI / 180), nu = m.poisson_ratio;
  const double flow = m.yield_stress * m.flow(representative_strain);
  const double cavity =
      2.0 / 3.0 * (1 + std::log((m.youngs_modulus / flow * tan_beta + 4 * (1 - 2 * nu)) / (6 * (1 - nu))));
  return flow * std::clamp(cavity, 1.0, 3.0);
}

double onset_force(const LawMaterial& m, double radius)
{
  const double pressure = onset_pressure_ratio(m.poisson_ratio) * m.yield_stress;
  return std::pow(M_PI * pressure, 3) * radius * radius / (6 * m.e_star() * m.e_star());
}

std::size_t model_errors_of(MeasurementKind kind)
{
  return is_curve(kind) ? 4 : kind == MeasurementKind::restitution ? 3 : 1;
}

Prediction predict(const Measurement& m, const CandidateMaterial& material, const SphereLaws& laws,
                   const MachineState& machine)
{
  Prediction p;
  p.errors.resize(model_errors_of(m.kind));
  if (is_impact(m.kind)) {
    predict_impacts(m, material, laws, p);
    return p;
  }
  if (is_curve(m.kind)) return predict_curve(m, curve_model(m, material, laws), machine);
  const bool hardness = m.kind == MeasurementKind::hardness;
  const double value = hardness ? hardness_of(material) : onset_force(material, m.radius);
  p.values.assign(m.data.size(), value);
  p.errors[0].assign(m.data.size(), value * (hardness ? hardness_error : onset_error));
  p.scatter.assign(m.data.size(), 0.0);
  return p;
}

}  // namespace granulaw
