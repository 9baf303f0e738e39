#include "trace_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "base/version.hpp"
#include "law/h5.hpp"
#include "law/h5_names.hpp"

namespace granulaw {

namespace fs = std::filesystem;

namespace {

const char* name_of(Branch branch)
{
  return branch == Branch::load ? "load" : branch == Branch::unload ? "unload" : "reload";
}

struct Column
{
  h5::Field field;
  double TraceSample::*value;
};
constexpr Column columns[] = {
    {{"time_s", "s", "time since first touch"}, &TraceSample::time},
    {{"delta_m", "m", "overlap: displacement of the centre of mass towards the wall since first touch"},
     &TraceSample::delta},
    {{"force_N", "N", "contact force, repulsive positive"}, &TraceSample::force},
    {{"contact_radius_m", "m", "radius of the contact"}, &TraceSample::contact_radius}};

void write_csv(const RunResult& result, const std::string& temporary, const std::string& path)
{
  std::ofstream out(temporary);
  out << "time_s,delta_m,force_N,contact_radius_m,branch\n";
  for (const TraceSample& t : result.trace)
    out << fmt::format("{:.10g},{:.10g},{:.10g},{:.10g},{}\n", t.time, t.delta, t.force, t.contact_radius,
                       name_of(t.branch));
  if (!out.flush()) fail(path, "cannot be written (disk full?)");
}

void write_h5(const RunResult& result, const std::string& temporary, const std::string& path)
{
  const h5::Silence silence;
  const h5::Handle file(H5Fcreate(temporary.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  if (!file.ok()) fail(path, "cannot be written");
  h5::write_text_attribute(file, h5::format, "granulaw-trace", path);
  h5::write_text_attribute(file, "version", version(), path);
  h5::write_text_attribute(file, "git_hash", git_hash(), path);
  std::vector<double> values;
  for (const Column& c : columns) {
    values.clear();
    for (const TraceSample& t : result.trace) values.push_back(t.*c.value);
    h5::write_vector(file, c.field, values, path);
  }
  std::vector<std::string> branches;
  for (const TraceSample& t : result.trace) branches.push_back(name_of(t.branch));
  h5::write_texts(file, "branch", branches, path);
}

}  // namespace

void check_output(const std::string& path, const std::string& endings)
{
  if (path.empty()) return;
  const fs::path p(path);
  if (p.extension().empty() || endings.find(p.extension().string()) == std::string::npos)
    fail(path, "the ending of an output name says its format", p.extension().string(), endings);
  require_writable(path, path);
}

void write_trace(const RunResult& result, const std::string& path)
{
  write_atomically(path, [&](const std::string& temporary) {
    if (fs::path(path).extension() == ".csv")
      write_csv(result, temporary, path);
    else
      write_h5(result, temporary, path);
  });
}

}  // namespace granulaw
