#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "atlas/law_range.hpp"
#include "characterise/body/characterised_body.hpp"
#include "characterise/record/contact_record.hpp"
#include "law/law_shape.hpp"
#include "farm/run_queue.hpp"

namespace granulaw {

/// Source of the runs: the solver, or a test's own model.
struct RunSource
{
  std::function<RunResult(const Particle&, const PressPlan&, const RunOptions&)> press =
      [](const Particle& p, const PressPlan& plan, const RunOptions& o) {
        return granulaw::press(p, plan, {}, o);
      };
  std::function<RunResult(const Particle&, double, const RunOptions&)> impact =
      [](const Particle& p, double velocity, const RunOptions& o) {
        return granulaw::impact(p, {velocity}, {}, o);
      };
};

/// sqrt(I) from which on the force at an impact's reversal swings with the body and with the cells: with 24
/// it is up to 0.9 % off that of 48, with 36 to 0.3 % (E*/Y 60 to 150, nu = 0.3). Such impacts are the cheap
/// ones.
inline constexpr double ringing = 0.1;

/// Which runs make a law. Lengths over the body's scale, velocities over sqrt(E*/rho).
///
/// Slow presses, each with partial unloadings on its way, cover a factor of four in overlap each: a grid made
/// for the deepest contact still resolves one of half its radius. Below the first press slow impacts take
/// their place (they cost less there, and their inertia is nothing). Fast impacts show what inertia changes.
struct SamplingPlan
{
  struct Press
  {
    double depth = 0;
    std::vector<double> stops;  ///< overlaps of partial unloadings, ascending, below depth
    int resolution = 24, shifted_grids = 2;
    double ramp = 0;  ///< loading time, in R/c*; 0: as the solver chooses it
    Support support = Support::free;
  };
  std::vector<Press> presses;
  std::vector<double> slow_impacts;        ///< velocities whose inertia does not count
  std::vector<double> fast_speeds;         ///< sqrt(I), I = rho V^2/Y
  int resolution = 24, shifted_grids = 2;  ///< of the impacts; fast ones: fast_shifted_grids
  int ringing_resolution = 0;              ///< of impacts from `ringing` on, where it is more than that

  int cells_at(double speed) const
  {
    return speed >= ringing ? std::max(resolution, ringing_resolution) : resolution;
  }
  std::size_t runs() const { return presses.size() + slow_impacts.size() + fast_speeds.size(); }
};

/// Shifted grids of a fast impact, which takes tenths of a second: what it loses more than a slow press is a
/// per cent of the loss, as is the contact-edge grid noise of two grids.
inline constexpr int fast_shifted_grids = 4;

/// Overlap/onset nearer to the onset than which nothing is run.
inline constexpr double nearest_to_onset = 1.25;

/// The runs of a material of the atlas: three reversal points a press, slow impacts below the presses from
/// 2e-4 R on, and fast ones at all impact_speeds.
SamplingPlan plan_sampling(const CharacterisedBody& body);

/// sqrt(I) up to which a slow run may be an impact. With a guide its inertia is the guide's (without_inertia());
/// else it changes F by .3 %, e by .002 at most (the atlas's effects).
inline constexpr double slow_with_guide = 0.06, slow_without = 0.02;

/// Slow runs to these ascending overlaps: impacts up to the speed `slow`, sqrt(I), which cost less than presses; and
/// presses, of which one serves every overlap from a quarter of its depth on.
SamplingPlan slow_runs_to(std::span<const double> overlaps, const CharacterisedBody& body, double tolerance,
                          int press_cells, double slow);

/// Overlap of the shallowest first run with a guide: an impact to 2e-4 R costs twice as much, and shows no more.
inline constexpr double shallowest_with_guide = 5e-4;

/// The overlaps of the first slow runs of a law to `depth`, ascending. With a guide: by factors of four at most, from
/// three onsets on, at which a departure is a sixth of what it is at ten. Without one: by factors of
/// 2.5, from two onsets on, up to which a fit that leaves the onset with zero slope follows the law.
std::vector<double> first_overlaps(double onset, double depth, bool guided);

/// sqrt(I) of the first fast impacts, ascending. Leaving one out must leave what interpolates there
/// (refinement.hpp).
/// - Inertia, which is even in the speed: the fastest, half and a quarter of it, as far as inertia counts
///   (negligible_damage_number). Two of them and the standstill give a polynomial of fourth degree.
/// - A rate, which goes by the logarithm of the speed: five at equal factors, as the interpolation is cubic.
std::vector<double> first_inertia_speeds(double fastest, double tolerance);
std::vector<double> first_rate_speeds(double slowest, double fastest);

/// Loading time of a slow press, in R/c*, that a tolerance of F and e allows; 0, the solver's own: of a body
/// that never yields, or where no tolerance is asked for. A ramp adds to F and e
/// - its inertia, negligible up to a damage number at the highest speed of loading;
/// - the body's vibration at the reversal, which falls as the fifth power of the ramp (docs/develop/notes.md).
/// A tolerance over 1 % counts as 1 %.
double loading_ramp(const CharacterisedBody& body, double depth, double tolerance);

/// A slow impact that reaches about this overlap.
double velocity_to(double overlap, const CharacterisedBody& body);

/// The plan's runs, in the order: presses, slow impacts, fast impacts. Results are dimensionless. `source`
/// outlives them.
std::vector<RunJob> sampling_jobs(const CharacterisedBody& body, const SamplingPlan& plan,
                                  const RunSource& source);
RunJob press_job(const CharacterisedBody& body, const SamplingPlan::Press& press, const RunSource& source);
RunJob impact_job(const CharacterisedBody& body, double velocity, int resolution, int shifted_grids,
                  const RunSource& source);

/// The same run with its error estimated by a second resolution.
RunJob with_estimate(RunJob job);

/// Adds what the runs of a plan found; a failed run adds nothing.
void add_to(ContactRecords& records, const CharacterisedBody& body, const SamplingPlan& plan, const std::vector<RunOutcome>& outcomes);

/// Overlap that an impact is expected to reach: Hertz's, or that of a mean pressure of 2.8 Y over the area
/// 2 pi R delta, whichever is deeper. Only costs and the choice of runs depend on it.
double expected_depth(double velocity, const CharacterisedBody& body);

}  // namespace granulaw
