// A run that is stopped anywhere and goes on from its checkpoint has the identical trace, bit for bit.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <map>
#include <mutex>
#include <sstream>

#include "references.hpp"
#include "refusal.hpp"
#include "solver/run/accuracy.hpp"
#include "solver/runs.hpp"

namespace granulaw::checkpoint_test {

/// The process is "killed": thrown out of the run by the store itself.
struct Killed
{
};

/// States in memory. Dies after `lives` of them.
class Memory
{
 public:
  CheckpointStore store(long lives = -1)
  {
    left_ = lives;
    CheckpointStore s;
    s.name = "memory";
    s.load = [this](const std::string& key) {
      const std::lock_guard lock(mutex);
      const auto state = states.find(key);
      return state == states.end() ? std::string() : state->second;
    };
    s.save = [this](const std::string& key, std::string state) {
      const std::lock_guard lock(mutex);
      if (left_ == 0) throw Killed{};
      states[key] = std::move(state);
      ++saved;
      if (--left_ == 0) throw Killed{};
    };
    s.due = [](const std::string&) { return true; };
    return s;
  }
  std::map<std::string, std::string> states;
  long saved = 0;

 private:
  std::mutex mutex;
  long left_ = -1;
};

/// Everything of a result but the time it took, every bit of it.
std::string bits(const RunResult& result)
{
  std::ostringstream out;
  const auto number = [&](double x) { out << std::hex << std::bit_cast<std::uint64_t>(x) << ' '; };
  for (const TraceSample& t : result.trace) {
    number(t.time), number(t.delta), number(t.force), number(t.contact_radius);
    out << static_cast<int>(t.branch) << ' ' << t.segment << '\n';
  }
  const RunSummary& s = result.summary;
  for (const double x : {s.restitution, s.restitution_raw, s.restitution_spread, s.force_max, s.delta_max,
                         s.delta_residual, s.contact_time, s.work_load, s.work_unload, s.error_estimate,
                         s.plastic_strain_max, s.energy_error, s.contact_loss, s.hourglass, s.grid_noise})
    number(x);
  out << s.points << ' ' << s.steps;
  return out.str();
}

struct Job
{
  std::string name;
  Run run;
  RunOptions options{};
  friend void PrintTo(const Job& job, std::ostream* out) { *out << job.name; }
};

/// Coarse and short, one grid: what is tested does not depend on it.
RunOptions small(GridKind grid, Precision precision = Precision::full)
{
  RunOptions o;
  o.grid = grid;
  o.precision = precision;
  o.resolution = 6;
  o.shifted_grids = 1;
  o.samples = 60;
  return o;
}

/// The mean of several shifted grids, and a coarse partner (accuracy.hpp) whose shifted cells are not folded.
RunOptions several(int grids)
{
  RunOptions o = small(GridKind::mapped);
  o.shifted_grids = grids;
  o.resolution = 16;
  return o;
}

Particle soft()
{
  return reference::unit_sphere(100);
}

/// A material that remembers how long its last step was.
Particle rate_dependent()
{
  Particle s = soft();
  s.materials[0].rate = {"johnson-cook", {{"coefficient", {0.1}}, {"reference_rate", {1e-4}}}};
  return s;
}

Run impact(const Particle& sphere, const Partner& partner = {}, double velocity = 0.05)
{
  return [=](const RunOptions& o) { return impact(sphere, {velocity}, partner, o); };
}

Run press(Support support, const Partner& partner = {})
{
  PressPlan plan;
  plan.depth = 0.03;
  plan.support = support;
  plan.partial_unloads = {0.01, 0.02};
  plan.ramp = 10;
  return [=](const RunOptions& o) { return press(soft(), plan, partner, o); };
}

/// Three dimensions, with all that they keep: friction, spin, impulses at the markers; below, attraction.
Run oblique_impact(const Partner& partner = {}, double velocity = 0.1)
{
  Approach thrown{velocity};
  thrown.friction = 0.2, thrown.tangential_velocity = velocity;
  return [=](const RunOptions& o) { return impact(soft(), thrown, partner, o); };
}

Run cube_press()
{
  PressPlan plan;
  plan.planes = named_planes("cube"), plan.depth = 0.08, plan.ramp = 10;
  return [=](const RunOptions& o) { return press(soft(), plan, {{}, {}, {1e-4, 0.02}}, o); };
}

std::vector<Job> jobs()
{
  Particle other = reference::unit_sphere(60);
  other.radius = 1.3;
  const Partner particle{other, {}}, wall{{}, soft().materials[0]}, sticky{other, {}, {1e-3, 0.1}};
  std::vector<Job> all{
      {"mapped", impact(soft()), small(GridKind::mapped)},
      {"rectilinear", impact(soft()), small(GridKind::rectilinear)},
      {"updated", impact(soft()), small(GridKind::updated)},
      {"single_precision_rectilinear", impact(soft()), small(GridKind::rectilinear, Precision::single)},
      {"rate_dependent", impact(rate_dependent()), small(GridKind::mapped)},
      {"two_mapped", impact(soft(), particle), small(GridKind::mapped)},
      {"two_rectilinear", impact(soft(), particle), small(GridKind::rectilinear)},
      {"two_sticky", impact(soft(), sticky), small(GridKind::mapped)},
      {"wall", impact(soft(), wall), small(GridKind::mapped)},
      {"press_free", press(Support::free), small(GridKind::mapped)},
      {"press_two", press(Support::free, particle), small(GridKind::mapped)},
      {"oblique_impact", oblique_impact(), small(GridKind::spatial)},
      {"oblique_two_single", oblique_impact(particle, 0.02), small(GridKind::spatial, Precision::single)},
      {"cube_press_single", cube_press(), small(GridKind::spatial, Precision::single)},
  };
  RunOptions shifted = several(2);
  shifted.estimate_error = true;
  all.push_back({"shifted_grids_with_estimate", impact(soft()), shifted});
  return all;
}

class Checkpoint : public testing::TestWithParam<Job>
{
};

TEST_P(Checkpoint, GoesOnWithTheIdenticalTrace)
{
  const Job& job = GetParam();
  const std::string unbroken = bits(job.run(job.options));
  Memory whole;
  RunOptions options = job.options;
  options.checkpoints = whole.store();
  EXPECT_TRUE(bits(job.run(options)) == unbroken);  // keeping states changes nothing
  ASSERT_GT(whole.saved, 30);

  for (const long lives : {1L, whole.saved - 1}) {
    Memory memory;
    options.checkpoints = memory.store(lives);
    EXPECT_THROW(job.run(options), Killed);
    ASSERT_EQ(memory.saved, lives);
    options.checkpoints = memory.store();
    EXPECT_TRUE(bits(job.run(options)) == unbroken) << "killed after " << lives << " of " << whole.saved;
    EXPECT_EQ(memory.saved, whole.saved);  // it went on, and did nothing twice
  }
  Memory memory;  // killed again and again
  for (int parts = 1;; ++parts) {
    options.checkpoints = memory.store(12);
    try {
      EXPECT_TRUE(bits(job.run(options)) == unbroken);
      EXPECT_GT(parts, 2);
      break;
    } catch (const Killed&) {
    }
    ASSERT_LT(parts, 1000);
  }
}

INSTANTIATE_TEST_SUITE_P(Jobs, Checkpoint, testing::ValuesIn(jobs()),
                         [](const auto& job) { return job.param.name; });

/// At every sample of a press: at each of its turns something else decides what comes next.
TEST(CheckpointOfAPress, AtEverySample)
{
  RunOptions options = small(GridKind::mapped);
  const auto run = press(Support::midplane);
  const std::string unbroken = bits(run(options));
  Memory whole;
  options.checkpoints = whole.store();
  run(options);
  for (long lives = 1; lives <= whole.saved; ++lives) {
    Memory memory;
    options.checkpoints = memory.store(lives);
    EXPECT_THROW(run(options), Killed);
    options.checkpoints = memory.store();
    EXPECT_TRUE(bits(run(options)) == unbroken) << "killed after " << lives << " of " << whole.saved;
  }
}

TEST(CheckpointOfSeveral, RunsAtTheSameTime)
{
  RunOptions options = several(4);
  const std::string unbroken = bits(impact(soft())(options));
  options.threads = 3;  // nor need they be as many as before
  for (const long lives : {5L, 90L, 170L}) {
    Memory memory;
    options.checkpoints = memory.store(lives);
    EXPECT_THROW(impact(soft())(options), Killed);
    options.threads = 2;
    options.checkpoints = memory.store();
    EXPECT_TRUE(bits(impact(soft())(options)) == unbroken);
  }
}

/// The search for a tolerance runs the same job under many options: none may be taken for another.
TEST(CheckpointOfSeveral, RunsToATolerance)
{
  const auto to_tolerance = [](const RunOptions& o) {
    return run_to_tolerance(0.2, true, o, press(Support::midplane)).result;
  };
  RunOptions options = small(GridKind::mapped);
  options.resolution = 0;
  const std::string unbroken = bits(to_tolerance(options));
  Memory whole;
  options.checkpoints = whole.store();
  EXPECT_TRUE(bits(to_tolerance(options)) == unbroken);
  ASSERT_GE(whole.states.size(), 5u);  // probes: base, step, ramp; then two resolutions
  Memory memory;
  options.checkpoints = memory.store(whole.saved / 2);
  EXPECT_THROW(to_tolerance(options), Killed);
  options.checkpoints = memory.store();
  EXPECT_TRUE(bits(to_tolerance(options)) == unbroken);
}

/// CPU time counts all parts: what is spent on a part is never lost.
TEST(CheckpointTime, AddsUp)
{
  RunOptions options = small(GridKind::mapped);
  Memory memory;
  options.checkpoints = memory.store(40);
  EXPECT_THROW(impact(soft())(options), Killed);
  const std::map<std::string, std::string> kept = memory.states;
  options.checkpoints = memory.store();
  const double once = impact(soft())(options).summary.cpu_s;
  // finished already: the same result, the time it took included
  EXPECT_EQ(impact(soft())(options).summary.cpu_s, once);
  EXPECT_GT(once, 0);
}

TEST(CheckpointOfOne, IsRefusedWhereItDoesNotFit)
{
  RunOptions options = small(GridKind::mapped);
  Memory memory;
  options.checkpoints = memory.store(30);
  EXPECT_THROW(impact(soft())(options), Killed);
  options.checkpoints = memory.store();
  // the same keys; the expected overlap, and with it the block, is another one
  expect_error("memory: its state does not fit this run (reference grid)", [&] { impact(soft(), {}, 0.02)(options); });
  const auto resumed = [&] { return sentence_of([&] { impact(soft())(options); }); };
  std::string& state = memory.states.begin()->second;
  const char last = state.back();
  state.pop_back();
  EXPECT_EQ(resumed(), "memory: its state of the run ends too early");
  (state += last) += last;
  EXPECT_EQ(resumed(), "memory: its state of the run is followed by something else");
  options.fields.frame = [](const FieldFrame&) {};
  expect_error("--checkpoint: cannot go with --fields", [&] { impact(soft())(options); });
}

}  // namespace granulaw::checkpoint_test
