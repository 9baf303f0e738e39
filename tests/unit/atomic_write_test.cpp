#include "base/atomic_write.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "law/law_file.hpp"
#include "synthetic_law.hpp"

namespace granulaw::atomic_write_test {

namespace fs = std::filesystem;

/// Two builders write one law file over and over while this process reads it: every read sees the whole law
/// of one of them, and nothing is left beside it.
TEST(AtomicWrite, TwoWritersOfOneFileNeverSpoilIt)
{
  constexpr int rounds = 60;
  const fs::path folder = fs::temp_directory_path() / ("granulaw_two_writers_" + std::to_string(getpid()));
  fs::create_directories(folder);
  const std::string path = (folder / "law.h5").string();
  Law law = tests::SyntheticLaw{}.law();
  law.provenance["command"] = "0";
  write_law(law, path);

  pid_t writers[2];
  for (const int who : {0, 1}) {
    writers[who] = fork();
    ASSERT_GE(writers[who], 0);
    if (writers[who] == 0) {
      // each builder's law is another: its density says which, its command as well
      law.bodies["powder"].material.density = 1500 + who;
      law.provenance["command"] = std::to_string(who);
      int code = 0;
      for (int k = 0; k < rounds && code == 0; ++k) try {
          write_law(law, path);
        } catch (...) {
          code = 1;
        }
      _exit(code);
    }
  }

  int reads = 0, running = 2;
  while (running > 0) {
    const Law seen = read_law(path);  // throws where a reader could see a part
    const int who = seen.bodies.at("powder").material.density > 1500.5;
    EXPECT_EQ(seen.provenance.at("command"), std::to_string(who)) << "one's numbers with the other's words";
    ++reads;
    int status = 0;
    while (waitpid(-1, &status, WNOHANG) > 0) {
      EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "a writer failed";
      --running;
    }
  }
  EXPECT_GT(reads, 1);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1) << "a temporary file was left";
  fs::remove_all(folder);
}

TEST(AtomicWrite, AFailingWriterLeavesTheOldFile)
{
  const fs::path folder = fs::temp_directory_path() / ("granulaw_failing_writer_" + std::to_string(getpid()));
  fs::create_directories(folder);
  const std::string path = (folder / "text").string();
  write_atomically(path, [](const std::string& t) { std::ofstream(t) << "old"; });
  EXPECT_THROW(write_atomically(path,
                                [](const std::string& t) {
                                  std::ofstream(t) << "ne";
                                  throw std::runtime_error("disk full");
                                }),
               std::runtime_error);
  std::string text;
  std::ifstream(path) >> text;
  EXPECT_EQ(text, "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1) << "a temporary file was left";
  fs::remove_all(folder);
}

}  // namespace granulaw::atomic_write_test
