#include "solver/run/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "base/error.hpp"
#include "base/state_archive.hpp"

namespace granulaw {

namespace {

/// Steps between looks at the stability limit of the deformed grid: often enough that no cell changes much.
constexpr int limit_interval = 8;

double cpu_seconds()
{
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double total(const Scene& scene, double (Body::*energy)() const)
{
  double sum = 0;
  for (const Body& body : scene.bodies) sum += (body.*energy)();
  return sum;
}

std::vector<double> in_units_of(double unit, std::vector<double> values)
{
  for (double& value : values) value /= unit;
  return values;
}

}  // namespace

Simulation::Simulation(Scene s, const RunOptions& options, double expected, double stress)
    : scene(std::move(s)),
      yield_watch_(in_units_of(stress, options.yield_stresses)),
      courant_(options.courant),
      window_(expected / options.samples),
      longest_(60 * expected)
{
  for (Body& body : scene.bodies) stable_.emplace_back(body);
  // Samples of one or two steps would swing with every node that closes.
  while (window_ < 3 * courant_ * step_limit()) window_ *= 2;
  window_end_ = window_;
}

double Simulation::step_limit() const
{
  double limit = stable_.front().limit(scene.bodies.front());
  for (std::size_t b = 1; b < scene.bodies.size(); ++b)
    limit = std::min(limit, stable_[b].limit(scene.bodies[b]));
  return limit;
}

void Simulation::run(Programme& programme, FieldRecorder fields, const std::function<void(double)>& progress,
                     const CheckpointSlot& checkpoint)
{
  energy_start = total(scene, &Body::kinetic_energy);
  fields.begin(scene.bodies);
  dt_ = last_dt_ = courant_ * step_limit();
  overlap_ = programme.overlap(scene);
  const auto visit = [&](StateArchive& archive) { visit_state(programme, archive); };
  checkpoint.resume(visit);
  const double cpu = cpu_seconds() - cpu_s_;
  while (!programme.finished()) {
    const bool sampled = step(programme);
    if (sampled) {
      programme.observe(result.trace.back());
      if (result.trace.back().branch == Branch::load) yield_watch_.sample(scene.bodies.front(), overlap_);
      fields.sample(scene.bodies, time_, overlap_, result.trace.back().force, programme.finished());
    }
    if (steps_ % limit_interval == 0) dt_ = courant_ * step_limit();
    if (!sampled) continue;
    if (!programme.finished() && checkpoint.due()) {  // after the last step the result is kept instead
      cpu_s_ = cpu_seconds() - cpu;
      checkpoint.save(visit);
    }
    if (progress && result.trace.size() % 16 == 0) progress(programme.progress());
  }
  if (progress) progress(1.0);
  result.summary.cpu_s = cpu_seconds() - cpu;
  summarise(programme);
}

/// One step; true if it ends a sample.
bool Simulation::step(Programme& programme)
{
  const double overlap_before = overlap_;
  const Branch branch = programme.branch();
  const int segment = programme.segment();
  const double push = advance(scene, programme, time_, 0.5 * (last_dt_ + dt_), dt_);
  last_dt_ = dt_;
  overlap_ = programme.overlap(scene);
  impulse_ += push;
  overlap_sum_ += overlap_before;
  ++in_window_;
  ++steps_;
  time_ += dt_;
  if (push != 0) last_touch_time_ = time_, last_touch_overlap_ = overlap_;
  const bool turned = programme.segment() != segment || programme.finished();
  if (!turned && time_ < window_end_) return false;
  // at equal times since the reversal, whatever the step: samples of shifted grids are averaged one by one
  window_end_ = std::max(time_, (turned ? time_ : window_end_) + window_);
  end_sample(branch, segment, overlap_before, energy_start + programme.work());
  return true;
}

void Simulation::end_sample(Branch branch, int segment, double overlap_before, double put_in)
{
  const double length = time_ - window_start_;
  // overlaps are taken at the start of each step: shift the mean by half a step's travel
  const double overlap = overlap_sum_ / in_window_ + 0.5 * (overlap_ - overlap_before);
  const double force = impulse_ / length;
  if (!std::isfinite(overlap) || !std::isfinite(force))
    fail("solver", fmt::format("the run became unstable at t = {:.4g} R/c*; lower the Courant number "
                               "or raise the resolution",
                               time_));
  if (time_ > longest_) fail("solver", fmt::format("the contact had not ended after {:.4g} R/c*", time_));
  result.trace.push_back({window_start_ + 0.5 * length, overlap, force,
                          scene.contact->edge_radius(scene.bodies), branch, segment});
  scene.contact->end_sample(scene.bodies, length, result.planes);
  most_put_in_ = std::max(most_put_in_, std::abs(put_in));
  window_start_ = time_;
  impulse_ = overlap_sum_ = 0;
  in_window_ = 0;
}

void Simulation::visit_state(Programme& programme, StateArchive& a)
{
  a.value(time_), a.value(dt_), a.value(last_dt_), a.value(overlap_), a.value(steps_), a.value(cpu_s_);
  a.value(last_touch_time_), a.value(last_touch_overlap_);
  a.value(impulse_), a.value(overlap_sum_), a.value(window_start_), a.value(window_end_);
  a.value(in_window_), a.value(most_put_in_);
  a.growing(result.trace);
  visit_planes(a, result.planes);
  for (Body& body : scene.bodies) body.visit_state(a);
  scene.contact->visit_state(a);
  programme.visit_state(a);
  yield_watch_.visit_state(a);
}

double Simulation::work(bool load) const
{
  double sum = 0;
  const auto& t = result.trace;
  const int last = t.empty() ? 0 : t.back().segment;
  for (std::size_t k = 1; k < t.size(); ++k) {
    if (load ? t[k].branch != Branch::load : (t[k].branch != Branch::unload || t[k].segment != last))
      continue;
    sum += 0.5 * (t[k].force + t[k - 1].force) * (t[k].delta - t[k - 1].delta);
  }
  return load ? sum : -sum;
}

void Simulation::summarise(const Programme& programme)
{
  RunSummary& s = result.summary;
  for (Body& body : scene.bodies) {
    s.points += body.reference().filled;
    body.fetch_state();
    s.plastic_strain_max = std::max(s.plastic_strain_max, body.largest_plastic_strain());
  }
  result.yield_overlaps = yield_watch_.overlaps();
  s.steps = steps_;
  s.point_updates_per_s = static_cast<double>(s.points) * static_cast<double>(steps_) / s.cpu_s;
  for (const TraceSample& t : result.trace) s.delta_max = std::max(s.delta_max, t.delta);
  s.delta_residual = last_touch_overlap_;
  s.contact_time = last_touch_time_;
  const double put_in = energy_start + programme.work();
  const double peak = std::max({energy_start, std::abs(put_in), most_put_in_});
  const double found = total(scene, &Body::kinetic_energy) + total(scene, &Body::strain_energy) +
                       total(scene, &Body::plastic_work) + scene.contact->dissipated() + scene.contact->attracted();
  s.energy_error = std::abs(found - put_in) / peak;
  s.adhesion_loss = scene.contact->attracted() / peak;
  for (const TraceSample& t : result.trace) s.pull_off = std::max(s.pull_off, -t.force);
  s.contact_loss = scene.contact->dissipated() / peak;
  s.hourglass = total(scene, &Body::hourglass_energy) / peak;
}

}  // namespace granulaw
