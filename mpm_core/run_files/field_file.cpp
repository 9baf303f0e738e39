#include "run_files/field_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <utility>

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "base/version.hpp"
#include "law/h5.hpp"
#include "law/layout.hpp"

namespace granulaw {

namespace fs = std::filesystem;

namespace {

/// Content of a frame's group beside its geometry; one table for HDF5 and XDMF.
struct NodeField
{
  h5::Field field;
  std::vector<double> FieldFrame::*r;
  std::vector<double> FieldFrame::*z;
  std::vector<double> FieldFrame::*y;  ///< three dimensions
};
struct CellField
{
  h5::Field field;
  std::vector<double> FieldFrame::*value;
};
constexpr h5::Field geometry{"position", "m", "deformed position of the nodes: r, z; the plane is z = 0"};
constexpr h5::Field solid_geometry{"position", "m",
                                   "deformed position of the nodes: x, y, z; wall: z away from it"};
constexpr NodeField node_fields[] = {
    {{"displacement", "m", "displacement since first touch: r, z, 0"},
     &FieldFrame::ur,
     &FieldFrame::uz,
     &FieldFrame::uy},
    {{"velocity", "m/s", "velocity: r, z, 0"}, &FieldFrame::vr, &FieldFrame::vz, &FieldFrame::vy}};
constexpr CellField cell_fields[] = {
    {{"equivalent_plastic_strain", "1", "equivalent plastic strain"}, &FieldFrame::plastic_strain},
    {{"pressure", "Pa", "minus a third of the trace of the Cauchy stress: compression positive"},
     &FieldFrame::pressure},
    {{"von_mises_stress", "Pa", "von Mises stress of the Cauchy stress"}, &FieldFrame::von_mises},
    {{"axial_stress", "Pa", "zz component of the Cauchy stress: tension positive"},
     &FieldFrame::axial_stress}};

class FieldFile
{
 public:
  FieldFile(std::string temporary, std::string path)
      : temporary_(std::move(temporary)), path_(std::move(path))
  {
  }

  /// Four corners each: axisymmetric; eight: three-dimensional.
  template <std::size_t corners>
  void begin(int nodes, const std::vector<std::array<int, corners>>& cells)
  {
    const h5::Silence silence;
    file_ = h5::Handle();
    file_ = h5::Handle(H5Fcreate(temporary_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
    if (!file_.ok()) fail(path_, "cannot be written");
    nodes_ = nodes, cells_ = cells.size(), corners_ = corners;
    frames_.clear();
    h5::write_text_attribute(file_, h5::format, "granulaw-fields", path_);
    h5::write_text_attribute(file_, "version", version(), path_);
    h5::write_text_attribute(file_, "git_hash", git_hash(), path_);
    const char* legend = solid() ? "nodes of each cell: lower four, upper four, counter-clockwise"
                                 : "nodes of each cell, counter-clockwise in (r, z)";
    write(file_, {"cells", "1", legend}, H5T_NATIVE_INT, H5T_STD_I32LE, cells.size(), corners, cells.data());
  }

  void frame(const FieldFrame& f)
  {
    const h5::Silence silence;
    const std::string name = fmt::format("frame{:04}", frames_.size());
    const h5::Handle group = h5::create_group(file_, name.c_str(), path_);
    const auto scalar = [&](const h5::Field& field, double value) {
      h5::write_scalar(group, field, value, path_);
    };
    scalar({"time", "s", "time since first touch"}, f.time);
    scalar({"delta", "m", "overlap of this grid"}, f.delta);
    scalar({"force", "N", "contact force on this grid, mean over a trace sample, repulsive positive"},
           f.force);
    if (solid()) {
      write_triples(group, solid_geometry, f.r, f.y, f.z);
      for (const NodeField& n : node_fields) write_triples(group, n.field, f.*n.r, f.*n.y, f.*n.z);
    } else {
      write_pairs(group, geometry, f.r, f.z, 2);
      for (const NodeField& n : node_fields) write_pairs(group, n.field, f.*n.r, f.*n.z, 3);
    }
    for (const CellField& c : cell_fields) {
      const std::vector<double>& v = f.*c.value;
      write(group, c.field, H5T_NATIVE_DOUBLE, H5T_IEEE_F32LE, v.size(), 1, v.data());
    }
    frames_.push_back(f.time);
  }

  /// Everything is on disk, or Error.
  void close()
  {
    const h5::Silence silence;
    if (!file_.ok()) fail(path_, "no frame was written");
    if (H5Fflush(file_, H5F_SCOPE_GLOBAL) < 0) fail(path_, "cannot be written (disk full?)");
    file_ = h5::Handle();
  }

  std::string xdmf(const std::string& h5_name) const
  {
    std::string out =
        "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n"
        "<Grid Name=\"body\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
    const auto item = [&](const char* type, int bytes, const std::string& shape, const std::string& where) {
      return fmt::format(
          "<DataItem Dimensions=\"{}\" NumberType=\"{}\" Precision=\"{}\" Format=\"HDF\">{}:/{}</DataItem>",
          shape, type, bytes, h5_name, where);
    };
    const auto attribute = [&](const h5::Field& f, const char* type, const char* centre,
                               const std::string& shape, int k) {
      out += fmt::format(
          "  <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">\n"
          "    <Information Name=\"unit\" Value=\"{}\"/>\n    {}\n  </Attribute>\n",
          f.name, type, centre, f.unit, item("Float", 4, shape, fmt::format("frame{:04}/{}", k, f.name)));
    };
    for (std::size_t n = 0; n < frames_.size(); ++n) {
      const int k = static_cast<int>(n);
      out += fmt::format("<Grid Name=\"frame{:04}\" GridType=\"Uniform\">\n  <Time Value=\"{:.9g}\"/>\n", k,
                         frames_[n]);
      out += fmt::format("  <Topology TopologyType=\"{}\" NumberOfElements=\"{}\">\n    {}\n  </Topology>\n",
                         solid() ? "Hexahedron" : "Quadrilateral", cells_,
                         item("Int", 4, fmt::format("{} {}", cells_, corners_), "cells"));
      out += fmt::format("  <Geometry GeometryType=\"{}\">\n    {}\n  </Geometry>\n", solid() ? "XYZ" : "XY",
                         item("Float", 4, fmt::format("{} {}", nodes_, solid() ? 3 : 2),
                              fmt::format("frame{:04}/position", k)));
      for (const NodeField& f : node_fields)
        attribute(f.field, "Vector", "Node", fmt::format("{} 3", nodes_), k);
      for (const CellField& f : cell_fields) attribute(f.field, "Scalar", "Cell", std::to_string(cells_), k);
      out += "</Grid>\n";
    }
    return out + "</Grid>\n</Domain>\n</Xdmf>\n";
  }

 private:
  /// A rows x columns dataset (columns = 1: a vector), with unit and legend as the law file has them.
  void write(hid_t group, const h5::Field& field, hid_t memory, hid_t disk, std::size_t rows,
             std::size_t columns, const void* values) const
  {
    const hsize_t extent[2] = {rows, columns};
    const h5::Handle space(H5Screate_simple(columns == 1 ? 1 : 2, extent, nullptr));
    const h5::Handle set(H5Dcreate2(group, field.name, disk, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    if (!set.ok() || H5Dwrite(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
      fail(path_, "cannot be written (disk full?)");
    h5::write_text_attribute(set, h5::unit, field.unit, path_);
    h5::write_text_attribute(set, h5::legend, field.legend, path_);
  }

  void write_pairs(hid_t group, const h5::Field& field, const std::vector<double>& r,
                   const std::vector<double>& z, std::size_t columns) const
  {
    std::vector<double> values(columns * r.size(), 0.0);
    for (std::size_t i = 0; i < r.size(); ++i) values[columns * i] = r[i], values[columns * i + 1] = z[i];
    write(group, field, H5T_NATIVE_DOUBLE, H5T_IEEE_F32LE, r.size(), columns, values.data());
  }

  void write_triples(hid_t group, const h5::Field& field, const std::vector<double>& x,
                     const std::vector<double>& y, const std::vector<double>& z) const
  {
    std::vector<double> values;
    for (std::size_t i = 0; i < x.size(); ++i) values.insert(values.end(), {x[i], y[i], z[i]});
    write(group, field, H5T_NATIVE_DOUBLE, H5T_IEEE_F32LE, x.size(), 3, values.data());
  }
  bool solid() const { return corners_ == 8; }

  std::string temporary_, path_;
  h5::Handle file_;
  std::vector<double> frames_;
  int nodes_ = 0;
  std::size_t cells_ = 0, corners_ = 4;
};

std::string h5_beside(const std::string& path)
{
  return fs::path(path).replace_extension(".h5").string();
}

}  // namespace

void check_field_output(const std::string& path)
{
  const std::string ending = fs::path(path).extension().string();
  if (ending != ".xdmf") fail("--fields", "the ending of an output name says its format", path, ".xdmf");
  if (path.find_first_of("<>&\"") != std::string::npos)
    fail("--fields", "these characters cannot stand in an XDMF file's name", path, "a name without < > & \"");
  require_writable(path, "--fields");
  require_writable(h5_beside(path), "--fields");
}

RunResult run_with_fields(const std::string& path, int frames,
                          const std::function<RunResult(const FieldObserver&)>& run)
{
  const std::string h5_path = h5_beside(path);
  RunResult result;
  std::string xdmf;
  write_atomically(h5_path, [&](const std::string& temporary) {
    FieldFile file(temporary, h5_path);
    FieldObserver observer;
    observer.frames = frames;
    observer.begin = [&](int nodes, const std::vector<std::array<int, 4>>& cells) {
      file.begin(nodes, cells);
    };
    observer.begin_solid = [&](int nodes, const std::vector<std::array<int, 8>>& cells) {
      file.begin(nodes, cells);
    };
    observer.frame = [&](const FieldFrame& f) { file.frame(f); };
    result = run(observer);
    file.close();
    xdmf = file.xdmf(fs::path(h5_path).filename().string());
  });
  write_text_atomically(path, xdmf);
  return result;
}

}  // namespace granulaw
