#include "run_files/trace_file.hpp"

#include <algorithm>

#include "base/atomic_write.hpp"
#include "law/h5.hpp"
#include "scratch_folder.hpp"
#include "some_runs.hpp"

namespace granulaw::trace_file_test {

class TraceFile : public ScratchFolder
{
};

TEST_F(TraceFile, OutputNamesTellTheirFormat)
{
  EXPECT_EQ(sentence_of([] { check_output("-o", "", ".csv"); }), "");  // none asked for
  EXPECT_EQ(sentence_of([&] { check_output("-o", path("t.csv"), ".csv, .h5"); }), "");
  expect_error("-o: the ending of an output name says its format: found t.txt, allowed is .csv, .h5",
               [&] { check_output("-o", "t.txt", ".csv, .h5"); });
  expect_error("the ending", [&] { check_output("-o", path("t"), ".csv"); });
  expect_error("does not exist", [&] { check_output("-o", path("none/t.csv"), ".csv"); });
  EXPECT_EQ(files(), 0u);
}

TEST_F(TraceFile, CsvHasALineForEachSample)
{
  const RunResult result = some_result(1);
  write_trace(result, path("t.csv"));
  const std::string text = read(path("t.csv"));
  EXPECT_TRUE(text.starts_with("time_s,delta_m,force_N,contact_radius_m,branch\n0,0,0,1e-05,load\n"));
  EXPECT_TRUE(text.ends_with(",unload\n"));
  EXPECT_EQ(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')), 1 + result.trace.size());
  EXPECT_EQ(files(), 1u);
}

TEST_F(TraceFile, Hdf5HasADatasetForEachColumn)
{
  write_trace(some_result(1), path("t.h5"));
  const h5::Handle file(H5Fopen(path("t.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  ASSERT_TRUE(file.ok());
  for (const char* name : {"time_s", "delta_m", "force_N", "contact_radius_m", "branch"})
    EXPECT_GT(H5Lexists(file, name, H5P_DEFAULT), 0) << name;
  EXPECT_EQ(files(), 1u);
}

}  // namespace granulaw::trace_file_test
