#include "run_report.hpp"

#include <nlohmann/json.hpp>

#include "scratch_folder.hpp"
#include "some_materials.hpp"
#include "some_runs.hpp"

namespace granulaw::run_report_test {

class RunReport : public ScratchFolder
{
 protected:
  static std::string printed(const std::function<void()>& what)
  {
    testing::internal::CaptureStdout();
    what();
    return testing::internal::GetCapturedStdout();
  }
  const Particle grain_ = Particle::sphere(2e-3, soft_powder());
  RunRequest request_;
};

TEST_F(RunReport, TellsTheSettingToPeopleOnly)
{
  const std::string impact = printed([&] { print_setting(request_, grain_, 2.6); });
  EXPECT_TRUE(impact.starts_with("sphere of 0.002 m radius, E* = 3e+09 Pa, E*/Y = 30, yield velocity V_y"));
  EXPECT_NE(impact.find("V/V_y = "), std::string::npos);
  EXPECT_NE(impact.find("\ngrid: mapped ("), std::string::npos);
  EXPECT_EQ(printed([&] { print_setting(request_, grain_, 0); }).find("V/V_y = "), std::string::npos);
  request_.grid = "rectilinear";
  EXPECT_TRUE(
      printed([&] { print_setting(request_, grain_, 0); }).ends_with("grid: rectilinear, as asked\n"));
  request_.json = true;
  EXPECT_EQ(printed([&] { print_setting(request_, grain_, 2.6); }), "");
}

TEST_F(RunReport, WritesTheTraceAndSaysSo)
{
  request_.output = path("t.csv");
  const std::string said = printed([&] { report(request_, {grain_, {}}, some_result(1)); });
  EXPECT_TRUE(said.starts_with("coefficient of restitution e   0.1429\n")) << said;
  EXPECT_TRUE(said.ends_with("wrote " + path("t.csv") + "\n")) << said;
  EXPECT_EQ(files(), 1u);
}

TEST_F(RunReport, JsonIsOneObject)
{
  request_.json = true;
  const auto out = nlohmann::ordered_json::parse(printed([&] { report(request_, {grain_, {}}, some_result(1)); }));
  EXPECT_EQ(out["steps"], 12345);
  EXPECT_EQ(out["grid"], "mapped");
  EXPECT_TRUE(out["error_estimate"].is_null());
  for (const char* key : {"resolution", "grids", "energy_error", "ripple", "e_raw", "plastic_strain_max",
                          "contact_loss", "hourglass"})
    EXPECT_TRUE(out.contains(key)) << key;
}

}  // namespace granulaw::run_report_test
