#include "deck/scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "deck_fixture.hpp"

namespace granulaw::deck {
namespace {

using DeckScene = Deck;

TEST_F(DeckScene, RefusesOtherUnits)
{
  EXPECT_THROW(scene("units lj"), Error);
  EXPECT_THROW(scene("run 1"), Error);  // LIGGGHTS's default is lj
}

/// Every quantity of a deck in cm, g, s (pressure: 0.1 Pa) in SI.
TEST_F(DeckScene, ConvertsCgs)
{
  std::string si = falling("fix y all property/global yieldStress peratomtype 1e6 1e9");
  std::string cgs = si;
  const auto swap = [&](const std::string& of_si, const std::string& of_cgs) {
    const std::size_t at = cgs.find(of_si);
    ASSERT_NE(at, std::string::npos) << of_si;
    cgs.replace(at, of_si.size(), of_cgs);
  };
  swap("units si", "units cgs");
  swap("block -1 1 -1 1 0 1", "block -100 100 -100 100 0 100");
  swap("z 0 0 0.05 0.1 0.2", "z 0 0 5 10 20");
  swap("91e6 210e9", "91e7 210e10");
  swap("gravity 9.81", "gravity 981");
  swap("density constant 1000 radius constant 0.002", "density constant 1 radius constant 0.2");
  swap("constant 0 0 -0.5", "constant 0 0 -50");
  swap("1e6 1e9", "1e7 1e10");
  const Scene a = scene(si), b = scene(cgs);
  const auto same = [](double x, double y) { EXPECT_NEAR(x, y, 1e-14 * std::abs(x)); };  // rounding
  const auto same_box = [&](const Box& x, const Box& y) {
    for (std::size_t k = 0; k < 3; ++k) same(x.low[k], y.low[k]), same(x.high[k], y.high[k]);
  };
  same(a.gravity[2], b.gravity[2]);
  same_box(a.domain, b.domain);
  same(*a.materials.at(2).youngs_modulus, *b.materials.at(2).youngs_modulus);
  same(*a.materials.at(2).yield_stress, *b.materials.at(2).yield_stress);
  same(a.sources[0].radius_max, b.sources[0].radius_max);
  same(a.sources[0].density, b.sources[0].density);
  same(a.sources[0].speed, b.sources[0].speed);
  same_box(a.sources[0].centres, b.sources[0].centres);
  same_box(a.walls[0].box, b.walls[0].box);
  EXPECT_EQ(a.count(), b.count());
  EXPECT_EQ(a.time_step, b.time_step);
}

}  // namespace
}  // namespace granulaw::deck
