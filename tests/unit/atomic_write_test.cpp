#include "base/atomic_write.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "law/law_file.hpp"
#include "scratch_folder.hpp"
#include "synthetic_law.hpp"

namespace granulaw::atomic_write_test {

namespace fs = std::filesystem;

class AtomicWrite : public ScratchFolder
{
};

/// Two builders write one law file over and over while this process reads it: every read sees the whole law
/// of one of them, and nothing is left beside it.
TEST_F(AtomicWrite, TwoWritersOfOneFileNeverSpoilIt)
{
  constexpr int rounds = 60;
  const std::string file = path("law.h5");
  Law law = tests::SyntheticLaw{}.law();
  law.provenance["command"] = "0";
  write_law(law, file);

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
          write_law(law, file);
        } catch (...) {
          code = 1;
        }
      _exit(code);
    }
  }

  int reads = 0, running = 2;
  while (running > 0) {
    const Law seen = read_law(file);  // throws where a reader could see a part
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
  EXPECT_EQ(files(), 1u) << "a temporary file was left";
}

TEST_F(AtomicWrite, AFailingWriterLeavesTheOldFile)
{
  write_atomically(path("text"), [](const std::string& t) { std::ofstream(t) << "old"; });
  EXPECT_THROW(write_atomically(path("text"),
                                [](const std::string& t) {
                                  std::ofstream(t) << "ne";
                                  throw std::runtime_error("disk full");
                                }),
               std::runtime_error);
  EXPECT_EQ(read(path("text")), "old");
  EXPECT_EQ(files(), 1u) << "a temporary file was left";
}

TEST_F(AtomicWrite, ALinkStaysAndItsFileIsWritten)
{
  fs::create_directory(path("data"));
  write_text_atomically(path("data/file"), "old");
  fs::create_symlink("data/file", path("near"));
  fs::create_symlink(path("near"), path("far"));  // absolute, to a link
  fs::create_symlink("data/none", path("dangling"));
  for (const char* link : {"near", "far", "dangling"}) {
    require_writable(path(link), "here");
    write_text_atomically(path(link), link);
    EXPECT_TRUE(fs::is_symlink(path(link))) << link;
    EXPECT_EQ(read(path(link)), link);
  }
  EXPECT_EQ(read(path("data/file")), "far");
  EXPECT_EQ(read(path("data/none")), "dangling");
  EXPECT_EQ(std::distance(fs::directory_iterator(path("data")), {}), 2) << "a temporary file was left";

  fs::create_symlink("ring", path("ring"));
  expect_error("leads to itself", [&] { write_text_atomically(path("ring"), ""); });
}

/// As root a rename replaces the device node by a file.
TEST_F(AtomicWrite, WhatIsNoRegularFileIsRefused)
{
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  fs::create_symlink("/dev/full", path("device"));
  fs::create_directory(path("folder"));
  for (const auto& [name, what] : {std::pair<std::string, const char*>{path("pipe"), "no regular file"},
                                   {path("device"), "no regular file"},
                                   {"/dev/full", "no regular file"},
                                   {"/dev/null", "no regular file"},
                                   {path("folder"), "is a folder"}}) {
    expect_error(what, [&] { require_writable(name, "here"); });
    expect_error(what, [&] { write_text_atomically(name, ""); });
    EXPECT_FALSE(fs::is_regular_file(name)) << name;
  }
}

}  // namespace granulaw::atomic_write_test
