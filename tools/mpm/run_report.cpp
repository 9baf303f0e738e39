#include "run_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.hpp"
#include "base/scales.hpp"
#include "collision_report.hpp"
#include "json_output.hpp"
#include "run_files/field_file.hpp"
#include "run_files/trace_file.hpp"
#include "solver/run/axisymmetric_setup.hpp"
#include "solver/runs.hpp"
#include "solver/shape/shape.hpp"
#include "terminal.hpp"

namespace granulaw {

namespace {

void print_yield(const Material& m, double velocity, double damage_number)
{
  const double v_y = yield_velocity(m.e_star(), m.yield_stress, m.density);
  fmt::print(", E*/Y = {:.4g}, yield velocity V_y = {:.4g} m/s", m.e_star() / m.yield_stress, v_y);
  if (velocity > 0) fmt::print(", V/V_y = {:.4g}, I = rho V^2/Y = {:.3g}", velocity / v_y, damage_number);
}

nlohmann::ordered_json plane_json(const RunResult& result, std::size_t k)
{
  const PlaneTrace& plane = result.planes[k];
  double delta = 0, force = 0;
  for (const PlaneSample& p : plane.samples) delta = std::max(delta, p.delta), force = std::max(force, p.force);
  nlohmann::ordered_json out;
  out["normal"] = {-plane.normal[0], -plane.normal[1], -plane.normal[2]};  // from the body to the plane
  out["delta_max_m"] = delta;
  out["force_max_N"] = force;
  out["force_N_at_depth"] = force_at_depth(result, k);
  return out;
}

/// Adds the results of three-dimensional runs.
void put_three_dimensions(nlohmann::ordered_json& out, const RunResult& result, const CentreMotion& centre)
{
  if (result.rebound) {
    const Rebound& rebound = *result.rebound;
    out["e_tangential"] = json_number(rebound.tangential);
    out["velocity_ratio_normal"] = rebound.normal;
    out["velocity_after_normal_m_per_s"] = rebound.normal * centre.approach;
    out["velocity_after_tangential_m_per_s"] = centre.tangential_after;
    out["spin_after_rad_s"] = rebound.spin[1];
    out["spin_after_xyz_rad_s"] = rebound.spin;
    out["impulse_normal_Ns"] = rebound.impulse_normal;
    out["impulse_tangential_Ns"] = rebound.impulse_tangential;
    out["contacts"] = centre.contacts;
    return;
  }
  for (std::size_t k = 0; k < result.planes.size(); ++k) out["planes"].push_back(plane_json(result, k));
}

void print_three_dimensions(const RunResult& result, const CentreMotion& centre)
{
  if (result.rebound) {
    const Rebound& rebound = *result.rebound;
    fmt::print("centre after, normal           {:.5g} m/s, away from the wall ({:.4f} of its approach)\n", rebound.normal * centre.approach, rebound.normal);
    fmt::print("centre after, tangential       {:.5g} m/s, along +x (before: {:.5g})\n", centre.tangential_after, centre.tangential);
    fmt::print("spin after, about x, y, z      {:.5g}, {:.5g}, {:.5g} rad/s\n", rebound.spin[0], rebound.spin[1], rebound.spin[2]);
    if (centre.contacts > 1) fmt::print("contacts                       {}, of which e and the works are of the first\n", centre.contacts);
    fmt::print("impulse, normal, tangential    {:.5g} N s, {:.5g} N s\n", rebound.impulse_normal, rebound.impulse_tangential);
    return;
  }
  for (std::size_t k = 0; k < result.planes.size(); ++k)
    fmt::print("plane {:2} towards ({:.3g}, {:.3g}, {:.3g})  {:.5g} N at depth\n", k + 1, -result.planes[k].normal[0], -result.planes[k].normal[1],
        -result.planes[k].normal[2], force_at_depth(result, k));
}

const char* body_name(const Particle& particle)
{
  if (particle.shape) return particle.shape->kind();
  return particle.is_sphere() ? "sphere" : "body of revolution";
}

}  // namespace

void print_setting(const RunRequest& r, const Particle& particle, double velocity, double damage_number)
{
  if (r.json) return;
  const Material& m = particle.materials.front();
  fmt::print("{} of {:.4g} m radius, E* = {:.4g} Pa", body_name(particle), particle.radius, m.e_star());
  if (m.yields())
    print_yield(m, velocity, damage_number);
  else
    fmt::print(", elastic");
  if (r.grid == "auto") {
    fmt::print("\ngrid: {} ({})\n", grid_name(r, particle), choose_grid(particle).reason);
  } else {
    fmt::print("\ngrid: {}, as asked\n", r.grid);
  }
}

nlohmann::ordered_json run_json(const std::string& grid, const RunResult& result, const CentreMotion& centre, const Attraction& attraction)
{
  const RunSummary& s = result.summary;
  nlohmann::ordered_json out = collision_json(s);
  put_effort(out, s.points, s.steps, s.cpu_s, s.point_updates_per_s, s.error_estimate);
  out["grid"] = grid;
  out["resolution"] = s.resolution;
  out["grids"] = s.grids;
  for (const SummaryNumber& n : summary_numbers)
    if (!out.contains(n.key) && (attraction.work > 0 || (n.value != &RunSummary::adhesion_loss && n.value != &RunSummary::pull_off))) out[n.key] = s.*n.value;
  out["ripple"] = s.grid_noise;  // its old name
  put_three_dimensions(out, result, centre);
  return with_adhesion(std::move(out), s, attraction);
}

void report(const RunRequest& r, const Meeting& m, const RunResult& result, const CentreMotion& centre)
{
  if (!r.output.empty()) write_trace(result, r.output);
  const RunSummary& s = result.summary;
  if (r.json) return print_json(run_json(grid_name(r, m.particle), result, centre, m.partner.attraction));
  print_collision(s, fmt::format("{:.4g} R", s.delta_max / m.particle.radius));
  print_adhesion(s, m.partner.attraction);
  print_three_dimensions(result, centre);
  if (std::isinf(s.error_estimate))
    fmt::print("estimated error of F and e     not known: no coarser grid is another\n");
  else if (s.error_estimate > 0)
    fmt::print("estimated error of F and e     {:.2g}\n", s.error_estimate);
  if (s.points > 0) fmt::print("{} points, {} steps, {:.2f} CPU s, {:.1f} million point updates a second\n", s.points, s.steps, s.cpu_s, 1e-6 * s.point_updates_per_s);
  if (!r.output.empty()) fmt::print("wrote {}\n", r.output);
  if (!r.fields.empty()) fmt::print("wrote {}\n", r.fields);
}

namespace {

void print_not_reached(double tolerance, const ToleranceResult& found)
{
  fmt::print(stderr, "mpm: tolerance {:.2g} not reached: at {} cells the estimate is {:.2g} (resolution {:.2g}, time step {:.2g}, ramp {:.2g})\n", tolerance,
      found.result.summary.resolution, found.result.summary.error_estimate, found.resolution_error, found.step_error, found.ramp_error);
}

/// The cost of a tolerance before it is spent. Throws Error where the range of cells ends before.
void state_cost(double tolerance, const ToleranceForecast& f, const ToleranceRange& range)
{
  if (f.wanted_cells > range.last)
    fail("--tolerance",
        fmt::format("is out of reach: at {} cells the error estimate is {:.2g}, and {:g} takes about {} cells", f.cells, f.estimate, tolerance, f.wanted_cells),
        fmt::format("{:g}", tolerance), fmt::format("what {} cells reach; --resolution makes one run, mpm law needs none and states its error bound", range.last));
  constexpr double worth_a_line = 60;  // s
  if (f.cpu_s > worth_a_line)
    fmt::print(stderr, "mpm: at {} cells the error estimate is {:.2g}; {:g} takes about {} cells and {} of CPU\n", f.cells, f.estimate, tolerance, f.wanted_cells,
        duration_text(f.cpu_s));
}

/// Runs at the resolution asked for, or to the tolerance.
RunResult run_to_request(const RunRequest& r, const FieldObserver& fields, bool has_ramp, bool three_dimensions, const Run& run)
{
  ProgressBar bar;
  RunOptions options = r.options(three_dimensions);
  options.fields = fields;
  options.progress = [&](double done) { bar.update(done, ""); };
  if (!r.tolerance) return run(options);
  const ToleranceRange& range = three_dimensions ? spatial_range : flat_range;
  const ToleranceResult found = run_to_tolerance(*r.tolerance, has_ramp, options, run, range, [&](const ToleranceForecast& f) {
    bar.clear();
    state_cost(*r.tolerance, f, range);
  });
  if (!found.reached) print_not_reached(*r.tolerance, found);
  return found.result;
}

RunResult run_as_asked(const RunRequest& r, bool has_ramp, bool three_dimensions, const Run& run)
{
  if (r.fields.empty()) return run_to_request(r, {}, has_ramp, three_dimensions, run);
  return run_with_fields(r.fields, r.frames, [&](const FieldObserver& fields) { return run_to_request(r, fields, has_ramp, three_dimensions, run); });
}

/// With the request's options that matter to the trace and that RunOptions does not give.
RunIdentity identity(RunIdentity asked, const RunRequest& r, const Meeting& m, const RunOptions& options)
{
  asked.insert(asked.end(), {{"--grid", r.grid}, {"--precision", r.precision}, {"--resolution", fmt::format("{}", r.resolution.value_or(0))},
                                {"--tolerance", fmt::format("{}", r.tolerance.value_or(0))}, {"--no-estimate", r.no_estimate ? "yes" : "no"}});
  if (const Attraction& a = m.partner.attraction; a.work > 0)
    asked.insert(asked.end(), {{"--work-of-adhesion", fmt::format("{}", a.work)}, {"--adhesion-range", fmt::format("{}", a.range)}});
  return identity_of(std::move(asked), m.particle, m.partner, options);
}

}  // namespace

void run_and_report(const RunRequest& r, const Meeting& m, const RunIdentity& asked, bool has_ramp, const Run& run, const CentreMotion& centre)
{
  std::optional<CheckpointFile> checkpoint;
  const auto run_on = [&](RunOptions options) {
    if (!checkpoint && !r.checkpoint.empty()) {
      checkpoint.emplace(r.checkpoint, r.checkpoint_every, identity(asked, r, m, options), is_interrupted);
      if (checkpoint->was_found() && !r.json) fmt::print("goes on from {}\n", r.checkpoint);
    }
    if (checkpoint) options.checkpoints = checkpoint->store();
    return run(options);
  };
  report(r, m, run_as_asked(r, has_ramp, in_three_dimensions(r, m.particle), run_on), centre);
  if (checkpoint) checkpoint->remove();
}

}  // namespace granulaw
