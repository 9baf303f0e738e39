// libFuzzer target of read_law: whatever the bytes, one sentence or a usable law. Its mutator writes damaged
// laws through the HDF5 API (hostile_file.hpp) beside libFuzzer's own changes of bytes.
#include <hdf5.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include "base/error.hpp"
#include "finding.hpp"
#include "hostile_file.hpp"
#include "law/h5.hpp"
#include "law/law_file.hpp"
#include "synthetic_law.hpp"
#include "usable_law.hpp"
#include "without_checksum.hpp"

// libFuzzer's own mutations; absent where a corpus is only replayed.
extern "C" __attribute__((weak)) std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size,
                                                              std::size_t most);

namespace granulaw::tests {
namespace {

namespace fs = std::filesystem;

// Fed damaged files, HDF5 1.10 complains at exit; nothing is open then.
[[maybe_unused]] const herr_t no_exit_handler = H5dont_atexit();

/// A folder in memory with what damages lead to; removed at exit, a crash leaves it.
struct Folder
{
  fs::path path = scratch() / ("granulaw_fuzz_" + std::to_string(getpid()));
  Folder()
  {
    fs::create_directories(path);
    // few nodes: the file stays small, and a change of bytes rarely hits a mere number
    const std::string good = (path / "good.h5").string();
    write_law(SyntheticLaw{}.whole_law(2, 6), good);
    without_checksum(h5::Handle(H5Fopen(good.c_str(), H5F_ACC_RDWR, H5P_DEFAULT)));
    fs::copy_file(path / "good.h5", path / "other.h5");
    if (mkfifo((path / "fifo").c_str(), 0600) != 0) std::abort();
  }
  ~Folder() { fs::remove_all(path); }

  /// A name never used before: HDF5 may keep a damaged file open and mistake the next one of its name for it.
  std::string fresh() { return (path / ("law" + std::to_string(++files_) + ".h5")).string(); }

 private:
  long files_ = 0;
};

Folder& folder()
{
  static Folder the;
  return the;
}

std::string damaged_law(std::mt19937& draw)
{
  static const std::vector<Damage> damages = hostile_damages(folder().path.string());
  const std::string path = folder().fresh();
  fs::copy_file(folder().path / "good.h5", path);
  std::vector<const Damage*> list;
  for (auto count = 1 + draw() % 4; count > 0; --count)
    if (const Damage& damage = damages[draw() % damages.size()]; !damage.big) list.push_back(&damage);
  const h5::Silence silence;
  const h5::Handle access(H5Pcreate(H5P_FILE_ACCESS));
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, access);
  spoil(file, list);
  H5Fclose(file);
  return path;
}

}  // namespace
}  // namespace granulaw::tests

using namespace granulaw;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string path = tests::folder().fresh();
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    const std::string what = tests::unusable(read_law(path));
    if (!what.empty()) tests::finding("accepted, but " + what);
  } catch (const Error& error) {
    if (const std::string what = tests::unclear(error.what(), path); !what.empty())
      tests::finding(what + ": " + error.what());
  }
  std::filesystem::remove(path);
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed)
{
  std::mt19937 draw(seed);
  if (draw() % 3 == 0) {
    const std::string path = tests::damaged_law(draw);
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    std::filesystem::remove(path);
    if (bytes.size() <= most) {
      bytes.copy(reinterpret_cast<char*>(data), bytes.size());
      size = bytes.size();
    }
    if (draw() % 2 == 0) return size;
  }
  return LLVMFuzzerMutate(data, size, most);
}
