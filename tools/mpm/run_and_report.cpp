
#include <fmt/format.h>

#include <optional>

#include "base/error.hpp"
#include "run_files/field_file.hpp"
#include "run_report.hpp"
#include "terminal.hpp"

namespace granulaw {

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
  report(r, m.particle, run_as_asked(r, has_ramp, in_three_dimensions(r, m.particle), run_on), centre);
  if (checkpoint) checkpoint->remove();
}

}  // namespace granulaw
