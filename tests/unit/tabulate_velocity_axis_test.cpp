#include "atlas/tabulate_velocity_axis.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/larger.hpp"
#include "characterise/atlas_file.hpp"
#include "characterise/body/characterised_body.hpp"
#include "atlas/tabulate_curve.hpp"

namespace granulaw::tabulate_velocity_axis_test {

/// From soft bodies, whose onset lies between the table's levels, to stiff ones, whose onset lies far below
/// the first: the work lost never falls, whatever the impact.
TEST(TabulateInertia, LosesNoLessFurtherOn)
{
  const Atlas atlas = read_atlas(GRANULAW_ATLAS_FILE);
  for (const double stiffness : {20.5, 26.0, 34.0, 66.0, 200.0, 1000.0, 4500.0})
    for (const double hardening : {0.0, 0.15}) {
      const CharacterisedBody body = characterised_body_of(stiffness, 0.3, hardening);
      const LawShape shape = atlas.shape({stiffness, 0.3, hardening});
      const Curve slow = tabulate(shape, 0.2);
      const Curve curve =
          fitted_curve(slow.table(), tabulate_inertia(shape, slow, stiffness, body.mass, 0.25));
      for (const double latched : curve.examined_levels()) {
        double before = 0;
        for (double x = 0.9 * body.onset; x < 0.2; x *= 1.003) {
          const double lost = curve.lost(x, latched);
          EXPECT_GE(lost, before * (1 - 1e-6)) << stiffness << ' ' << hardening << ' ' << latched << ' ' << x;
          before = lost;
        }
      }
    }
}

/// Before it reverses an impact loses its rate, and the force falls, by half where the yield stress rises
/// much with the rate. A law's loading force rises: to the peak, and on until it is the press's again.
TEST(TabulateRate, RisesToThePeakOfImpactsWhoseForceFallsBeforeTheyReverse)
{
  const double stiffness = 300, mass = 4. / 3 * M_PI, fastest = 0.25;
  LawShape sphere = read_atlas(GRANULAW_ATLAS_FILE).shape({stiffness, 0.3, 0});
  sphere.velocity_effects.clear();
  const Curve slow = tabulate(sphere, 0.3);
  for (const double raised : {0.1, 0.6, 1.6}) {  // at the fastest, over the force without rate
    LawShape shape = sphere;
    for (double v = 0.005; v < 1.01 * fastest; v *= std::pow(50.0, 0.2)) {
      const double more = raised * (0.2 + 0.8 * std::log(v / 0.005) / std::log(50.0));
      double x = 0;  // X: where the work of loading, so much more, is the kinetic energy
      while ((1 + 0.9 * more) * slow.work(x) < 0.375 * mass / stiffness * v * v) x += 1e-6;
      LawShape::VelocityEffect impact{v, std::log(x / v), 0, 0, {}};
      double peak = 0;
      for (int n = 0; n < LawShape::VelocityEffect::shares; ++n) {
        const double share = n / (LawShape::VelocityEffect::shares - 1.0);
        const double fall = std::max(0.0, (share - 0.8) / 0.2), factor = 1 + more * (1 - 0.7 * fall * fall);
        impact.force.push_back(std::log(factor));
        peak = larger(peak, factor * slow.loading(share * x).force);
      }
      impact.force.back() = std::log(peak / slow.loading(x).force);  // as impact_force_ratios() has it
      shape.velocity_effects.push_back(impact);
    }
    const AxisTable table = tabulate_rate(shape, slow, stiffness, mass, fastest, 1e-3);
    const Curve curve = fitted_curve(slow.table(), table);  // throws where the force falls
    for (const LawShape::VelocityEffect& impact : shape.velocity_effects) {
      const double x = curve.reach(impact.speed);
      // 0.5 %: between levels a third of an octave apart
      EXPECT_NEAR(curve.loading(x, x).force / slow.loading(x).force, std::exp(impact.force.back()),
                  5e-3 * std::exp(impact.force.back()))
          << raised << ' ' << impact.speed;
      const double far = 1.001 * table.share_end * x;
      EXPECT_EQ(curve.loading(far, x).force, slow.loading(far).force);
    }
  }
}

}  // namespace granulaw::tabulate_velocity_axis_test
