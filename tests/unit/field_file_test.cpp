#include "run_files/field_file.hpp"

#include "scratch_folder.hpp"
#include "some_materials.hpp"

namespace granulaw::field_file_test {

class FieldFile : public ScratchFolder
{
 protected:
  /// A coarse impact, under a second.
  static RunResult hit(const FieldObserver& fields)
  {
    RunOptions options;
    options.resolution = 6;
    options.shifted_grids = 1;
    options.estimate_error = false;
    options.fields = fields;
    return impact(Particle::sphere(2e-3, soft_powder()), {2.6}, {}, options);
  }
};

TEST_F(FieldFile, NamesThatCannotBeAreRefusedFirst)
{
  EXPECT_EQ(sentence_of([&] { check_field_output(path("f.xdmf")); }), "");
  expect_error(".xdmf", [&] { check_field_output(path("f.vtk")); });
  expect_error("does not exist", [&] { check_field_output(path("none/f.xdmf")); });
}

TEST_F(FieldFile, ARunLeavesItsTwoFiles)
{
  run_with_fields(path("f.xdmf"), 5, hit);
  EXPECT_EQ(files(), 2u);
  EXPECT_NE(read(path("f.xdmf")).find("f.h5:"), std::string::npos);
  EXPECT_FALSE(read(path("f.h5")).empty());
}

TEST_F(FieldFile, ARunThatStopsLeavesNone)
{
  struct Stop
  {
  };
  const auto stops = [](const FieldObserver& fields) -> RunResult {
    hit(fields);
    throw Stop{};
  };
  EXPECT_THROW(run_with_fields(path("f.xdmf"), 5, stops), Stop);
  EXPECT_EQ(files(), 0u);
}

}  // namespace granulaw::field_file_test
