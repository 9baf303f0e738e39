// No allocation inside the step. An executable of its own: it replaces operator new.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <new>

#include "base/larger.hpp"
#include "references.hpp"
#include "solver/body/stable_step.hpp"
#include "solver/loading/flight.hpp"
#include "solver/loading/press.hpp"
#include "solver/run/axisymmetric_setup.hpp"
#include "solver/run/spatial_setup.hpp"
#include "solver/run/time_step.hpp"

namespace {

std::atomic<long> allocations{0};

void* counted(std::size_t size, std::size_t alignment = alignof(std::max_align_t))
{
  ++allocations;
  void* memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (!memory) throw std::bad_alloc();
  return memory;
}

}  // namespace

// the forms for arrays and those that do not throw come back to these
void* operator new(std::size_t size)
{
  return counted(size);
}
void* operator new(std::size_t size, std::align_val_t alignment)
{
  return counted(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept
{
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept
{
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept
{
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept
{
  std::free(memory);
}

namespace granulaw::allocation_test {

struct Job
{
  const char* name;
  GridKind grid;
  Precision precision;
  bool partner = false;
  bool pressed = false;
  friend void PrintTo(const Job& job, std::ostream* out) { *out << job.name; }
};

class Allocations : public testing::TestWithParam<Job>
{
};

/// A whole impact or press, over which the contact grows from one surface point to all that it ever covers.
/// The first step alone may allocate, what is kept for all others.
TEST_P(Allocations, NoneAfterTheFirstStep)
{
  RunOptions options;
  options.grid = GetParam().grid;
  options.precision = GetParam().precision;
  const Particle particle = reference::unit_sphere(100);
  Partner partner;
  if (GetParam().partner) partner.particle = Particle::sphere(1.5, reference::unit_sphere(80).materials[0]);
  constexpr double velocity = 0.02, depth = 0.02;
  const bool pressed = GetParam().pressed;
  const Collision collision(particle, partner, options, Support::free);
  Scene scene = collision.build(pressed ? depth : collision.expected_overlap(velocity), 8, 0.0);
  const double reduced = scene.reduced_mass();
  std::vector<StableStep> stable;
  for (Body& body : scene.bodies) {
    stable.emplace_back(body);
    if (!pressed) throw_body(body, {0, 0, -velocity * reduced / body.mass()});
  }
  Flight impact(20);
  Press press({{0.5 * depth, depth}, 10, 4}, collision.e_star(), std::make_unique<BodyForce>());
  Programme& programme = pressed ? static_cast<Programme&>(press) : impact;

  long first = 0, steps = 0, touching = 0;
  double time = 0, widest = 0;
  while (!programme.finished()) {
    double dt = 1;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
      dt = std::min(dt, 0.85 * stable[b].limit(scene.bodies[b]));
    const double impulse = advance(scene, programme, time, dt, dt);
    const double radius = scene.contact->edge_radius(scene.bodies);
    programme.observe({time, 0, impulse / dt, radius, Branch::load, 0});
    touching += impulse > 0;
    widest = larger(widest, radius);
    time += dt;
    if (++steps == 1) first = allocations;
    ASSERT_EQ(allocations, first) << "in step " << steps;
    ASSERT_LT(steps, 100000);
  }
  EXPECT_GT(touching, 200);
  EXPECT_GT(widest, 0.1);  // over several of the 8 cells of the block
}

/// The same in three dimensions, oblique and with friction.
class SpatialAllocations : public testing::TestWithParam<Precision>
{
};

TEST_P(SpatialAllocations, NoneAfterTheFirstStep)
{
  Plane wall{Vector3::UnitZ(), std::nan("")};
  wall.friction = 0.3;
  RunOptions options;
  options.precision = GetParam();
  const SpatialSetup setup(reference::unit_sphere(100), Eigen::Matrix3d::Identity(), {wall},
                           {false, true, false}, options);
  constexpr double velocity = 0.1;
  Scene scene = setup.build(setup.expected_overlap(velocity), 6, 0.0);
  Body& body = scene.bodies.front();
  const StableStep stable(body);
  throw_body(body, {velocity, 0, -velocity}, Vector3::Zero(), scene.centre);
  Flight programme(20);
  long first = 0, steps = 0, touching = 0;
  double time = 0;
  while (!programme.finished()) {
    const double dt = 0.85 * stable.limit(body);
    touching += advance(scene, programme, time, dt, dt) > 0;
    time += dt;
    if (++steps == 1) first = allocations;
    ASSERT_EQ(allocations, first) << "in step " << steps;
    ASSERT_LT(steps, 100000);
  }
  EXPECT_GT(touching, 50);
}

INSTANTIATE_TEST_SUITE_P(Precisions, SpatialAllocations, testing::Values(Precision::full, Precision::single),
                         [](const auto& p) { return p.param == Precision::full ? "full" : "single"; });

TEST(Allocations, AreCounted)
{
  const long before = allocations;
  std::vector<double> some(10);
  EXPECT_EQ(allocations, before + 1) << some.size();
}

INSTANTIATE_TEST_SUITE_P(Grids, Allocations,
                         testing::Values(Job{"mapped", GridKind::mapped, Precision::full},
                                         Job{"rectilinear", GridKind::rectilinear, Precision::full},
                                         Job{"updated", GridKind::updated, Precision::full},
                                         Job{"two_mapped", GridKind::mapped, Precision::full, true},
                                         Job{"two_rectilinear", GridKind::rectilinear, Precision::full, true},
                                         Job{"single_precision", GridKind::rectilinear, Precision::single},
                                         Job{"press", GridKind::mapped, Precision::full, false, true},
                                         Job{"press_two", GridKind::rectilinear, Precision::full, true,
                                             true}),
                         [](const auto& job) { return job.param.name; });

}  // namespace granulaw::allocation_test
