// Impacts of a sphere on a wall, or on its like.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "base/error.hpp"
#include "base/scales.hpp"
#include "calibrate/kind/composed.hpp"
#include "calibrate/kind/kind.hpp"
#include "calibrate/misfit.hpp"

namespace granulaw {

namespace {

constexpr double elastic = 0.9995;  // e from which on nothing yields

/// Calls use(speed on a rigid wall, impact) for each datum.
template <class Use>
void for_each_impact(const Measurement& m, const Trial& t, Prediction& p, Use use)
{
  const double per_speed = std::sqrt(m.sphere_density(t.material.density) / t.material.yield_stress);
  for (const Datum& d : m.data) {
    const double speed = m.wall_share() * d.x, v = speed * per_speed;
    p.beyond = std::max(p.beyond, std::log(v / SphereLaws::fastest));
    use(speed, t.laws.impact(v));
  }
}

Prediction predict_restitution(const Measurement& m, const Trial& t)
{
  Prediction p;
  p.errors.resize(m.kind->smooth_errors);
  const AtlasErrors& atlas = t.laws.errors();
  const double slow = std::log(
      yield_velocity(t.material.e_star(), t.material.yield_stress, m.sphere_density(t.material.density)));
  constexpr double decades = 6.9;  // ln 1000: of V/V_y, over which the errors were measured
  constexpr double length = 0.45;  // of ln V: as of curves, a sixteenth of that
  for_each_impact(m, t, p, [&](double speed, const SphereLaws::Impact& impact) {
    // none where nothing yields
    const double e = impact.restitution,
                 error = std::min(std::hypot(atlas.restitution, atlas.solver * e), 1 - e);
    double shape[3];
    legendre(2 * (std::log(speed) - slow) / decades - 1, shape);
    for (std::size_t k = 0; k < 3; ++k) p.errors[k].push_back(error / std::sqrt(3.0) * shape[k]);
    p.values.push_back(e);
    p.scatter.push_back(rough_share * error);
    p.place.push_back(std::log(speed) / length);
  });
  if (!t.composed) return p;
  const std::vector<double> change = t.composed->change(t.material);
  const double error = t.composed->error(t.material).restitution;
  for (std::size_t i = 0; i < p.values.size(); ++i) {
    p.values[i] = std::clamp(p.values[i] + change[i], 1e-3, 1.0);
    p.errors[0][i] = std::hypot(p.errors[0][i], error);
  }
  return p;
}

/// A value, and one standard deviation of what the model is off.
struct Shown
{
  double value, error;
};
/// Prediction of values whose error is one smooth share of them.
template <Shown (*show)(const Measurement&, const SphereLaws::Impact&, double speed)>
Prediction predict_each(const Measurement& m, const Trial& t)
{
  Prediction p;
  p.errors.resize(1);
  for_each_impact(m, t, p, [&](double speed, const SphereLaws::Impact& impact) {
    const Shown shown = show(m, impact, speed);
    p.values.push_back(shown.value), p.errors[0].push_back(shown.error), p.scatter.push_back(0);
  });
  return p;
}

Shown radius_of(const Measurement& m, const SphereLaws::Impact& impact, double)
{
  const double radius = impact.contact_radius * m.radius;
  return {radius, 0.01 * radius};
}

Shown residual_of(const Measurement& m, const SphereLaws::Impact& impact, double)
{
  const double spheres = m.partner == ImpactPartner::like_sphere ? 2 : 1;
  return {spheres * impact.residual * m.radius, 0.005 * (impact.overlap * m.radius)};
}

Shown time_of(const Measurement& m, const SphereLaws::Impact& impact, double speed)
{
  const double time = impact.contact_time * m.radius / speed;
  return {time, 0.01 * time};
}

Reach impact_reach(const Measurement& m, const Trial& t)
{
  Reach r;
  const double e_star = t.material.e_star(), density = m.sphere_density(t.material.density);
  const double both = m.counterpart_is_ball ? 1 / (1 / e_star + 1 / m.counterpart->e_star()) : e_star;
  const double slow = yield_velocity(both, t.material.yield_stress, density),
               per_speed = std::sqrt(density / t.material.yield_stress);
  for (const Datum& d : m.data) {
    r.slowest = std::min(r.slowest, m.wall_share() * d.x / slow);
    r.fastest = std::max(r.fastest, m.wall_share() * d.x / slow);
    r.overlap = std::max(r.overlap, t.laws.impact(m.wall_share() * d.x * per_speed).overlap);
  }
  return r;
}

void impact_starts(const Measurement& m, const LawMaterial& known, std::vector<double>& likely)
{
  const double fastest = m.largest_x();
  for (const double v : {0.28, 0.14, 0.07, 0.035, 0.017, 0.008, 0.004, 0.002, 0.001})
    likely.push_back(m.sphere_density(known.density) * fastest * fastest / (v * v));
}

/// Impacts faster than the atlas goes for the hardest material of this modulus, or of this yield stress.
void check_speeds(const Measurement& m, const CalibrationRequest& r, const Atlas& atlas)
{
  const bool fits_yield = r.fits(Parameter::yield_stress);
  if (fits_yield && r.fits(Parameter::youngs_modulus)) return;
  const double least_stiffness = atlas.grid().stiffnesses.front();
  const double hardest = fits_yield ? r.known.e_star() / least_stiffness : r.known.yield_stress;
  const double fastest =
      SphereLaws::fastest * std::sqrt(hardest / m.sphere_density(r.known.density)) / m.wall_share();
  constexpr double some_noise = 1.02;
  for (const Datum& d : m.data)
    if (d.x > some_noise * fastest)
      fail(fmt::format("{}:{}", m.source, d.line),
           "the impact is faster than the method goes for any material of this " +
               std::string(fits_yield ? "youngs_modulus" : "yield_stress"),
           fmt::format("{:g} m/s", d.x),
           fmt::format("up to {:.3g} m/s, where rho V^2/Y is {:g}{}: is a value in another unit than SI?",
                       fastest, SphereLaws::fastest * SphereLaws::fastest,
                       fits_yield ? fmt::format(" and E*/Y {:g}", least_stiffness) : ""));
}

/// Standard deviations by which e rises with ln V over some drops, in order of the speed: of those stated, or
/// of the scatter about the line where that is more.
double rise_of(std::span<const Datum> drops)
{
  double weights = 0, x = 0, y = 0;
  const auto weight = [](const Datum& d) { return 1 / (d.sd * d.sd); };
  for (const Datum& d : drops) weights += weight(d), x += weight(d) * std::log(d.x), y += weight(d) * d.y;
  x /= weights, y /= weights;
  double xx = 0, xy = 0, yy = 0;
  for (const Datum& d : drops) {
    const double dx = std::log(d.x) - x, dy = d.y - y;
    xx += weight(d) * dx * dx, xy += weight(d) * dx * dy, yy += weight(d) * dy * dy;
  }
  if (!(xx > 0)) return 0;
  const double left = std::max(0.0, yy - xy * xy / xx) / static_cast<double>(drops.size() - 2);
  return xy / std::sqrt(xx) / std::sqrt(std::max(1.0, left));
}

/// The drops, slowest first, over which e rises clearest, from the slowest or to the fastest; none: nowhere.
std::vector<Datum> rising_drops(const Inspection& i)
{
  constexpr std::size_t fewest = 4;
  std::vector<Datum> all = i.measurement.data;
  std::sort(all.begin(), all.end(), [](const Datum& a, const Datum& b) { return a.x < b.x; });
  std::span<const Datum> clearest;
  double most = clear_by_stated;
  for (std::size_t count = fewest; count <= all.size(); ++count)
    for (const std::span<const Datum> drops : {std::span(all).first(count), std::span(all).last(count)})
      if (const double rise = rise_of(drops);
          rise > most && drops.back().y - drops.front().y > clear_by_stated * i.model_error())
        most = rise, clearest = drops;
  return {clearest.begin(), clearest.end()};
}

/// e against the logarithm of the speed.
void inspect_restitution(Inspection& i)
{
  constexpr double clear = 4;  // standard deviations
  Differences d;
  double slowest = 1e300, fastest = 0, least = 1;
  for (const Datum& datum : i.measurement.data)
    slowest = std::min(slowest, datum.x), fastest = std::max(fastest, datum.x);
  const double range = std::log(fastest / slowest);
  std::string loss;
  for (std::size_t k = 0; k < i.measurement.data.size(); ++k) {
    const Datum& datum = i.measurement.data[k];
    const double predicted = i.comparison.predicted[k];
    if (predicted > elastic && datum.y < 1 - clear * i.comparison.sd[k])
      loss = fmt::format("{:.4g} at {:.4g} m/s", datum.y, datum.x);
    i.add_to(d, k, range > 0 ? 2 * std::log(datum.x / slowest) / range - 1 : 0.0);
    least = std::min(least, predicted);
  }
  if (!loss.empty())
    i.say(
        "elastic loss",
        fmt::format("e is below 1 at speeds that do not yield ({}): adhesion, waves in the wall or roughness "
                    "take energy, not plasticity",
                    loss));
  if (d.place.size() < 4 || range < 0.3) return;
  if (const std::vector<Datum> rising = rising_drops(i); !rising.empty()) {
    const Datum &slow = rising.front(), &fast = rising.back();
    return i.say(
        "rises",
        fmt::format("e rises with the speed, from {:.3g} at {:.3g} m/s to {:.3g} at {:.3g} m/s; that of a "
                    "material of this law falls: adhesion, waves in the wall, or an error of the "
                    "measurement",
                    slow.y, slow.x, fast.y, fast.x));
  }
  const Factors f = legendre_factors(d);
  const double model = i.model_error() / least;
  const bool trend = f.seen(1, model);
  if (trend && f.value[1] < 0)
    i.say("falls faster",
          fmt::format(
              "e falls faster with the speed than any J2 material's ({:+.1f} % against the fit from the "
              "slowest to the fastest): damage, adhesion or waves; or what is held fixed is wrong",
              200 * f.value[1]));
  if (trend && f.value[1] > 0)
    i.say(
        "falls slower",
        fmt::format("e falls slower with the speed than the fit ({:+.1f} % from the slowest to the fastest): "
                    "the material is stronger at fast impacts, as one that depends on the rate, or hardens "
                    "more than the fit may",
                    200 * f.value[1]));
  if (!trend && f.seen(2, model))
    i.say("bends",
          fmt::format("e bends {} against the logarithm of the speed than the fit: another flow law, or two "
                      "mechanisms of loss",
                      f.value[2] > 0 ? "less" : "more"));
}

constexpr Kind impacts(Kind k)
{
  k.x = {.quantity = "velocity", .unit = "m_per_s", .allowed = "over 0 m/s"};
  k.needs_density = true;
  k.reach = impact_reach, k.starts = impact_starts, k.check_request = check_speeds;
  return k;
}

}  // namespace

extern const Kind restitution_kind =
    impacts({.name = "restitution",
             .help = "drops on a wall",
             .y = {.quantity = "restitution", .most = 1},
             .counterpart = Kind::Counterpart::wall,
             .shows = Kind::Shows::fast,
             .smooth_errors = 3,
             .predict = predict_restitution,
             .tells_strength = [](const Measurement&, std::size_t,
                                  double predicted) { return !(predicted > elastic); },
             .model_error = [](const AtlasErrors& e) { return std::hypot(e.restitution, e.solver); },
             .inspect = inspect_restitution});
extern const Kind contact_radius_kind = impacts({.name = "contact radius",
                                                 .help = "radius of the flattened area after an impact",
                                                 .y = {.quantity = "contact_radius", .unit = "m"},
                                                 .predict = predict_each<radius_of>});
extern const Kind residual_displacement_kind =
    impacts({.name = "residual displacement",
             .help = "the part of the approach that stays after an impact",
             .y = {.quantity = "residual_displacement", .unit = "m"},
             .predict = predict_each<residual_of>});
extern const Kind contact_time_kind = impacts({.name = "contact time",
                                               .help = "from first touch until the force ends",
                                               .y = {.quantity = "contact_time", .unit = "s"},
                                               .predict = predict_each<time_of>});

}  // namespace granulaw
