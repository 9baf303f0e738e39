// Which tangential law a deck needs: by speeds, friction and the part of collisions that stick.
#include "deck/tangential_need.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "deck_fixture.hpp"

namespace granulaw::deck::tangential_need_test {

TangentialNeed need_of(double friction, double yield_stress, double speed = 0.5, bool says_friction = true)
{
  static Plan plan;  // the answer points into it
  Scene s = falling();
  if (says_friction) s.friction = {friction, friction, friction, friction};
  PlanOptions options;
  options.materials[1] = {"wax", 1000, 91e6, 0.3, yield_stress, 0};
  options.speed = speed;
  plan = make_plan(s, options);
  return tangential_need(s, plan);
}

/// Two spheres with random velocities: the angle of their relative velocity from the line of centres has sin(2 angle).
TEST(TangentialNeed, StickingPartIsThatOfRandomCollisions)
{
  std::mt19937 random(4);
  std::normal_distribution<double> component;
  for (const auto& [mu, e] : {std::pair{0.1, 1.0}, {0.3, 0.6}, {0.6, 0.3}}) {
    double stick = 0, all = 0;
    for (int k = 0; k < 200000; ++k) {
      const double normal = component(random), slide = std::hypot(component(random), component(random));
      if (normal <= 0) continue;
      all += normal;  // as many collide as come nearer
      if (slide < 3.5 * mu * (1 + e) * normal) stick += normal;
    }
    EXPECT_NEAR(stick / all, sticking_part(mu, e), 0.005) << mu;  // scatter of 1e5 collisions: 0.0016
  }
}

TEST(TangentialNeed, PlasticWhereFastYieldingContactsStick)
{
  const TangentialNeed need = need_of(0.3, 1e5);
  ASSERT_NE(need.pair, nullptr);
  EXPECT_EQ(need.friction, 0.3);
  EXPECT_GT(need.sticking, 0.5);
  EXPECT_NE(need.reason.find("at friction 0.3"), std::string::npos) << need.reason;
}

TEST(TangentialNeed, HistoryElsewhere)
{
  for (const auto& [need, why] : {std::pair{need_of(0.0, 1e5), "no contact that may yield has friction"},
                                  {need_of(0.3, 1e5, 0.5, false), "no contact that may yield has friction"},
                                  {need_of(0.3, 1e9), "no contact with friction yields"},
                                  {need_of(0.02, 1e5), "% of random collisions stick"},
                                  {need_of(0.3, 1e6, 0.02), "the spring is known to fail from 10 on"}}) {
    EXPECT_EQ(need.pair, nullptr) << why;
    EXPECT_NE(need.reason.find(why), std::string::npos) << need.reason << " | " << why;
  }
}

}  // namespace granulaw::deck::tangential_need_test
