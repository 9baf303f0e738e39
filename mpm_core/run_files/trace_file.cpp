#include "run_files/trace_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "base/version.hpp"
#include "law/h5.hpp"
#include "law/layout.hpp"

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

/// A column that only three-dimensional runs have.
struct PlaneColumn
{
  std::string name, unit, legend;
  std::vector<double> values;
};

/// Force, torque and place of contact of an impact; of planes the force of each.
std::vector<PlaneColumn> plane_columns(const RunResult& result)
{
  std::vector<PlaneColumn> found;
  const auto add = [&](std::string name, std::string unit, std::string legend, const PlaneTrace& plane,
                       auto value) {
    found.push_back({std::move(name), std::move(unit), std::move(legend), {}});
    for (const PlaneSample& p : plane.samples) found.back().values.push_back(value(p));
  };
  if (result.rebound && !result.planes.empty()) {
    const PlaneTrace& wall = result.planes.front();
    const auto vector = [&](const char* name, const char* unit, const char* legend, auto field) {
      for (int d = 0; d < 3; ++d)
        add(fmt::format("{}_{}_{}", name, "xyz"[d], unit), unit, legend, wall,
            [&](const PlaneSample& p) { return (p.*field)[d]; });
    };
    vector("force", "N", "force on the body, z away from the wall", &PlaneSample::vector);
    vector("torque", "Nm", "torque of it about the body's centre of mass", &PlaneSample::torque);
    vector("contact", "m", "place of the normal force from that centre", &PlaneSample::centre);
    add("major_axis_m", "m", "larger half axis of the contact", wall,
        [](const PlaneSample& p) { return p.axes[0]; });
    add("minor_axis_m", "m", "smaller half axis of the contact", wall,
        [](const PlaneSample& p) { return p.axes[1]; });
  } else {
    for (std::size_t k = 0; k < result.planes.size(); ++k)
      add(fmt::format("force_{}_N", k + 1), "N", "normal force of this plane", result.planes[k],
          [](const PlaneSample& p) { return p.force; });
  }
  return found;
}

void write_csv(const RunResult& result, const std::string& temporary, const std::string& path)
{
  const std::vector<PlaneColumn> more = plane_columns(result);
  std::ofstream out(temporary);
  out << "time_s,delta_m,force_N,contact_radius_m,branch";
  for (const PlaneColumn& column : more) out << ',' << column.name;
  out << '\n';
  for (std::size_t k = 0; k < result.trace.size(); ++k) {
    const TraceSample& t = result.trace[k];
    out << fmt::format("{:.10g},{:.10g},{:.10g},{:.10g},{}", t.time, t.delta, t.force, t.contact_radius,
                       name_of(t.branch));
    for (const PlaneColumn& column : more) out << fmt::format(",{:.10g}", column.values[k]);
    out << '\n';
  }
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
  for (const PlaneColumn& c : plane_columns(result))
    h5::write_vector(file, {c.name.c_str(), c.unit.c_str(), c.legend.c_str()}, c.values, path);
  std::vector<std::string> branches;
  for (const TraceSample& t : result.trace) branches.push_back(name_of(t.branch));
  h5::write_texts(file, "branch", branches, path);
}

}  // namespace

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
