#include "characterise/atlas_file.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "atlas/atlas_layout.hpp"
#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "law/h5.hpp"
#include "law/h5_checksum.hpp"
#include "law/layout.hpp"

namespace granulaw {

namespace {

constexpr const char* format_value = "granulaw-atlas";
constexpr int major = 3, minor = 1;
constexpr int first_minor_with_checksum = 1;  // files without the attribute version_minor are of minor 0
constexpr std::size_t most_numbers = 1u << 20;        // numbers in one dataset

using Presence = AtlasDataset::Presence;
using Form = AtlasDataset::Form;

bool is_of_midplane(const AtlasDataset& d)
{
  return d.presence == Presence::midplane || d.presence == Presence::midplane_checks;
}
bool may_be_absent(const AtlasDataset& d)
{
  return d.presence == Presence::checks || d.presence == Presence::midplane_checks || d.presence == Presence::radii;
}

Atlas read_open(hid_t file, const std::string& path)
{
  const bool has_midplane = h5::has_link(file, "midplane_stiffnesses");
  AtlasParts parts;
  for (const AtlasDataset& dataset : atlas_datasets()) {
    if (is_of_midplane(dataset) && !has_midplane) continue;
    if (may_be_absent(dataset) && !h5::has_link(file, dataset.field.name)) continue;
    fill(parts, dataset,
         dataset.form == Form::scalar ? std::vector{h5::read_scalar(file, dataset.field, path)}
                           : h5::read_vector(file, dataset.field, most_numbers, path),
         path);
  }
  return atlas_of(std::move(parts));
}

}  // namespace

void write_atlas(const Atlas& atlas, const std::string& path)
{
  const h5::Silence silence;
  write_atomically(path, [&](const std::string& temporary) {
    h5::Handle file(H5Fcreate(temporary.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
    if (!file.ok()) fail(path, "cannot write here (no such folder, or no permission)");
    h5::write_text_attribute(file, h5::format, format_value, path);
    h5::write_int_attribute(file, h5::version_major, major, path);
    h5::write_int_attribute(file, h5::version_minor, minor, path);
    AtlasParts parts = parts_of(atlas);
    for (const AtlasDataset& dataset : atlas_datasets()) {
      if (is_of_midplane(dataset) && atlas.midplane().empty()) continue;
      std::vector<double> values;
      for (const double* number : dataset.numbers(parts)) values.push_back(*number);
      if (dataset.form == Form::scalar)
        h5::write_scalar(file, dataset.field, values.front(), path);
      else if (!values.empty())
        h5::write_vector(file, dataset.field, values, path,
                         dataset.form == Form::rounded_list ? H5T_IEEE_F32LE : H5T_IEEE_F64LE);
    }
    h5::Checksum written;
    read_open(file, path);
    h5::write(file, written, path);
    if (H5Fflush(file, H5F_SCOPE_LOCAL) < 0) fail(path, "cannot write (disk full?)");
  });
}

Atlas read_atlas(const std::string& path)
{
  const h5::Silence silence;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) fail(path, "no such file");
  h5::Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  if (!file.ok()) fail(path, "is not an HDF5 file, so not an atlas (or it was cut off)");
  if (H5Aexists(file, h5::format) <= 0 || h5::read_text_attribute(file, h5::format, path) != format_value)
    fail(path, "is an HDF5 file but not an atlas of granulaw");
  if (const int found = h5::read_int_attribute(file, h5::version_major, path); found != major)
    fail(path, "the atlas's major version is not the one this program reads", std::to_string(found),
         std::to_string(major));
  const bool has_minor = H5Aexists(file, h5::version_minor) > 0;
  const int found_minor = has_minor ? h5::read_int_attribute(file, h5::version_minor, path) : 0;
  h5::Checksum found;
  Atlas atlas = read_open(file, path);
  h5::verify(file, found, found_minor >= first_minor_with_checksum, path);
  return atlas;
}

}  // namespace granulaw
