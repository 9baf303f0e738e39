#include "own_files.hpp"
#include "deck/process.hpp"

#include <cstdlib>

#include "scratch_folder.hpp"

namespace granulaw::atlas_path_test {

class AtlasPath : public ScratchFolder
{
 protected:
  void TearDown() override
  {
    unsetenv("GRANULAW_ATLAS");
    ScratchFolder::TearDown();
  }
};

TEST_F(AtlasPath, TheEnvironmentNamesTheAtlas)
{
  setenv("GRANULAW_ATLAS", GRANULAW_ATLAS_FILE, 1);
  EXPECT_EQ(atlas_path(), GRANULAW_ATLAS_FILE);
  ASSERT_TRUE(own_atlas());
  EXPECT_FALSE(own_atlas()->nodes().empty());
}

TEST_F(AtlasPath, AnAtlasThatIsNoneIsRefused)
{
  setenv("GRANULAW_ATLAS", path("none.h5").c_str(), 1);
  expect_error("none.h5", [] { own_atlas(); });
}

TEST_F(AtlasPath, WithoutAnAtlasThereIsNone)
{
  setenv("GRANULAW_ATLAS", "", 1);  // counts as not set; none lies beside the test program
  EXPECT_EQ(atlas_path(), "");
  EXPECT_FALSE(own_atlas());
  EXPECT_EQ(own_file("no such file"), "");
}

}  // namespace granulaw::atlas_path_test
