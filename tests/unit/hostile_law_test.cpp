// A law file from anywhere: every damage gives one sentence or a usable law; never a crash, a hang (ctest's
// timeout ends it) or a large allocation.
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "counted_memory.hpp"
#include "hostile_file.hpp"
#include "law/h5.hpp"
#include "law/law_file.hpp"
#include "scratch_folder.hpp"
#include "synthetic_law.hpp"
#include "usable_law.hpp"
#include "without_checksum.hpp"

namespace granulaw::hostile_law_test {

namespace fs = std::filesystem;
using tests::Damage;
using tests::SyntheticLaw;

// HDF5 1.10 complains at exit after it was fed damaged files; nothing is open then.
[[maybe_unused]] const herr_t no_exit_handler = H5dont_atexit();

class HostileLaw : public ScratchFolder
{
 protected:
  void SetUp() override
  {
    ScratchFolder::SetUp();
    write_law(SyntheticLaw{}.whole_law(3, 10), path("other.h5"));
    tests::without_checksum(h5::Handle(H5Fopen(path("other.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT)));
    fs::copy_file(path("other.h5"), path("good.h5"));
    ASSERT_EQ(mkfifo(path("fifo").c_str(), 0600), 0);
    damages_ = tests::hostile_damages(path("."));
    ASSERT_GT(damages_.size(), 1000u);
  }

  /// A good law at a new `path_`, changed. HDF5 may fail to close what it was made to write: not our
  /// reader's.
  void spoil(const std::vector<const Damage*>& list)
  {
    fs::remove(path_);
    path_ = path("law" + std::to_string(++files_) + ".h5");
    fs::copy_file(path("good.h5"), path_);
    const h5::Silence silence;
    const h5::Handle access(H5Pcreate(H5P_FILE_ACCESS));
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDWR, access);
    ASSERT_GE(file, 0);
    tests::spoil(file, list);
    H5Fclose(file);
  }

  /// Reads `path_`; true if it was accepted.
  bool judge(const std::string& name)
  {
    // the largest law allowed, 131072 nodes, takes 30 MB
    constexpr std::size_t most_bytes = 64u << 20;
    const auto open_objects = [] { return H5Fget_obj_count(static_cast<hid_t>(H5F_OBJ_ALL), H5F_OBJ_ALL); };
    const auto open = open_objects();
    const tests::CountedMemory memory;
    bool accepted = false;
    try {
      const Law law = read_law(path_);
      accepted = true;
      EXPECT_EQ(tests::unusable(law), "") << name;
    } catch (const Error& error) {
      const std::string sentence = error.what();
      EXPECT_EQ(sentence.rfind(path_, 0), 0u) << name << ": " << sentence;
      EXPECT_LT(sentence.size(), path_.size() + 600) << name;  // a name of 255 bytes twice, and the words
      for (const char c : sentence) EXPECT_FALSE(std::iscntrl(static_cast<unsigned char>(c))) << name;
    } catch (const std::exception& error) {
      ADD_FAILURE() << name << ": not an Error: " << error.what();
    }
    EXPECT_LT(memory.peak(), most_bytes) << name;
    EXPECT_EQ(open_objects(), open) << name << ": left open";
    return accepted;
  }

  std::string path_ = path("law.h5");
  int files_ = 0;
  std::vector<Damage> damages_;
};

TEST_F(HostileLaw, EverySingleDamage)
{
  int accepted = 0;
  for (const Damage& damage : damages_) {
    SCOPED_TRACE(damage.name);
    spoil({&damage});
    accepted += judge(damage.name);
    if (HasFailure()) break;
  }
  printf("%zu files, %d accepted\n", damages_.size(), accepted);
}

TEST_F(HostileLaw, DamagesTogether)
{
  unsigned state = 20261121;
  const auto draw = [&] {
    state = state * 1664525u + 1013904223u;
    return state >> 8;
  };
  for (int k = 0; k < 500; ++k) {
    std::vector<const Damage*> list;
    std::string name;
    for (unsigned j = 0; j < 2 + draw() % 3; ++j) {
      const Damage& damage = damages_[draw() % damages_.size()];
      if (damage.big) continue;
      list.push_back(&damage);
      name += damage.name + "; ";
    }
    SCOPED_TRACE(name);
    spoil(list);
    judge(name);
    if (HasFailure()) break;
  }
}

TEST_F(HostileLaw, CutAtEvery64thByte)
{
  const auto size = fs::file_size(path("good.h5"));
  for (std::uintmax_t end = 0; end < size; end = end + 64 < size || end == size - 1 ? end + 64 : size - 1) {  // the last: by one byte
    fs::copy_file(path("good.h5"), path_, fs::copy_options::overwrite_existing);
    fs::resize_file(path_, end);
    EXPECT_FALSE(judge("cut to " + std::to_string(end)));
    if (HasFailure()) break;
  }
}

/// The test itself must be able to fail.
TEST_F(HostileLaw, TheJudgeSeesWhatItShould)
{
  Law law = SyntheticLaw{}.whole_law(3, 10);
  EXPECT_EQ(tests::unusable(law), "");
  law.bodies["powder"].material.youngs_modulus = HUGE_VAL;
  EXPECT_NE(tests::unusable(law), "");
#ifdef GRANULAW_COUNTS_MEMORY
  const tests::CountedMemory memory;
  {
    const std::vector<char> large(100u << 20);
  }
  EXPECT_GT(memory.peak(), 100u << 20);
#endif
}

}  // namespace granulaw::hostile_law_test
