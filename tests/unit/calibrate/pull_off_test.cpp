// Work of adhesion from pull-off forces.
#include "calibrate/pull_off.hpp"

#include <gtest/gtest.h>

#include "atlas/law_from_atlas.hpp"
#include "base/error.hpp"
#include "characterise/atlas_file.hpp"
#include "contact/adhesion.hpp"

namespace granulaw::pull_off_test {

TEST(PullOff, GivesTheWorkThatMadeTheForces)
{
  const BodyLaw body = law_from(read_atlas(GRANULAW_ATLAS_FILE), {"m", 1500, 9.1e9, 0.3, 1e8, 0}, {.depth = 0.3});
  const PairLaw pair{{&body.curve, PairMapping::rigid_partner(1e10)}, &body};
  const Tabulated law(pair, pair.measure(), {});
  constexpr double work = 0.02, range = 0.6e-9;
  const auto made = [&](double more, double radius = 100e-6) {
    std::vector<PullOff> data;
    for (const double depth : {0.005, 0.01, 0.02, 0.04, 0.08}) {
      const double preload = law.loading(radius, depth * radius, 0.0);
      data.push_back({preload, DentAdhesion(law, work, range).pull_off(law, radius, depth * radius) * std::pow(preload / 1e-4, more)});
    }
    return data;
  };
  const FoundAdhesion found = fit_adhesion(pair, 100e-6, made(0), range, "data");
  EXPECT_NEAR(found.work / work, 1, 1e-6);  // bisection
  EXPECT_LT(found.scatter, 1e-6);
  // the law's error, of a force that grows nearly as w: a quarter at chi of 3e-4, 0.12 at 0.03
  EXPECT_NEAR(std::log(found.high / found.low), 0.5, 0.1);
  const FoundAdhesion fine = fit_adhesion(pair, 0.5e-6, made(0, 0.5e-6), range, "data");
  EXPECT_NEAR(std::log(fine.high / fine.low), 0.24, 0.05);
  // the best w is another, of which pull-off forces of small dents are a higher power
  EXPECT_NEAR(fit_adhesion(pair, 100e-6, made(-0.3), range, "data").trend, -0.3, 0.04);
  EXPECT_THROW(fit_adhesion(pair, 100e-6, {{1e3, 1e-6}}, range, "data"), Error);
  EXPECT_THROW(fit_adhesion(pair, 100e-6, made(0), 0.2e-9, "data"), Error);  // as strong as the material
}

TEST(PullOff, IsReadFromTwoColumns)
{
  const auto data = parse_pull_offs("preload_N,pull_off_N\n1e-6,2e-7\n", "x.csv");
  ASSERT_EQ(data.size(), 1);
  EXPECT_EQ(data[0].pull_off, 2e-7);
  for (const char* text : {"preload_N,force\n1,2\n", "preload_N,pull_off_N\n1,-2\n", "preload_N,pull_off_N\n", "preload_N,pull_off_N\n1\n"})
    EXPECT_THROW(parse_pull_offs(text, "x.csv"), Error) << text;
}

}  // namespace granulaw::pull_off_test
