// Checkpoints on disk: what comes back, and every file that is refused and left as it is.
#include "run_files/checkpoint_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "scratch_folder.hpp"

namespace granulaw::checkpoint_file_test {

namespace fs = std::filesystem;

class CheckpointFileTest : public ScratchFolder
{
 protected:
  /// A file with two states, as a killed run leaves it.
  std::string written()
  {
    CheckpointFile file(path_, 0, asked_);
    EXPECT_FALSE(file.was_found());
    file.store().save("a", "state of a");
    file.store().save("b", std::string("b\0\n", 3));
    return read(path_);
  }
  /// Message about a file of these bytes; it must not be touched.
  std::string said_about(const std::string& bytes, const RunIdentity& asked)
  {
    write("run.checkpoint", bytes);
    const std::string said = sentence_of([&] { CheckpointFile(path_, 0, asked); });
    EXPECT_EQ(read(path_), bytes);
    return said;
  }

  const std::string path_ = path("run.checkpoint");
  const RunIdentity asked_{
      {"command", "impact"}, {"--velocity", "1"}, {"particle's materials", std::string(50, 'x')}};
};

TEST_F(CheckpointFileTest, GivesBackWhatWasSaved)
{
  written();
  EXPECT_EQ(files(), 1u);
  CheckpointFile file(path_, 30, asked_);
  EXPECT_TRUE(file.was_found());
  const CheckpointStore store = file.store();
  EXPECT_EQ(store.name, path_);
  EXPECT_EQ(store.load("a"), "state of a");
  EXPECT_EQ(store.load("b"), std::string("b\0\n", 3));
  EXPECT_EQ(store.load("c"), "");
  store.save("a", "later");
  EXPECT_EQ(CheckpointFile(path_, 30, asked_).store().load("a"), "later");
  file.remove();
  EXPECT_FALSE(fs::exists(path_));
  file.remove();  // a run that was shorter than the interval
}

TEST_F(CheckpointFileTest, IsDue)
{
  CheckpointFile always(path_, 0, asked_), seldom(path_, 86400, asked_);
  for (int k = 0; k < 3; ++k) {
    EXPECT_TRUE(always.store().due("a"));
    EXPECT_FALSE(seldom.store().due("a"));
  }
}

TEST_F(CheckpointFileTest, RefusesEveryFlippedByte)
{
  const std::string whole = written();
  for (std::size_t k = 0; k < whole.size(); ++k)
    for (const char flip : {'\x01', '\x80'}) {
      std::string bytes = whole;
      bytes[k] = static_cast<char>(bytes[k] ^ flip);
      const std::string said = said_about(bytes, asked_);
      EXPECT_EQ(said.find(path_ + ": is "), 0u) << "byte " << k << ": " << said;
    }
}

TEST_F(CheckpointFileTest, RefusesEveryTruncation)
{
  const std::string whole = written();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::string said = said_about(whole.substr(0, size), asked_);
    EXPECT_EQ(said.find(path_ + ": is "), 0u) << "size " << size << ": " << said;
  }
  EXPECT_NE(said_about(whole.substr(0, whole.size() - 1), asked_).find("is cut off or damaged"),
            std::string::npos);
  EXPECT_NE(said_about(whole + "x", asked_).find("is cut off or damaged"), std::string::npos);
  EXPECT_EQ(said_about(whole, asked_), "");
}

TEST_F(CheckpointFileTest, RefusesWhatIsNoCheckpoint)
{
  for (const std::string& bytes : {std::string(), std::string("[material.powder]\n"), std::string(5000, 'x')})
    EXPECT_EQ(said_about(bytes, asked_), path_ + ": is no checkpoint, and is left as it is");
  EXPECT_EQ(said_about("granulaw checkpoint 2\n" + std::string(100, 'x'), asked_),
            path_ + ": is a checkpoint of another version of the program");
}

TEST_F(CheckpointFileTest, SaysWhatIsOtherThanAsked)
{
  const std::string whole = written();
  const struct
  {
    std::function<void(RunIdentity&)> change;
    const char* sentence;
  } cases[] = {{[](auto& r) { r[1].second = "2"; }, " (--velocity): found 1, allowed is 2"},
               {[](auto& r) { r[2].second += "y"; }, " (particle's materials)"},  // too long to be shown
               {[](auto& r) { r[1].first = "--depth"; }, " (--depth)"},
               {[](auto& r) { r.pop_back(); }, ""},
               {[](auto& r) { r.emplace_back("more", ""); }, " (more)"}};
  for (const auto& [change, sentence] : cases) {
    RunIdentity other = asked_;
    change(other);
    EXPECT_EQ(said_about(whole, other), path_ + ": is the checkpoint of another run" + sentence);
  }
}

/// Everything that a trace depends on is in the identity, to the last bit.
TEST(RunIdentity, TellsRunsApart)
{
  Particle base;
  base.radius = 2e-3;
  base.materials = {{1500, 9.1e9, 0.3, 100e6}, {2500, 70e9, 0.22}};
  base.profile = {{0, 0}, {2e-3, 2e-3}, {0, 4e-3}};
  base.layers = {{1e-4, 1}};
  base.inclusions = {{0, 2e-3, 3e-4, -1}};
  const auto of = [](const Particle& p, const Partner& partner = {}, const RunOptions& o = {}) {
    return identity_of({{"command", "impact"}}, p, partner, o);
  };
  const RunIdentity own = of(base);
  EXPECT_EQ(of(base), own);

  const auto nudge = [](double& number) { number = std::nextafter(number, 1e300); };
  const std::vector<std::function<void(Particle&)>> changes{
      [&](Particle& p) { nudge(p.radius); },
      [&](Particle& p) { nudge(p.materials[0].density); },
      [&](Particle& p) { nudge(p.materials[1].youngs_modulus); },
      [&](Particle& p) { nudge(p.materials[0].poisson_ratio); },
      [&](Particle& p) { nudge(p.materials[0].yield_stress); },
      [&](Particle& p) { nudge(p.materials[0].hardening_modulus); },
      [&](Particle& p) {
        std::vector<ProfilePoint> points(p.profile.begin(), p.profile.end());
        nudge(points[1].z);
        p.profile = points;
      },
      [&](Particle& p) { nudge(p.layers[0].thickness); },
      [&](Particle& p) { nudge(p.inclusions[0].r); },
      [&](Particle& p) { nudge(p.inclusions[0].z); },
      [&](Particle& p) { nudge(p.inclusions[0].radius); },
      [](Particle& p) { p.materials[0].yield_stress = INFINITY; },
      [](Particle& p) { p.materials[0].hardening = {"voce", {{"strain", {0.1}}}}; },
      [](Particle& p) { p.materials[0].rate = {"johnson-cook", {{"coefficient", {0.1}}}}; },
      [](Particle& p) { p.layers[0].material = 0; },
      [](Particle& p) { p.inclusions[0].material = 1; },
      [](Particle& p) { p.inclusions.clear(); }};
  for (std::size_t k = 0; k < changes.size(); ++k) {
    Particle p = base;
    changes[k](p);
    EXPECT_NE(of(p), own) << "change " << k;
    EXPECT_NE(of(base, {p, {}}), of(base, {base, {}})) << "change " << k;
  }
  const Partner particle{base, {}}, wall{{}, base.materials[0]}, other_wall{{}, base.materials[1]};
  EXPECT_NE(of(base, particle), own);
  EXPECT_NE(of(base, wall), own);
  EXPECT_NE(of(base, wall), of(base, other_wall));

  RunOptions o;
  o.threads = 7;  // no matter
  EXPECT_EQ(of(base, {}, o), own);
  const std::vector<std::function<void(RunOptions&)>> options{
      [](RunOptions& x) { x.courant = 0.84; }, [](RunOptions& x) { x.slowness = 2; },
      [](RunOptions& x) { x.shifted_grids = 2; }, [](RunOptions& x) { x.samples = 100; }};
  for (std::size_t k = 0; k < options.size(); ++k) {
    RunOptions changed;
    options[k](changed);
    EXPECT_NE(of(base, {}, changed), own) << "option " << k;
  }
}

}  // namespace granulaw::checkpoint_file_test
