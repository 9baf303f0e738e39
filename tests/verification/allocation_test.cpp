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

/// A whole impact or press, over which the contact grows from one surface point to all that it ever covers; in space oblique and
/// with friction. The first step alone may allocate, what is kept for all others.
TEST_P(Allocations, NoneAfterTheFirstStep)
{
  const Job& job = GetParam();
  RunOptions options;
  options.grid = job.grid, options.precision = job.precision;
  const Particle particle = reference::unit_sphere(100);
  Partner partner;
  if (job.partner) partner.particle = Particle::sphere(1.5, reference::unit_sphere(80).materials[0]);
  constexpr double depth = 0.02;
  const bool spatial = job.grid == GridKind::spatial;
  const double velocity = spatial ? 0.1 : 0.02;
  Plane wall{Vector3::UnitZ(), std::nan("")};
  wall.friction = 0.3;
  std::unique_ptr<Collision> collision;
  std::unique_ptr<SpatialSetup> setup;
  if (spatial)
    setup = std::make_unique<SpatialSetup>(particle, Eigen::Matrix3d::Identity(), std::vector{wall}, std::array{false, true, false}, options);
  else
    collision = std::make_unique<Collision>(particle, partner, options, Support::free);
  Scene scene = spatial ? setup->build(setup->expected_overlap(velocity), 6, 0.0)
                        : collision->build(job.pressed ? depth : collision->expected_overlap(velocity), 8, 0.0);
  const double reduced = spatial ? 0 : scene.reduced_mass();
  std::vector<StableStep> stable;
  for (Body& body : scene.bodies) {
    stable.emplace_back(body);
    if (spatial)
      throw_body(body, {velocity, 0, -velocity}, Vector3::Zero(), scene.centre);
    else if (!job.pressed)
      throw_body(body, {0, 0, -velocity * reduced / body.mass()});
  }
  Flight impact(20);
  Press press({{0.5 * depth, depth}, 10, 4}, spatial ? 1 : collision->e_star(), std::make_unique<BodyForce>());
  Programme& programme = job.pressed ? static_cast<Programme&>(press) : impact;

  long first = 0, steps = 0, touching = 0;
  double time = 0, widest = 0;
  while (!programme.finished()) {
    double dt = 1;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) dt = std::min(dt, 0.85 * stable[b].limit(scene.bodies[b]));
    const double impulse = advance(scene, programme, time, dt, dt), radius = spatial ? 1 : scene.contact->edge_radius(scene.bodies);
    if (!spatial) programme.observe({time, 0, impulse / dt, radius, Branch::load, 0});
    touching += impulse > 0;
    widest = larger(widest, radius);
    time += dt;
    if (++steps == 1) first = allocations;
    ASSERT_EQ(allocations, first) << "in step " << steps;
    ASSERT_LT(steps, 100000);
  }
  EXPECT_GT(touching, spatial ? 50 : 200);
  EXPECT_GT(widest, 0.1);  // over several of the 8 cells of the block
}

TEST(Allocations, AreCounted)
{
  const long before = allocations;
  std::vector<double> some(10);
  EXPECT_EQ(allocations, before + 1) << some.size();
}

INSTANTIATE_TEST_SUITE_P(Grids, Allocations,
                         testing::Values(Job{"mapped", GridKind::mapped, Precision::full}, Job{"rectilinear", GridKind::rectilinear, Precision::full},
                                         Job{"updated", GridKind::updated, Precision::full}, Job{"two_mapped", GridKind::mapped, Precision::full, true},
                                         Job{"two_rectilinear", GridKind::rectilinear, Precision::full, true},
                                         Job{"single_precision", GridKind::rectilinear, Precision::single}, Job{"press", GridKind::mapped, Precision::full, false, true},
                                         Job{"press_two", GridKind::rectilinear, Precision::full, true, true}, Job{"spatial", GridKind::spatial, Precision::full},
                                         Job{"spatial_single", GridKind::spatial, Precision::single}),
                         [](const auto& job) { return job.param.name; });

}  // namespace granulaw::allocation_test
