// tools/deck: what a LIGGGHTS input script says about its scene.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "base/error.hpp"
#include "base/scales.hpp"
#include "deck/hertz.hpp"
#include "deck/mesh_file.hpp"
#include "deck/plan.hpp"
#include "deck/script.hpp"
#include "deck/shielding.hpp"
#include "deck/soften.hpp"

namespace granulaw::deck {
namespace {

/// A folder of its own for each test.
class Deck : public testing::Test
{
 protected:
  void SetUp() override
  {
    folder_ = std::filesystem::temp_directory_path() /
              ("granulaw_deck_" + std::to_string(getpid()) + "_" +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string write(const std::string& name, const std::string& text) const
  {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }
  Scene scene(const std::string& text, const Presets& presets = {}) const
  {
    return read_scene(write("in.deck", text), presets);
  }
  /// Words of every command that the script hands on, joined.
  std::vector<std::string> commands(const std::string& text, const Presets& presets = {})
  {
    std::vector<std::string> result;
    Script script(
        [&](const Command& c) {
          std::string line;
          for (const auto& word : c.words) line += (line.empty() ? "" : " ") + word;
          result.push_back(c.unknown.empty() ? line : "UNKNOWN");
        },
        [](std::string_view name) { return name == "step" ? std::optional(7.0) : std::nullopt; });
    for (const auto& [name, values] : presets) script.preset(name, values);
    script.read(write("in.deck", text));
    notes_ = script.notes();
    return result;
  }

  std::filesystem::path folder_;
  std::vector<std::string> notes_;
};

using Lines = std::vector<std::string>;

double value(const std::string& formula)
{
  return evaluate(formula,
                  [](std::string_view name) { return name == "v_x" ? std::optional(3.0) : std::nullopt; });
}

TEST(Expression, FollowsTheRulesOfLiggghts)
{
  EXPECT_EQ(value("1+2*3"), 7);
  EXPECT_EQ(value("2^3^2"), 64);  // to the left
  EXPECT_EQ(value("-2^2"), 4);    // unary minus first
  EXPECT_EQ(value("-(1-v_x)*2e-1"), 0.4);
  EXPECT_EQ(value("sqrt(16)/ln(exp(2))"), 2);
  EXPECT_EQ(value("1<2&&!(3==4)||0"), 1);
  EXPECT_EQ(value("v_x != 3"), 0);
  EXPECT_DOUBLE_EQ(value("4*atan(1)"), M_PI);
  EXPECT_EQ(value("PI"), M_PI);
}

TEST(Expression, NamesWhatItDoesNotKnow)
{
  for (const char* bad : {"c_ke", "v_y+1", "random(1,2,3)", "1/0", "", "(1", "1 2", "2*", "f_a[2]", "ln(-1)"})
    EXPECT_THROW(value(bad), Unknown) << bad;
  EXPECT_THROW(value(std::string(100000, '(')), Unknown);
  EXPECT_THROW(value(std::string(100000, '-')), Unknown);
}

TEST(Expression, NumbersAreFiniteDecimals)
{
  EXPECT_EQ(number("-1.5e3"), -1500);
  for (const char* bad : {"", "nan", "inf", "0x10", "1a", " 1", "1e999"}) EXPECT_FALSE(number(bad)) << bad;
}

TEST_F(Deck, SubstitutesVariables)
{
  EXPECT_EQ(commands("variable a index 3 4\nvariable bb equal 2*v_a # comment\nvariable s string word\n"
                     "run $a ${bb} $(v_a+step) ${s} &\n  more\nprint \"${bb} # kept\""),
            (Lines{"run 3 6 10 word more", "print ${bb} # kept"}));
  EXPECT_EQ(commands("variable a index 3\nrun $a", {{"a", {"9"}}}), Lines{"run 9"});
  EXPECT_EQ(commands("run ${nothing}"), Lines{"UNKNOWN"});
}

TEST_F(Deck, FollowsLoopsJumpsAndConditions)
{
  EXPECT_EQ(commands("variable k loop 3\nlabel again\nrun $k\nnext k\njump SELF again\nrun 0"),
            (Lines{"run 1", "run 2", "run 3", "run 0"}));
  EXPECT_EQ(commands("variable m index mpm\nif \"${m} == mpm\" then \"run 1\" \"run 2\" else \"run 3\"\n"
                     "if \"1 > 2\" then \"run 4\" elif \"2 > 1\" \"run 5\" else \"run 6\""),
            (Lines{"run 1", "run 2", "run 5"}));
  EXPECT_EQ(commands("jump SELF end\nrun 1\nlabel end\nrun 2"), Lines{"run 2"});
  EXPECT_TRUE(commands("if \"c_ke < 1\" then \"run 1\"").empty());
  ASSERT_EQ(notes_.size(), 1u);
  EXPECT_NE(notes_[0].find("in.deck:1"), std::string::npos);
  write("part", "run 2\n");
  EXPECT_EQ(commands("run 1\ninclude part\nrun 3"), (Lines{"run 1", "run 2", "run 3"}));
}

TEST_F(Deck, EndsWhereADeckDoesNot)
{
  commands("label a\njump SELF a");
  ASSERT_EQ(notes_.size(), 1u);
  EXPECT_THROW(commands("include in.deck"), Error);
  EXPECT_THROW(commands("jump SELF nowhere"), Error);
  EXPECT_THROW(commands("jump missing"), Error);
}

TEST(Geometry, RotatesAsTheRightHandDoes)
{
  const Vec3 p = rotated({1, 0, 0}, {0, 0, 2}, 90);
  EXPECT_NEAR(p[0], 0, 1e-15);  // rounding of cos 90 degrees
  EXPECT_NEAR(p[1], 1, 1e-15);
}

TEST_F(Deck, ReadsMeshes)
{
  const std::string text = write("a.stl",
                                 "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                                 "vertex 0 2 3\nendloop\nendfacet\nendsolid a\n");
  std::string binary(80, ' ');
  binary.replace(0, 5, "solid");  // some writers begin so
  const std::uint32_t one = 1;
  binary.append(reinterpret_cast<const char*>(&one), 4);
  const float triangle[12] = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 2, 3};
  binary.append(reinterpret_cast<const char*>(triangle), sizeof triangle);
  binary.append(2, '\0');
  for (const std::string& path : {text, write("b.stl", binary)}) {
    Box box;
    for (const Vec3& p : mesh_vertices(path)) box.include(p);
    EXPECT_EQ(box.low, (Vec3{0, 0, 0}));
    EXPECT_EQ(box.high, (Vec3{1, 2, 3}));
  }
  EXPECT_THROW(mesh_vertices(write("c.stl", "no mesh")), Error);
  EXPECT_THROW(mesh_vertices(write("d.stl", "vertex 1 nan")), Error);
  // scale, move and rotate act in the order of the line
  const Scene s = scene(
      "units si\nregion r block -9 9 -9 9 -9 9 units box\ncreate_box 1 r\n"
      "fix m all mesh/surface file a.stl type 1 scale 2 move 1 0 0 rotate axis 0 0 1 angle 180\n"
      "fix w all wall/gran model hertz mesh n_meshes 1 meshes m");
  ASSERT_EQ(s.walls.size(), 1u);
  EXPECT_NEAR(s.walls[0].box.low[0], -3, 1e-14);
  EXPECT_NEAR(s.walls[0].box.high[2], 6, 1e-14);
}

/// Spheres of 2 mm that fall from at most 0.2 m; `more` before the run.
std::string falling(const std::string& more,
                    const std::string& insertion = "particles_in_region 100 region bc")
{
  return "units si\nregion reg block -1 1 -1 1 0 1 units box\ncreate_box 2 reg\n"
         "region bc cylinder z 0 0 0.05 0.1 0.2 units box\n"
         "fix m1 all property/global youngsModulus peratomtype 91e6 210e9\n"
         "fix m2 all property/global poissonsRatio peratomtype 0.3 0.3\n"
         "fix g all gravity 9.81 vector 0 0 -2\ntimestep 1e-5\n"
         "fix w all wall/gran model hertz primitive type 2 zplane 0.0\n"
         "fix p all particletemplate/sphere 1 atom_type 1 density constant 1000 radius constant 0.002\n"
         "fix d all particledistribution/discrete 1 1 p 1.0\n"
         "fix ins all insert/pack seed 1 distributiontemplate d vel constant 0 0 -0.5 insert_every once " +
         insertion + "\n" + more + "\nrun 1000\n";
}

TEST_F(Deck, BoundsSpeedsByTheFall)
{
  const Plan plan = make_plan(scene(falling("")), {});
  ASSERT_EQ(plan.pairs.size(), 2u);
  const double v = std::sqrt(0.5 * 0.5 + 2 * 9.81 * 0.2);
  EXPECT_NEAR(plan.pairs[0].speed, 2 * v, 1e-12);
  EXPECT_NEAR(plan.pairs[1].speed, v, 1e-12);
  EXPECT_EQ(plan.particle_steps, 0.5 * 100 * 1000);  // the mean of none before the run and 100 after it
  EXPECT_FALSE(plan.complete());                     // the yield stress is not in the deck
  EXPECT_TRUE(table_command(plan, "m.toml").empty());
}

/// Spheres of radius 1 in a column on the floor z = 0, g = 1; `aside`: of the second one.
Cloud column(std::size_t count, double aside = 0.1)
{
  Cloud c;
  c.radius = 1, c.g = 1;
  for (std::size_t k = 0; k < count; ++k)
    c.centres.push_back({k == 1 ? aside : 0, 0, 2.0 + 2.1 * static_cast<double>(k)});
  return c;
}

TEST(Shielding, ASphereWithNoneBelowLandsUnhindered)
{
  // centres at 2 and 4.1, two diameters aside; bisection to 1e-6
  EXPECT_NEAR(landing_speed(column(2, 4)), std::sqrt(2 * 3.1), 1e-5);
  // through a periodic side it has one below again
  Cloud wrapped = column(2, 6.5);
  wrapped.domain = {{0, 0, 0}, {7, 7, 9}};
  EXPECT_NEAR(landing_speed(wrapped, 1.0), std::sqrt(2 * 3.1), 1e-5);
  wrapped.periodic = {true, true, false};
  // one collision: 2 (1 - u/v) carriers above u, 0.5 of them at 3/4 v
  EXPECT_NEAR(landing_speed(wrapped, 0.5), 0.75 * std::sqrt(2 * 3.1), 1e-5);
}

TEST(Shielding, CarriersOfSpeedAreAsManyAsDiceGive)
{
  constexpr std::size_t m = 4;
  Cloud c = column(m + 1);
  const double u = landing_speed(c, 0.3), lowest = std::sqrt(2.0);
  ASSERT_GT(u, lowest);  // so the lowest sphere takes no part
  std::mt19937 dice(1);
  std::uniform_real_distribution<double> share(0, 1);
  double sum = 0, squares = 0;
  constexpr int runs = 100000;
  for (int r = 0; r < runs; ++r) {
    double count = 0;
    for (std::size_t k = 1; k <= m; ++k) {
      std::vector<double> speeds{std::sqrt(2 * (1 + 2.1 * static_cast<double>(k)))};
      for (std::size_t hit = 0; hit < k; ++hit) {
        std::vector<double> next;
        for (const double v : speeds) {
          const double x = share(dice);
          next.push_back(x * v), next.push_back((1 - x) * v);
        }
        speeds = next;
      }
      for (const double v : speeds) count += v > u;
    }
    sum += count, squares += count * count;
  }
  const double mean = sum / runs, error = std::sqrt((squares / runs - mean * mean) / runs);
  EXPECT_NEAR(mean, 0.3, 4 * error);  // one of 16,000 correct programs fails; the dice are the same each time
  EXPECT_LT(error, 0.003);
}

/// A data file of 200 spheres of radius 2 mm, 5 mm apart in height, aside by `aside(k)` m in x and
/// y.
std::string tube(const std::function<std::array<double, 2>(int)>& aside)
{
  std::string text =
      "cloud\n\n200 atoms\n1 atom types\n0 0.03 xlo xhi\n0 0.03 ylo yhi\n0 1 zlo zhi\n\nAtoms\n\n";
  for (int k = 1; k <= 200; ++k) {
    const auto [x, y] = aside(k);
    text += std::to_string(k) + " 1 0.004 1000 " + std::to_string(0.015 + x) + " " +
            std::to_string(0.015 + y) + " " + std::to_string(0.005 * k) + "\n";
  }
  return text;
}

TEST_F(Deck, ACloudShieldsItsFloor)
{
  std::mt19937 dice(1);
  std::uniform_real_distribution<double> anywhere(-0.012, 0.012);
  write("cloud", tube([&](int) { return std::array{anywhere(dice), anywhere(dice)}; }));
  const std::string more =
      "units si\nread_data cloud\nfix m1 all property/global youngsModulus peratomtype 91e6 210e9\n"
      "fix m2 all property/global poissonsRatio peratomtype 0.3 0.3\nfix g all gravity 9.81 vector 0 0 -1\n"
      "fix w all wall/gran model hertz primitive type 2 zplane 0.0\n";
  const double fall = std::sqrt(2 * 9.81 * 1.0);
  const auto wall = [&](const std::string& text) { return make_plan(scene(text), {}).pairs[1]; };
  EXPECT_EQ(wall(more).speed_basis, "shielded fall");
  EXPECT_LT(wall(more).speed, 0.9 * fall);
  EXPECT_NEAR(make_plan(scene(more), {}).pairs[0].speed, 2 * fall, 1e-12);  // of pairs as ever
  // what it is not made for: one bound for all, as without it
  for (const char* other :
       {"velocity all set 0 0 -0.1\n", "set atom 3 diameter 0.006\n", "set atom 3 density 2000\n",
        "create_atoms 1 single 0 0 0.1\n", "fix w2 all wall/gran model hertz primitive type 2 zplane -0.1\n",
        "fix w2 all wall/gran model hertz primitive type 2 zcylinder 0.1 0 0\n"})
    EXPECT_EQ(wall(more + other).speed_basis, "fall") << other;
  // in line they hand the whole fall on
  write("cloud", tube([](int) { return std::array{0.0, 0.0}; }));
  EXPECT_EQ(wall(more).speed_basis, "fall");
  write("cloud", tube([&](int) { return std::array{anywhere(dice), anywhere(dice)}; }));
  // a wall along gravity may be hit by anything; the floor under it stays shielded
  const Plan sides =
      make_plan(scene(more + "fix w2 all wall/gran model hertz primitive type 3 xplane 0.0\n"), {});
  EXPECT_EQ(sides.pairs[1].speed_basis, "shielded fall");
  EXPECT_EQ(sides.pairs[2].speed_basis, "fall");
}

TEST_F(Deck, MovingWallsAddTheirSpeed)
{
  write("a.stl", "vertex 0 0 0 vertex 0.1 0 0 vertex 0 0.1 0");
  const std::string mesh =
      "fix mesh all mesh/surface file a.stl type 2\n"
      "fix w2 all wall/gran model hertz mesh n_meshes 1 meshes mesh\nfix mv all move/mesh mesh mesh ";
  const auto speed = [&](const std::string& motion) { return scene(falling(mesh + motion)).walls[1].speed; };
  EXPECT_NEAR(speed("linear 3 4 0"), 5, 1e-12);
  EXPECT_NEAR(speed("wiggle amplitude 0 0 0.01 period 0.1"), 0.01 * 2 * M_PI / 0.1, 1e-12);
  EXPECT_NEAR(speed("rotate origin 0 0 0 axis 0 0 1 period 2"), M_PI * std::sqrt(0.02), 1e-12);
  // 1000 steps of 1e-5 s at 5 m/s: the mesh, and what lies on it, rises by 0.05 m
  EXPECT_NEAR(scene(falling(mesh + "linear 0 0 5")).walls[1].box.high[2], 0.05, 1e-12);
  const Scene unknown = scene(falling(mesh + "linear/variable v_x v_y v_z"));
  EXPECT_EQ(unknown.unknown_speeds.size(), 1u);
}

TEST_F(Deck, KeepsWhatARunVisitedByTypes)
{
  const auto entry = [](const std::string& kind, int a, int b, double speed, double overlap, double inertia) {
    return "{\"kind\": \"" + kind + "\", \"types\": [" + std::to_string(a) + ", " + std::to_string(b) +
           "], \"contacts_begun\": 2, \"impact_speed_max_m_per_s\": " + std::to_string(speed) +
           ", \"overlap_over_radius_max\": " + std::to_string(overlap) +
           ", \"inertia_number_max\": " + std::to_string(inertia) + "}";
  };
  const Visited v =
      read_visited(write("s.json", "{\"pairs\": [" + entry("particles", 1, 2, 0.5, 0.25, 0.125) + ", " +
                                       entry("particles", 3, 2, 1.5, 0.75, 0.375) + ", " +
                                       entry("rigid wall", 2, 1, 4, 0.5, 0.0625) + ", " +
                                       entry("deformable wall", 2, 1, 2, 0.625, 0.03125) + "]}"));
  ASSERT_EQ(v.pairs.size(), 2u);
  ASSERT_EQ(v.walls.size(), 1u);
  const auto expect = [](const Visited::Range& r, double speed, double overlap, double inertia) {
    EXPECT_EQ(r.speed, speed);
    EXPECT_EQ(r.overlap, overlap);
    EXPECT_EQ(r.inertia, inertia);
    EXPECT_TRUE(r.met);
  };
  expect(v.pairs.at({1, 2}), 0.5, 0.25, 0.125);
  expect(v.pairs.at({2, 3}), 1.5, 0.75, 0.375);
  expect(v.walls.at({2, 1}), 4, 0.625, 0.0625);  // both walls of a type are one meeting: the larger of each
}

TEST_F(Deck, KnowsEveryRegion)
{
  struct Case
  {
    std::string text;
    double volume;
    Vec3 low, high;
  };
  const double cone = M_PI / 3 * (0.03 * 0.03 + 0.03 * 0.06 + 0.06 * 0.06) * 0.1;
  const std::string two =
      "region a block 0 0.3 0 0.2 0.1 0.2 units box\nregion b block 0.1 0.5 -0.2 0.1 0 0.15 units "
      "box\nregion r ";
  for (const Case& c :
       {Case{"region r block 0 0.1 -0.2 0.2 0.3 0.4 units box", 0.004, {0, -0.2, 0.3}, {0.1, 0.2, 0.4}},
        Case{"region r block EDGE 0 -0.5 EDGE INF INF units box", 1.5, {-1, -0.5, 0}, {0, 1, 1}},
        Case{"region r cylinder x 0.1 0.5 0.05 0.2 0.4 units box",
             M_PI * 0.0005,
             {0.2, 0.05, 0.45},
             {0.4, 0.15, 0.55}},
        Case{"region r cylinder y 0.1 0.5 0.05 0.2 0.4 units box",
             M_PI * 0.0005,
             {0.05, 0.2, 0.45},
             {0.15, 0.4, 0.55}},
        Case{"region r cone z 0.1 0.2 0.03 0.06 0.5 0.6 units box",
             cone,
             {0.04, 0.14, 0.5},
             {0.16, 0.26, 0.6}},
        Case{"region r sphere 0.1 0.2 0.5 0.1 units box",
             4.0 / 3.0 * M_PI * 1e-3,
             {0, 0.1, 0.4},
             {0.2, 0.3, 0.6}},
        Case{two + "union 2 a b", 0.3 * 0.2 * 0.1 + 0.4 * 0.3 * 0.15, {0, -0.2, 0}, {0.5, 0.2, 0.2}},
        Case{two + "intersect 2 a b", 0.2 * 0.1 * 0.05, {0.1, 0, 0.1}, {0.3, 0.1, 0.15}}}) {
    std::string text = falling("", "volumefraction_region 0.3 region r");
    text.insert(text.find("fix m1"), c.text + "\n");
    const Scene s = scene(text);
    ASSERT_EQ(s.sources.size(), 1u) << c.text;
    EXPECT_NEAR(s.count() / (0.3 * c.volume / (4.0 / 3.0 * M_PI * 8e-9)), 1, 1e-12) << c.text;  // rounding
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(s.sources[0].centres.low[k], c.low[k], 1e-15) << c.text;
      EXPECT_NEAR(s.sources[0].centres.high[k], c.high[k], 1e-15) << c.text;
    }
  }
}

TEST_F(Deck, CountsInsertedParticles)
{
  const double ball = 4.0 / 3.0 * M_PI * 8e-9, region = M_PI * 0.05 * 0.05 * 0.1;
  EXPECT_NEAR(scene(falling("", "volumefraction_region 0.3 region bc")).count(), 0.3 * region / ball, 1e-6);
  EXPECT_EQ(scene(falling("", "nparticles 5000 particlerate 1000 region bc")).count(),
            10);  // 1000/s over 0.01 s
  EXPECT_NEAR(scene(falling("", "mass 0.1 massrate 100 region bc")).count(), 0.1 / (1000 * ball), 1e-6);
}

TEST_F(Deck, ReadsDataAndSet)
{
  write("cloud",
        "Atoms of a cloud\n\n2 atoms\n2 atom types\n-1 2 xlo xhi\n-3 4 ylo yhi\n-5 6 zlo zhi\n\nAtoms\n\n"
        "1 1 0.002 900 0.5 0.5 0.1\n2 1 0.004 800 0.6 0.4 0.7\n");
  const Scene s = scene("units si\nread_data cloud");
  ASSERT_EQ(s.sources.size(), 1u);
  EXPECT_EQ(s.sources[0].radius_min, 0.001);
  EXPECT_EQ(s.sources[0].radius_max, 0.002);
  EXPECT_EQ(s.sources[0].centres.low, (Vec3{0.5, 0.4, 0.1}));
  EXPECT_EQ(s.sources[0].centres.high, (Vec3{0.6, 0.5, 0.7}));
  EXPECT_EQ(s.sources[0].density, 900);
  EXPECT_EQ(s.domain.low, (Vec3{-1, -3, -5}));
  EXPECT_EQ(s.domain.high, (Vec3{2, 4, 6}));
  EXPECT_EQ(s.types, 2);
  EXPECT_EQ(s.count(), 2);
  EXPECT_EQ(s.sources[0].speed, 0);
  write("moving",
        "title\n\n2 atoms\n\nAtoms\n\n1 1 0.002 900 0 0 0\n2 2 0.002 900 1 0 0\n\nVelocities\n\n"
        "1 0 0 0.5 0 0 0\n2 3 0 -4 0 9 0\n");
  const Scene m = scene("units si\nread_data moving");
  ASSERT_EQ(m.sources.size(), 2u);
  EXPECT_EQ(m.sources[0].speed, 0.5);
  EXPECT_EQ(m.sources[1].speed, 5);
  write("stranger", "title\n\n1 atoms\n\nAtoms\n\n1 1 0.002 900 0 0 0\n\nVelocities\n\n7 0 0 1 0 0 0\n");
  EXPECT_THROW(scene("units si\nread_data stranger"), Error);
  write("bad", "title\n\n1 atoms\n\nAtoms\n\n1 1 0.002\n");
  EXPECT_THROW(scene("read_data bad"), Error);
  EXPECT_THROW(scene("read_data missing"), Error);
  const Scene t = scene("units cgs\ncreate_atoms 1 single 1 2 3\nset atom 1 diameter 0.4 density 2 vx 10");
  ASSERT_EQ(t.sources.size(), 1u);  // cgs: cm, g/cm^3, cm/s
  EXPECT_DOUBLE_EQ(t.sources[0].radius_max, 0.002);
  EXPECT_DOUBLE_EQ(t.sources[0].density, 2000);
  EXPECT_DOUBLE_EQ(t.sources[0].speed, 0.1);
}

TEST_F(Deck, RefusesOtherUnits)
{
  EXPECT_THROW(scene("units lj"), Error);
  EXPECT_THROW(scene("run 1"), Error);  // LIGGGHTS's default is lj
}

TEST_F(Deck, HertzSufficesBelowTheOnset)
{
  PlanOptions options;
  options.materials[1] = {"wax", 1000, 91e6, 0.3, 1e6, 0};
  const double onset = onset_velocity(1e8, 1e6, 1000, 0.3);
  for (const double factor : {0.999, 1.001}) {
    options.speed = factor * onset;
    const Plan plan = make_plan(scene(falling("")), options);
    EXPECT_NEAR(plan.pairs[1].onset / onset, 1, 1e-12);
    EXPECT_NEAR(plan.pairs[0].onset / onset, 2, 1e-12);  // each sphere of a pair takes half of the speed
    EXPECT_EQ(plan.pairs[1].needs_table, factor > 1);
    EXPECT_FALSE(plan.pairs[0].needs_table);
    EXPECT_EQ(table_command(plan, "m.toml").empty(), factor < 1);
  }
}

TEST_F(Deck, TakesWhatWasVisited)
{
  PlanOptions options;
  options.materials[1] = {"wax", 1000, 91e6, 0.3, 1e6, 0};
  const Scene s = scene(falling(""));
  const std::string both =
      R"("pair": {"contacts_begun": 9, "impact_speed_max_m_per_s": 1.0, "overlap_over_radius_max": 0.5},
                              "wall": {"contacts_begun": 0, "impact_speed_max_m_per_s": 0})";
  const Visited old = read_visited(write("old.json", "{" + both + "}"));
  const Plan plan = make_plan(s, options, &old);
  EXPECT_DOUBLE_EQ(plan.pairs[0].speed, visited_margin);
  EXPECT_DOUBLE_EQ(plan.pairs[0].overlap, 0.5 * visited_margin);
  EXPECT_FALSE(plan.pairs[1].visited);
  EXPECT_EQ(table_command(plan, "m.toml").find("wax:wall"), std::string::npos);
  const Visited now = read_visited(write(
      "now.json", "{" + both + R"(, "pairs": [{"kind": "rigid wall", "types": [1, 2], "contacts_begun": 3,
                                          "impact_speed_max_m_per_s": 0.4}]})"));
  const Plan by_pair = make_plan(s, options, &now);
  EXPECT_FALSE(by_pair.pairs[0].visited);
  EXPECT_DOUBLE_EQ(by_pair.pairs[1].speed, 0.4 * visited_margin);
  EXPECT_THROW(read_visited(write("bad.json", "[1")), Error);
  EXPECT_THROW(read_visited(write("none.json", "{}")), Error);
}

TEST_F(Deck, DeformableWallsAreBodiesOfTheirMaterial)
{
  PlanOptions options;
  options.materials[1] = {"steel", 7800, 2e11, 0.3, 1e9, 0};
  options.materials[2] = {"wax", 1000, 91e6, 0.3, 1e6, 0};
  std::string text = falling("");
  const std::size_t primitive = text.find("primitive");
  ASSERT_NE(primitive, std::string::npos);
  text.insert(text.find('\n', primitive), " wall deformable");
  const Plan plan = make_plan(scene(text), options), rigid = make_plan(scene(falling("")), options);
  const Meeting& wall = plan.pairs[1].meeting;
  EXPECT_TRUE(wall.wall && wall.deformable);
  EXPECT_EQ(wall.name_b, "wax");
  EXPECT_EQ(wall.yields.name, "wax");  // the weaker: the wall
  EXPECT_EQ(rigid.pairs[1].meeting.name_b, "wall");
  EXPECT_EQ(rigid.pairs[1].meeting.yields.name, "steel");
  EXPECT_LT(plan.pairs[1].onset, rigid.pairs[1].onset);
  // as Hertz has it, 1/E* = 1/E*_s + 1/E*_h
  EXPECT_NEAR(wall.mapping.e_star_pair() * (1 / wall.yields.e_star() + 0.91 / 2e11), 1, 1e-12);
  EXPECT_EQ(radius_ratio(plan, wall), largest_radius_ratio);
  EXPECT_EQ(radius_ratio(plan, rigid.pairs[1].meeting), 1);
}

TEST_F(Deck, AStretchedDeckHasLongerStepsAndTheSameOverlapsInItsLaw)
{
  PlanOptions options;
  options.materials[1] = {"wax", 1000, 91e6, 0.3, 1e6, 0};
  const std::string style =
      "pair_style gran model mpm tangential history law x.h5 materials wax wax stretch 4\n";
  const Scene plain = scene(falling("")), stretched = scene(style + falling(""));
  ASSERT_EQ(stretched.stretch, 4);
  const Plan a = make_plan(plain, options), b = make_plan(stretched, options);
  EXPECT_DOUBLE_EQ(b.time_step, 4 * a.time_step);
  EXPECT_DOUBLE_EQ(b.depth, a.depth);
  const Visited run = read_visited(write(
      "run.json",
      R"({"pair": {"contacts_begun": 9, "impact_speed_max_m_per_s": 0.01, "overlap_over_radius_max": 0.6},
                      "wall": {"contacts_begun": 0, "impact_speed_max_m_per_s": 0}})"));
  EXPECT_DOUBLE_EQ(make_plan(stretched, options, &run).pairs[0].overlap, visited_margin * 0.6 / 4);
  // another stretch takes the place of the deck's
  const SoftenLimits limits{0.5, 10, 1e6, 0.01, 0.6};
  const Softening once = soften(plain, a, options, limits), again = soften(stretched, b, options, limits);
  EXPECT_DOUBLE_EQ(again.stretch, once.stretch);
  EXPECT_DOUBLE_EQ(4 * again.time_step, once.time_step);  // both decks say 1e-5 s
}

TEST(Hertz, ConservesEnergy)
{
  const double e = 1e8, r = 0.002, m = 1e-4, v = 0.3, d = hertz_overlap(e, r, m, v);
  EXPECT_NEAR(8.0 / 15 * e * std::sqrt(r) * std::pow(d, 2.5) / (0.5 * m * v * v), 1, 1e-12);  // rounding
  // K. L. Johnson: 2.87 (m^2/(R E^2 V))^0.2, his factor in three digits
  EXPECT_NEAR(hertz_time(e, r, m, v) / (2.87 * std::pow(m * m / (r * e * e * v), 0.2)), 1, 2e-3);
}

TEST_F(Deck, SoftensWithinEachLimit)
{
  PlanOptions options;
  options.materials[1] = {"wax", 1000, 91e6, 0.3, 1e6, 0};
  const Scene s = scene(falling(""));
  const Plan plan = make_plan(s, options);
  SoftenLimits limits{0.5, 10, 1e6, 0.01, 0.6};
  const auto all = [&] { return soften(s, plan, options, limits); };
  const Softening by_overlap = all();
  EXPECT_LE(by_overlap.overlap, 0.5);
  EXPECT_GT(1.1 * by_overlap.overlap, 0.5);  // two digits of s
  EXPECT_DOUBLE_EQ(by_overlap.time_step, by_overlap.stretch * 1e-5);
  limits.static_load = 0.05;
  const Softening by_static = all();
  EXPECT_TRUE(by_static.stretch == 1 || by_static.static_ratio <= 0.05) << by_static.static_ratio;
  EXPECT_LE(by_static.stretch, by_overlap.stretch);
  limits = {0.5, 0.001, 1e6, 0.01, 0.6};
  EXPECT_EQ(all().stretch, 1);  // never below: the law itself
  ASSERT_FALSE(by_overlap.naive.empty());
  EXPECT_GT(by_overlap.naive[0].e_naive, by_overlap.naive[0].e);  // a softer sphere yields less
}

/// Each number by its definition in soften.hpp, for spheres of R = 2 mm and wax that yields.
TEST_F(Deck, SoftenStatesItsNumbers)
{
  PlanOptions options;
  options.materials[1] = {"wax", 1000, 91e6, 0.3, 1e6, 0};
  options.materials[2] = {"steel", 7800, 210e9, 0.3, 1e9, 0};
  const Scene s = scene(falling(""));
  const Plan plan = make_plan(s, options);
  const double r = 0.002, d = 2 * r, g = 9.81, rho = 1000, ball = 4.0 / 3.0 * M_PI * r * r * r;
  const double rounding = 1e-12;
  SoftenLimits limits{0.3, 0.2, 1e6, 0, 0.6};
  const Softening own = soften(s, plan, options, limits);
  EXPECT_NEAR(own.fill_height / (100 * ball / 0.6 / 4), 1, rounding);  // 100 spheres on 2 m by 2 m
  EXPECT_NEAR(own.flow_time / std::sqrt(d / g), 1, rounding);
  ASSERT_EQ(own.pairs.size(), 2u);
  for (const PairStretch& q : own.pairs) {
    const double r_eff = q.pair->meeting.wall ? r : r / 2, m_eff = r_eff / r * rho * ball;
    const double speed = std::sqrt(2 * g * d), e_star = q.pair->meeting.mapping.e_star_pair();
    EXPECT_NEAR(q.slow_speed / speed, 1, rounding);  // a fall through one diameter
    EXPECT_NEAR(q.contact_time / hertz_time(e_star, r_eff, m_eff, speed), 1, rounding);
    EXPECT_NEAR(q.by_time / (0.2 * own.flow_time / q.contact_time), 1, rounding);
    EXPECT_NEAR(q.by_overlap / (0.3 / q.pair->overlap), 1, rounding);
    EXPECT_NEAR(q.static_load / (0.6 * rho * g * own.fill_height * d * d), 1, rounding);
    EXPECT_NEAR(q.by_static / (1e6 * q.yield_load / q.static_load), 1, rounding);
    // Hertz at the onset: the largest contact pressure 3 F/(2 pi a^2), a^2 = R* delta, is C(nu) Y
    const double force_per_area = 3 * q.yield_load / (2 * M_PI * r_eff);
    const double overlap = std::pow(q.yield_load / (4.0 / 3.0 * e_star * std::sqrt(r_eff)), 2.0 / 3.0);
    EXPECT_NEAR(force_per_area / overlap / (1.295 * std::exp(0.736 * 0.3) * 1e6), 1, rounding);
  }
  // a bed so high that its foot yields: the set is the load beyond yield over pi p_y R*, p_y = 1.6 Y, over R*
  limits = {0.5, 10, 1e6, 20, 0.6};
  const Softening high = soften(s, plan, options, limits);
  double ratio = 0, set = 0;
  for (const PairStretch& q : high.pairs) {
    const double r_eff = q.pair->meeting.wall ? r : r / 2, load = high.stretch * q.static_load;
    ratio = std::max(ratio, load / q.yield_load);
    set = std::max(set, high.stretch * (load - q.yield_load) / (M_PI * 1.6 * 1e6 * r_eff * r_eff));
  }
  ASSERT_GT(ratio, 1);
  EXPECT_NEAR(high.static_ratio / ratio, 1, rounding);
  EXPECT_NEAR(high.extra_set / set, 1, rounding);
  // the stretch is the smallest bound, rounded down to two digits
  for (double overlap = 0.2; overlap < 0.4; overlap *= 1.003) {
    limits = {overlap, 10, 1e6, 0.01, 0.6};
    const Softening at = soften(s, plan, options, limits);
    const double bound = std::min(at.pairs[0].by_overlap, at.pairs[1].by_overlap);
    ASSERT_GT(bound, 1);
    EXPECT_LE(at.stretch, bound * (1 + 1e-11))
        << overlap;  // a bound of two digits itself is not rounded: 1e-12
    EXPECT_GT(at.stretch * 1.1, bound) << overlap;
    const double digits = at.stretch / std::pow(10.0, std::floor(std::log10(at.stretch * (1 + 1e-9))) - 1);
    EXPECT_NEAR(digits, std::round(digits), 1e-9) << overlap;
  }
}

}  // namespace
}  // namespace granulaw::deck
