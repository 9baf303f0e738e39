#include "run_request.hpp"

#include "scratch_folder.hpp"

namespace granulaw::run_request_test {

class RunRequestTest : public ScratchFolder
{
};

TEST_F(RunRequestTest, WhatCannotBeUsedIsSaidFirst)
{
  const auto refuses = [&](const std::string& part, const std::function<void(RunRequest&)>& spoil) {
    RunRequest r;
    spoil(r);
    expect_error(part, [&] { r.check(); });
  };
  EXPECT_EQ(sentence_of([] { RunRequest{}.check(); }), "");
  refuses("--grid: unknown grid: found round, allowed is auto, mapped", [](auto& r) { r.grid = "round"; });
  refuses("--precision", [](auto& r) { r.precision = "half"; });
  refuses("--wall: cannot go with --against", [](auto& r) { r.wall = r.against = "x"; });
  refuses("--courant: explicit time stepping is unstable above 1", [](auto& r) { r.courant = 1.1; });
  refuses("--courant: cannot be used: found 0, allowed is 0.05 to 1", [](auto& r) { r.courant = 0; });
  refuses("--shifted-grids", [](auto& r) { r.shifted_grids = 65; });
  refuses("--tolerance: cannot be used: found 0.6", [](auto& r) { r.tolerance = 0.6; });
  refuses("--resolution", [](auto& r) { r.resolution = 5; });
  refuses(".csv, .h5", [](auto& r) { r.output = "t.txt"; });
  refuses("--checkpoint: cannot go with --fields", [&](auto& r) {
    r.checkpoint = path("c");
    r.fields = path("f.xdmf");
  });
  refuses("--checkpoint: would be the file of the trace",
          [&](auto& r) { r.checkpoint = r.output = path("t.csv"); });
  refuses("--fields: its HDF5 file would be the trace's", [&](auto& r) {
    r.fields = path("f.xdmf");
    r.output = path("f.h5");
  });
}

TEST_F(RunRequestTest, BecomesTheSolversOptions)
{
  RunRequest r;
  EXPECT_EQ(r.options(false).resolution, 0);
  EXPECT_TRUE(r.options(false).estimate_error);
  EXPECT_EQ(r.options(false).shifted_grids, 4);
  EXPECT_EQ(r.options(true).shifted_grids, 1);  // a certificate over orientations has one, too
  r.resolution = 12;
  r.grid = "rectilinear";
  r.precision = "single";
  r.no_estimate = true;
  r.jobs = 3;
  r.shifted_grids = 2;
  r.courant = 0.5;
  const RunOptions options = r.options(false);
  EXPECT_EQ(options.resolution, 12);
  EXPECT_EQ(options.grid, GridKind::rectilinear);
  EXPECT_EQ(options.precision, Precision::single);
  EXPECT_FALSE(options.estimate_error);
  EXPECT_EQ(options.threads, 3);
  EXPECT_EQ(options.shifted_grids, 2);
  EXPECT_EQ(options.courant, 0.5);
}

TEST_F(RunRequestTest, FindsWhatMeets)
{
  RunRequest r;
  r.materials = write("m.toml",
                      "[material.a]\ndensity = 1000\nyoungs_modulus = 1e9\npoisson_ratio = 0.3\n"
                      "[particle.small]\nradius = 1e-3\nmaterial = \"a\"\n"
                      "[particle.large]\nradius = 2e-3\nmaterial = \"a\"\n");
  r.particle = "small";
  Meeting m = read_meeting(r);
  EXPECT_EQ(m.particle.radius, 1e-3);
  EXPECT_FALSE(m.partner.particle || m.partner.wall);
  EXPECT_EQ(grid_name(r, m.particle), "mapped");
  r.grid = "updated";
  EXPECT_EQ(grid_name(r, m.particle), "updated");
  r.against = "large";
  EXPECT_EQ(read_meeting(r).partner.particle->radius, 2e-3);
  r.against = "";
  r.wall = "a";
  EXPECT_EQ(read_meeting(r).partner.wall->density, 1000);
  r.particle = "smal";
  expect_error("did you mean 'small'", [&] { read_meeting(r); });
}

}  // namespace granulaw::run_request_test
