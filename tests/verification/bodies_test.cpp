// Two deformable bodies: what must hold to rounding, what symmetry demands, and Hertz.
#include <gtest/gtest.h>

#include <cmath>

#include "base/scales.hpp"
#include "law/radiation.hpp"
#include "references.hpp"
#include "solver/body/stable_step.hpp"
#include "solver/grid/mapped_body.hpp"
#include "solver/loading/flight.hpp"
#include "solver/run/axisymmetric_setup.hpp"
#include "solver/run/grid_noise.hpp"
#include "solver/run/simulation.hpp"
#include "solver/run/time_step.hpp"
#include "solver/runs.hpp"

namespace granulaw::bodies_test {

Particle sphere(double radius, double e_over_y, double stiffness = 1, double density = 1)
{
  Particle s = reference::unit_sphere(e_over_y);
  s.radius = radius;
  s.materials[0].youngs_modulus *= stiffness, s.materials[0].density *= density;
  return s;
}

Partner against(const Particle& particle)
{
  Partner partner;
  partner.particle = particle;
  return partner;
}

Partner wall(double e_over_y, double stiffness = 1, double density = 1)
{
  Partner partner;
  partner.wall = sphere(1, e_over_y, stiffness, density).materials.front();
  return partner;
}

RunOptions options_of(int resolution, int shifted_grids, GridKind grid = GridKind::automatic)
{
  RunOptions o;
  o.resolution = resolution, o.shifted_grids = shifted_grids, o.grid = grid;
  return o;
}

class TwoBodies : public testing::TestWithParam<GridKind>
{
};

/// Unlike spheres, step by step: the contact takes from one what it gives to the other.
TEST_P(TwoBodies, KeepMomentumInEveryStep)
{
  const Particle first = sphere(1, 100), second = sphere(2, 150, 3, 2);
  const Collision collision(first, against(second), options_of(8, 1, GetParam()), Support::free);
  const double v = 0.02, deepest = collision.expected_overlap(v);
  Scene scene = collision.build(deepest, 8, 0);
  const double reduced = scene.reduced_mass();
  for (Body& body : scene.bodies) throw_body(body, {0, 0, -v * reduced / body.mass()});
  const double moved = v * reduced;
  const auto momentum_of = [&](int b) { return momentum(scene.bodies[b])[2]; };
  Flight programme(2 * deepest / v);
  double limit = StableStep(scene.bodies[0]).limit(scene.bodies[0]);
  limit = std::min(limit, StableStep(scene.bodies[1]).limit(scene.bodies[1]));
  const double dt = 0.4 * limit;  // as undeformed: margin for what flattens
  long touched = 0;
  for (long n = 0; !programme.finished(); ++n) {
    ASSERT_LT(n, 100000);
    const double before0 = momentum_of(0), before1 = momentum_of(1);
    const double impulse = advance(scene, programme, n * dt, dt, dt);
    touched += impulse > 0;
    // rounding of some thousand nodes' share
    ASSERT_NEAR(momentum_of(0) - before0, impulse, 1e-13 * moved);
    ASSERT_NEAR(momentum_of(1) - before1, impulse, 1e-13 * moved);
    ASSERT_NEAR(momentum_of(0) - momentum_of(1), 0,
                1e-11 * moved);  // of the centre of mass: thousands of steps
  }
  EXPECT_GT(touched, 100);
  EXPECT_GT(scene.separation_velocity(), 0.1 * v);
}
INSTANTIATE_TEST_SUITE_P(Grids, TwoBodies, testing::Values(GridKind::mapped, GridKind::rectilinear),
                         [](const auto& p) {
                           return p.param == GridKind::mapped ? "mapped" : "rectilinear";
                         });

/// Two like spheres have a plane of symmetry: each does what it would against the rigid plane at half the
/// relative velocity.
TEST(LikeSpheres, AreTheRigidPlaneAtHalfTheVelocity)
{
  const double v = 50 * yield_velocity(1, 0.01, 1);
  const RunOptions o = options_of(12, 4);
  const RunSummary pair = impact(sphere(1, 100), {2 * v}, against(sphere(1, 100)), o).summary;
  const RunSummary plane = impact(sphere(1, 100), {v}, {}, o).summary;
  // not the same numbers: the pair's contact sweeps until impulses change by 1e-7, the plane's is exact, and
  // its block is sized from both surfaces (measured: e 3e-6, F 8e-5, overlap 6e-5)
  EXPECT_NEAR(pair.restitution_raw, plane.restitution_raw, 1e-3 * plane.restitution_raw);
  EXPECT_NEAR(pair.force_max, plane.force_max, 5e-4 * plane.force_max);
  EXPECT_NEAR(pair.delta_max, 2 * plane.delta_max, 1e-3 * pair.delta_max);
  EXPECT_NEAR(pair.contact_time, plane.contact_time, 2e-3 * plane.contact_time);
  EXPECT_LT(pair.energy_error, 5e-4);
}

class Exchange : public testing::TestWithParam<GridKind>
{
};

/// Impulses act at the first body's surface points along the second one's normals: who is first must not
/// matter.
TEST_P(Exchange, ChangesNothing)
{
  const bool mapped = GetParam() == GridKind::mapped;
  const RunOptions o = options_of(mapped ? 16 : 12, mapped ? 4 : 8, GetParam());
  const Particle small = sphere(1, 100), large = sphere(3, 100);
  const RunSummary a = impact(small, {0.01}, against(large), o).summary;
  const RunSummary b = impact(large, {0.01}, against(small), o).summary;
  // The resolution's own error: 16 and 24 cells differ by 2e-3 in e, 1e-3 in F. Measured (mapped,
  // rectilinear): e 1.7e-3, 9e-4; F 1.6e-3, 5e-4; overlap 9e-4, 2e-4; at V = 0.004, 16 cells, 4 grids: 2e-4
  // in all.
  EXPECT_NEAR(a.restitution, b.restitution, 3e-3 * a.restitution);
  EXPECT_NEAR(a.force_max, b.force_max, 2e-3 * a.force_max);
  EXPECT_NEAR(a.delta_max, b.delta_max, 2e-3 * a.delta_max);
  EXPECT_LT(a.energy_error, 1e-3);  // measured 2e-4, 4e-4
  EXPECT_LT(b.energy_error, 1e-3);
}
INSTANTIATE_TEST_SUITE_P(Grids, Exchange, testing::Values(GridKind::mapped, GridKind::rectilinear),
                         [](const auto& p) {
                           return p.param == GridKind::mapped ? "mapped" : "rectilinear";
                         });

/// Hertz on half-spaces, with the leading effect of the bodies being finite: each one's centre of mass comes
/// nearer by k F/(E* R) less, k from the sphere on the rigid plane. (F/F_Hertz = 1 + 1.5 k sqrt(delta/R)
/// there.)
class FiniteHertz
{
 public:
  FiniteHertz()
  {
    const RunSummary s = impact(sphere(1, 0), {0.002}, {}, options_of(12, 2)).summary;
    k_ = (std::pow(0.75 * s.force_max, 2.0 / 3.0) - s.delta_max) / s.force_max;
  }
  double k() const { return k_; }
  /// Overlap under `force` of moduli E*_1, E*_2 and radii; 0: a half-space.
  double overlap(double force, double e1, double r1, double e2, double r2) const
  {
    const double e = 1 / (1 / e1 + 1 / e2), r = 1 / (1 / r1 + (r2 > 0 ? 1 / r2 : 0));
    const double half_spaces = std::pow(0.75 * force / (e * std::sqrt(r)), 2.0 / 3.0);
    return half_spaces - k_ * force * (1 / (e1 * r1) + (r2 > 0 ? 1 / (e2 * r2) : 0));
  }

 private:
  double k_;
};

TEST(Hertz, HoldsForUnlikeSpheresAndForWalls)
{
  const FiniteHertz hertz;
  EXPECT_NEAR(hertz.k(), 0.45, 0.05);  // 0.45 sqrt(delta/R) and 1.3 % of free support more
  struct Case
  {
    double stiffness, radius;
  };
  for (const Case c : {Case{3, 2}, Case{0.5, 0.5}, Case{1, 0}, Case{4, 0}}) {
    const Partner partner = c.radius > 0 ? against(sphere(c.radius, 0, c.stiffness)) : wall(0, c.stiffness);
    const RunSummary s = impact(sphere(1, 0), {0.002}, partner, options_of(12, 2)).summary;
    const double expected = hertz.overlap(s.force_max, 1, 1, c.stiffness, c.radius);
    // Next terms are of order delta/R = 0.01 and less in part; waves in the wall (1.5 % of the energy) shift
    // the peak. Measured 0.9995, 0.9997, 0.9967, 1.0014; without the correction 0.95 to 0.99.
    EXPECT_NEAR(s.delta_max / expected, 1, 0.005) << "E* ratio " << c.stiffness << ", radius " << c.radius;
    EXPECT_LT(s.energy_error, 1e-4);  // measured 1e-5
  }
}

/// A stiff and heavy wall is the rigid plane.
TEST(Wall, BecomesThePlaneWhenStiff)
{
  const RunOptions o = options_of(12, 4);
  const RunSummary stiff = impact(sphere(1, 100), {0.005}, wall(0, 1e4, 1e4), o).summary;
  const RunSummary rigid = impact(sphere(1, 100), {0.005}, {}, o).summary;
  EXPECT_NEAR(stiff.restitution, rigid.restitution, 1e-3);  // the wall's share of the compliance: 1e-4
  EXPECT_NEAR(stiff.force_max, rigid.force_max, 1e-3 * rigid.force_max);
  EXPECT_NEAR(stiff.delta_max, rigid.delta_max, 1e-3 * rigid.delta_max);
}

/// A slow force F(t) on the face of an elastic half-space radiates N/(rho c^3) int (dF/dt)^2 dt, N from Lamb's integral
/// (law/radiation.hpp), as long as the wave is long against the contact.
TEST(Wall, RadiatesWhatLambSays)
{
  const Particle ball = sphere(1, 0);
  for (const double v : {0.001, 0.004}) {
    const RunResult r = impact(ball, {v}, wall(0), options_of(12, 2));
    // dF/dt over spans of a fiftieth of the contact: longer than the grid noise's steps, short against the
    // pulse
    double squares = 0;
    const auto& t = r.trace;
    const std::size_t span = std::max<std::size_t>(1, t.size() / 60);
    const auto mean = [&](std::size_t from) {
      double sum = 0;
      for (std::size_t k = from; k < from + span; ++k) sum += t[k].force;
      return sum / static_cast<double>(span);
    };
    for (std::size_t k = 0; k + 2 * span <= t.size(); k += span) {
      const double dt = t[k + span].time - t[k].time, df = mean(k + span) - mean(k);
      squares += df * df / dt;
    }
    const double c = radiation_number(ball.materials.front().poisson_ratio);  // rho = E* = 1
    const double energy = 0.5 * (4.0 / 3.0 * M_PI) * v * v, e = r.summary.restitution_raw, lost = 1 - e * e;
    // the contact is not small against the wave, and dF/dt is taken over spans; measured 0.9 % and 0.3 %
    EXPECT_NEAR(c * squares / energy, lost, 0.02 * lost);
  }
}

/// The wall is half a ball of 30 R: twice that changes little.
TEST(Wall, IsThickEnough)
{
  const double v = 0.002;
  const RunOptions o = options_of(12, 1);
  const Particle ball = sphere(1, 0);
  const Collision collision(ball, wall(0), o, Support::free);
  const double deepest = collision.expected_overlap(v), duration = 2 * deepest / v + 2.5;
  const auto run_with = [&](double extent) {
    Scene scene = collision.build(deepest, 12, 0);
    const Moduli& m = scene.bodies.back().reference().regions.front().moduli;
    const double block = scene.bodies.back().reference().surface.place[12][0];
    scene.bodies.back() = mapped_body(MappedGrid::wall(12, block, extent), {m}, 0.05 * m.shear);
    Simulation run(std::move(scene), o, duration, 1.0);
    const double reduced = run.scene.reduced_mass();
    for (Body& body : run.scene.bodies) throw_body(body, {0, 0, -v * reduced / body.mass()});
    Flight programme(duration);
    run.run(programme, {{}, {}, duration}, {});
    return std::pair{run.scene.separation_velocity() / v, TreatedLoading(run.result.trace).force(0.015)};
  };
  const auto [e15, f15] = run_with(15);
  const auto [e60, f60] = run_with(60);
  const RunResult used = impact(ball, {v}, wall(0), o);
  const double force = TreatedLoading(used.trace).force(0.015);
  // Loss by the wall's own recoil falls with its mass, stiffness added by its far side with 1/extent.
  // Measured e .98615, .98511, .98498 and F 1.3023e-3, 1.3019e-3, 1.3018e-3 at 15, 30, 60 R.
  EXPECT_NEAR(used.summary.restitution_raw, e60, 3e-4);
  EXPECT_NEAR(force, f60, 3e-4 * f60);
  EXPECT_GT(std::abs(e15 - e60),
            2 * std::abs(used.summary.restitution_raw - e60));  // and half as thick is worse
}

/// Whoever yields, energies add up.
TEST(Energy, IsBalancedWithTwoBodies)
{
  const RunOptions o = options_of(12, 2);
  // plastic work by steps: measured 5e-4 at most
  EXPECT_LT(impact(sphere(1, 0), {0.01}, wall(100), o).summary.energy_error, 1e-3);
  EXPECT_LT(impact(sphere(1, 100), {0.01}, wall(50, 0.5), o).summary.energy_error, 1e-3);
  EXPECT_LT(impact(sphere(1, 100), {0.01}, against(sphere(2, 50, 2, 3)), o).summary.energy_error, 1e-3);
}

}  // namespace granulaw::bodies_test
