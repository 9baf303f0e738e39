// The evaluator beside the classes that the plug-in and `mpm law` use, on laws of the atlas.
#include <gtest/gtest.h>

#include <cmath>

#include "characterise/atlas.hpp"
#include "characterise/law_from_atlas.hpp"
#include "contact/contact.hpp"
#include "law/fast_curve.hpp"
#include "law/replay.hpp"

namespace granulaw {
namespace {

LawMaterial material(double stiffness, double hardening = 0)
{
  return {"m", 1, 1 - 0.09, 0.3, 1 / stiffness, hardening * (1 - 0.09)};
}

BodyLaw law_of(double stiffness, double hardening = 0)
{
  static const Atlas atlas = read_atlas(GRANULAW_ATLAS_FILE);
  BuildOptions options;
  options.depth = 0.2;
  return law_from(atlas, material(stiffness, hardening), options);
}

/// Central differences of f; from the onset on forward.
double slope(double x, double onset, const auto& f)
{
  const double h = 1e-5 * x;
  return x - h < onset ? (f(x + h) - f(x)) / h : (f(x + h) - f(x - h)) / (2 * h);
}

/// The same law in the evaluator's tables.
Curve tables_of(const ContactCurve& curve)
{
  CurveTable t(curve.onset(), 0.999 * curve.x_end());
  const double none = 0;
  for (const double x : t.nodes()) {
    const ContactCurve::Loading l = curve.loading(x);
    t.force.add(l.force, l.stiffness);
    t.radius.add(l.radius, slope(x, none, [&](double at) { return curve.loading(at).radius; }));
  }
  const std::vector<double> yielding = t.yielding_nodes();
  const auto kept = [&](double x) { return curve.work_unloading(x) / curve.work_loading(x); };
  const auto span = [&](double x) { return 1 - curve.reversal(x).residual / x; };
  for (const double x : yielding) {
    const bool onset = x == yielding.front();
    t.kept.add(onset ? 1 : kept(x), onset ? 0 : slope(x, curve.onset(), kept));
    t.span.add(onset ? 1 : span(x), onset ? 0 : slope(x, curve.onset(), span));
    t.hertz_share.add(curve.reversal(std::max(x, 1.0001 * curve.onset())).shape.hertz_share, 0);
  }
  for (std::size_t k = 1; k + 1 < yielding.size(); ++k)
    t.hertz_share.slope[k] =
        (t.hertz_share.value[k + 1] - t.hertz_share.value[k - 1]) / (yielding[k + 1] - yielding[k - 1]);
  make_rise(t.force, t.nodes()), make_rise(t.radius, t.nodes());
  make_fall(t.kept, yielding), make_fall(t.span, yielding);

  const VelocityAxis::Table& a = curve.axis()->table();
  AxisTable axis;
  axis.speed_end = a.speed_end, axis.share_end = a.ratio_end;
  axis.reach = {a.impact_overlap, a.impact_overlap_slope};
  for (std::size_t k = 1; k <= a.levels; ++k) {
    const double x = curve.axis()->scale().overlap(static_cast<double>(k));
    const bool yields = x > curve.onset();
    const ContactCurve::Reversal top = curve.reversal(x, x);
    axis.level.push_back(x);
    axis.kept.push_back(yields ? curve.work_unloading(x, x) / curve.work_loading(x, x) : 1);
    axis.span.push_back(yields ? 1 - top.residual / x : 1);
  }
  axis.force = {a.force_correction, a.force_correction_slope};
  const Fault fault = Curve::fault(t, &axis);
  EXPECT_FALSE(fault) << fault.what << ' ' << fault.found << ' ' << fault.allowed;
  return Curve(t, axis);
}

TEST(Beside, LoadingForceAndItsSlopeAreFastCurves)
{
  for (const double stiffness : {60.0, 200.0, 2000.0}) {
    const BodyLaw law = law_of(stiffness);
    const FastCurve fast(law.curve);
    const Curve curve = tables_of(law.curve);
    // up to the last interval, whose end lies beyond the old table
    const double last = curve.table().node(curve.table().force.size() - 2);
    for (double x = 1e-8; x < last; x *= 1.03)
      for (const double latched : {0.0, 0.01, 0.07}) {
        const FastCurve::Response old = fast.loading_response(x, latched);
        // 1e-5 of F: cubics on an eighth of an octave, of both; their slopes to 1e-3
        EXPECT_NEAR(curve.force(x, latched) / old.force, 1, 1e-5) << stiffness << ' ' << x << ' ' << latched;
        EXPECT_NEAR(curve.loading(x, latched).stiffness / old.stiffness, 1, 1e-3);
      }
  }
}

TEST(Beside, CollisionsAreThose)
{
  for (const double stiffness : {60.0, 200.0, 2000.0})
    for (const double hardening : {0.0, 0.05}) {
      const BodyLaw law = law_of(stiffness, hardening);
      const Curve curve = tables_of(law.curve);
      const PairLaw pair = wall_pair(law);
      const double mass = 4. / 3 * M_PI;
      for (const double v : {0.01, 0.04, 0.1, 0.2}) {
        const double speed = v / std::sqrt(stiffness);
        const Replay old = replay_collision(pair, 1, mass, speed);
        if (old.left_range) continue;
        const double latched = curve.reach(v);
        const Replay now = replay_collision(
            [&](double delta, double delta_max) {
              const Answer a = answer(curve, pair.mapping, 1, delta, delta_max, latched);
              return ContactForce{a.force, a.stiffness, a.contact_radius, a.delta_max};
            },
            mass, speed, old.contact_time, 20000);
        EXPECT_NEAR(now.force_max / old.force_max, 1, 1e-4) << stiffness << ' ' << v;
        // 2e-3 of e: the loss of an impact that reverses near a level's X, where the two classes interpolate
        // differently
        EXPECT_NEAR(now.restitution, old.restitution, 2e-3) << stiffness << ' ' << hardening << ' ' << v;
        EXPECT_NEAR(now.contact_time / old.contact_time, 1, 5e-3) << stiffness << ' ' << v;
      }
    }
}

TEST(Beside, TheWorkLostNeverFalls)
{
  for (const double stiffness : {30.0, 60.0, 200.0, 2000.0}) {
    const BodyLaw law = law_of(stiffness);
    const Curve curve = tables_of(law.curve);
    std::vector<double> all = curve.examined_levels();
    all.push_back(0);
    for (const double latched : all) {
      double before = 0;
      for (double x = 0.9 * curve.onset(); x < curve.end(); x *= 1.003) {
        const double lost = curve.lost(x, latched);
        EXPECT_GE(lost, before * (1 - 1e-6)) << stiffness << ' ' << latched << ' ' << x;
        before = lost;
      }
    }
  }
}

}  // namespace
}  // namespace granulaw
