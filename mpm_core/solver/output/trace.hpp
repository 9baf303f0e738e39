#pragma once

#include <array>
#include <bit>
#include <optional>
#include <utility>
#include <vector>

#include "base/scales.hpp"

namespace granulaw {

/// Which way the loading programme goes at a sample.
enum class Branch { load, unload, reload };

/// One line of a force history. Contact with the rigid plane, SI.
struct TraceSample
{
  double time;            ///< s since first touch
  double delta;           ///< m: displacement of the centre of mass (midplane support: of the equator plane)
                          ///< towards the wall since first touch
  double force;           ///< N, mean over the sample's interval, repulsive positive, as computed (raw)
  double contact_radius;  ///< m, radius of the outermost surface point in contact, interpolated to the edge
  Branch branch;
  int segment;  ///< 0, 1, 2, ...: counts up at every reversal of the loading programme
};

/// Results of one run. With a single grid force and works are the treated ones (contact-edge grid noise
/// removed by a fit, grid_noise.hpp), the raw ones stand in the trace; with more they are those of the mean
/// trace, but for the force of a press, which is always treated.
struct RunSummary
{
  double restitution = 0;         ///< impact: |v after|/V; press: sqrt(work_unload/work_load)
  double restitution_raw = 0;     ///< the same without the grid noise treatment
  double restitution_spread = 0;  ///< largest deviation of a single shifted grid's e from their mean
  double force_max = 0;           ///< N; impact on several grids: of the trace, smoothed; else treated
  double delta_max = 0;           ///< m
  double delta_residual = 0;      ///< m, delta at which the force has ended for good
  double contact_time = 0;        ///< s
  double work_load = 0;           ///< J
  double work_unload = 0;         ///< J
  int resolution = 0;             ///< cells across the contact block, of the grid as made
  int grids = 1;                  ///< shifted grids whose mean this is
  long points = 0;                ///< material points of one grid, their mean
  long steps = 0;
  double cpu_s = 0;
  double point_updates_per_s = 0;
  double error_estimate =
      0;  ///< relative, of force and e, the larger; from two resolutions; 0: not estimated
  double plastic_strain_max = 0;  ///< largest equivalent plastic strain of any material point at the end
  double energy_error = 0;  ///< |kinetic + elastic + plastic + contact_loss + adhesion_loss - put in|/put in, at the end
  double contact_loss = 0;  ///< share of the energy put in that was lost in the contact (contact.hpp)
  double adhesion_loss = 0;  ///< share of it that attraction between the surfaces took and did not give back
  double pull_off = 0;       ///< N, largest pull; 0: none
  bool sticks = false;       ///< an impact after which attraction holds the body: e is 0
  double hourglass = 0;     ///< share of it that the hourglass control holds at the end, part of the elastic
  double grid_noise = 0;  ///< rms of raw F/treated F - 1 over 0.25 to 1 delta_max, what the treatment removed
};

/// Unit of a number. Over its unit it is the solver's.
enum class Unit { one, length, time, force, energy, rate, impulse };
double size_of(Unit unit, const Scales& scales);

inline constexpr std::array<std::pair<double TraceSample::*, Unit>, 4> trace_numbers{
    {{&TraceSample::time, Unit::time},
     {&TraceSample::delta, Unit::length},
     {&TraceSample::force, Unit::force},
     {&TraceSample::contact_radius, Unit::length}}};

/// Rule by which runs on shifted grids make one number; `none`: it comes from their mean trace.
enum class Combine { none, mean, sum, largest };

/// A number of the summary: means over grids, units and --json follow this table.
struct SummaryNumber
{
  double RunSummary::*value;
  Combine combine;
  Unit unit;
  const char* key;  ///< of --json
};
inline constexpr std::array<SummaryNumber, 16> summary_numbers{{
    {&RunSummary::restitution, Combine::none, Unit::one, "e"},
    {&RunSummary::force_max, Combine::none, Unit::force, "force_max_N"},
    {&RunSummary::delta_max, Combine::mean, Unit::length, "delta_max_m"},
    {&RunSummary::delta_residual, Combine::mean, Unit::length, "delta_residual_m"},
    {&RunSummary::contact_time, Combine::mean, Unit::time, "contact_time_s"},
    {&RunSummary::work_load, Combine::mean, Unit::energy, "work_load_J"},
    {&RunSummary::work_unload, Combine::mean, Unit::energy, "work_unload_J"},
    {&RunSummary::cpu_s, Combine::sum, Unit::one, "cpu_s"},
    {&RunSummary::energy_error, Combine::largest, Unit::one, "energy_error"},
    {&RunSummary::grid_noise, Combine::none, Unit::one, "grid_noise"},
    {&RunSummary::restitution_raw, Combine::mean, Unit::one, "e_raw"},
    {&RunSummary::plastic_strain_max, Combine::largest, Unit::one, "plastic_strain_max"},
    {&RunSummary::contact_loss, Combine::largest, Unit::one, "contact_loss"},
    {&RunSummary::hourglass, Combine::largest, Unit::one, "hourglass"},
    {&RunSummary::adhesion_loss, Combine::mean, Unit::one, "adhesion_loss"},
    {&RunSummary::pull_off, Combine::mean, Unit::force, "pull_off_N"},
}};

/// Values of one plane at a sample of the trace; three-dimensional runs, SI.
struct PlaneSample
{
  double delta;  ///< m, way of the plane into the body's first place; of an impact its overlap
  double force;  ///< N, normal
  std::array<double, 3> vector;  ///< N, force on the body
  std::array<double, 3> torque;  ///< N m, of it about the body's centre of mass
  std::array<double, 3> centre;  ///< m, where the normal force acts, from that centre
  std::array<double, 2> axes;    ///< m, half axes of the contact, larger first
};

/// Units of its numbers, in their order.
inline constexpr std::array plane_units{Unit::length, Unit::force,  Unit::force,  Unit::force,  Unit::force,
                                        Unit::energy, Unit::energy, Unit::energy, Unit::length, Unit::length,
                                        Unit::length, Unit::length, Unit::length};

/// One plane of a three-dimensional run.
struct PlaneTrace
{
  std::array<double, 3> normal{};    ///< away from the plane
  std::vector<PlaneSample> samples;  ///< one for each sample of the trace
};

/// Motion of a body that leaves a plane, or relative to the body that it leaves; three-dimensional impacts, SI.
struct Rebound
{
  double normal = 0;              ///< restitution of the centre's normal velocity
  double tangential = 0;          ///< of its tangential velocity; not a number without one before
  std::array<double, 3> spin{};   ///< rad/s after, angular momentum over the tensor of inertia
  std::array<double, 3> partner_spin{};  ///< of the second body
  double impulse_normal = 0;      ///< N s
  double impulse_tangential = 0;  ///< N s, on the body, positive against the tangential velocity or spin
};

inline constexpr std::array rebound_units{Unit::one,  Unit::one,  Unit::rate, Unit::rate,    Unit::rate,
                                          Unit::rate, Unit::rate, Unit::rate, Unit::impulse, Unit::impulse};

/// The numbers of a struct that holds nothing else, such as PlaneSample, and the struct of numbers.
template <class Struct>
auto numbers_of(const Struct& of)
{
  return std::bit_cast<std::array<double, sizeof(Struct) / sizeof(double)>>(of);
}

struct RunResult
{
  std::vector<TraceSample> trace;
  RunSummary summary;
  /// m, by the particle's materials, where RunOptions::yield_stresses requires it: overlap at which the von
  /// Mises stress first reaches the yield stress during the loading; infinity: it does not.
  std::vector<double> yield_overlaps;
  std::vector<PlaneTrace> planes;  ///< of three-dimensional runs
  std::optional<Rebound> rebound;  ///< of three-dimensional impacts
};

/// A run whose numbers are over these scales, in SI.
RunResult in_si(RunResult run, const Scales& scale);
/// A run in SI, its numbers over these scales.
RunResult dimensionless(RunResult run, const Scales& scale);

}  // namespace granulaw
