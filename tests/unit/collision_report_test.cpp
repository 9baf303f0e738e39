#include "collision_report.hpp"

#include <gtest/gtest.h>

#include "law/replay.hpp"
#include "solver/output/trace.hpp"

namespace granulaw::collision_report_test {

template <class Collision>
Collision some_collision()
{
  Collision c;
  c.restitution = 0.5;
  c.force_max = 2;
  c.delta_max = 3e-6;
  c.delta_residual = 1e-6;
  c.contact_time = 1e-5;
  c.work_load = 4e-6;
  c.work_unload = 1e-6;
  return c;
}

TEST(CollisionReport, ARunAndAReplayHaveTheSameKeys)
{
  const auto run = collision_json(some_collision<RunSummary>());
  EXPECT_EQ(run.dump(), R"({"e":0.5,"force_max_N":2.0,"delta_max_m":3e-06,"delta_residual_m":1e-06,)"
                        R"("contact_time_s":1e-05,"work_load_J":4e-06,"work_unload_J":1e-06})");
  EXPECT_EQ(collision_json(some_collision<Replay>()), run);
}

TEST(CollisionReport, AnUnknownErrorIsNull)
{
  nlohmann::ordered_json out;
  put_effort(out, 100, 200, 0.5, 4e4, 0.01);
  EXPECT_EQ(out.dump(),
            R"({"points":100,"steps":200,"cpu_s":0.5,"point_updates_per_s":40000.0,"error_estimate":0.01})");
  put_effort(out, 100, 200, 0.5, 4e4, 0);
  EXPECT_TRUE(out["error_estimate"].is_null());
}

TEST(CollisionReport, IsReadByPeople)
{
  testing::internal::CaptureStdout();
  print_collision(some_collision<Replay>(), "half of it");
  EXPECT_EQ(testing::internal::GetCapturedStdout(),
            "coefficient of restitution e   0.5000\n"
            "largest force                  2 N\n"
            "largest overlap                3e-06 m  (half of it)\n"
            "residual overlap               1e-06 m\n"
            "contact time                   1e-05 s\n"
            "work put in, given back        4e-06 J, 1e-06 J\n");
}

}  // namespace granulaw::collision_report_test
