#include "law/h5.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "law/h5_checksum.hpp"
#include "law/layout.hpp"

namespace granulaw::h5 {

namespace {

// A hostile size must not be allocated.
constexpr std::size_t longest_text = 65536;          // bytes
constexpr std::size_t longest_text_list = 8u << 20;  // bytes, all entries together
constexpr std::size_t widest_number = 16;            // bytes

Handle text_type(std::size_t size)
{
  Handle type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type, std::max<std::size_t>(1, size));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

void require(bool ok, const std::string& file, const char* what, const char* name)
{
  if (!ok) fail(file, fmt::format("{} '{}'", what, name));
}

/// Size in bytes of a fixed-length string type; fails for any other type.
std::size_t fixed_text_size(hid_t type, const std::string& file, const char* name)
{
  require(type >= 0 && H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0, file,
          "text of fixed length expected in", name);
  const std::size_t size = H5Tget_size(type);
  require(size > 0 && size <= longest_text, file, "unusable text length in", name);
  return size;
}

std::string trimmed(const char* begin, std::size_t size)
{
  return {begin, std::find(begin, begin + size, '\0')};
}

void describe(hid_t object, const Field& field, const std::string& file)
{
  write_text_attribute(object, unit, field.unit, file);
  write_text_attribute(object, legend, field.legend, file);
}

/// Fails unless `name` is an entry that lives in this file: a soft link may run in circles, and an external
/// one would open (and wait for) any other file that the law's author chose.
void require_own(hid_t group, const char* name, const std::string& file, const char* missing)
{
  require(has_link(group, name), file, missing, name);
  H5L_info_t link{};
  require(H5Lget_info(group, name, &link, H5P_DEFAULT) >= 0 && link.type == H5L_TYPE_HARD, file,
          "a law file holds its own data, but there is a link in place of", name);
}

Handle open_dataset(hid_t group, const char* name, const std::string& file)
{
  require_own(group, name, file, "the law file lacks");
  Handle set(H5Dopen2(group, name, H5P_DEFAULT));
  require(set.ok(), file, "cannot read", name);
  return set;
}

/// Fails unless the values stand in the file itself, written and plain. Compressed, they could unpack to
/// gigabytes; external and virtual ones are read from other files; those declared but never written would
/// come back as zeros. Ask after the extent was checked, before reading.
void require_stored(hid_t set, const std::string& file, const char* name)
{
  const Handle list(H5Dget_create_plist(set));
  const H5D_layout_t layout = H5Pget_layout(list);
  require(list.ok() && (layout == H5D_CONTIGUOUS || layout == H5D_COMPACT) && H5Pget_nfilters(list) == 0 &&
              H5Pget_external_count(list) == 0,
          file, "values stored plain, in the file itself, expected in", name);
  H5D_space_status_t status{};
  require(H5Dget_space_status(set, &status) >= 0 && status == H5D_SPACE_STATUS_ALLOCATED, file,
          "values are declared but not stored in", name);
}

/// Adds a list of texts, each with its terminator.
void add_texts(const char* name, const std::vector<std::string>& texts)
{
  std::string all;
  for (const std::string& text : texts) all.append(text.c_str(), text.size() + 1);
  Checksum::add(name, all.data(), all.size());
}

/// Opens a dataset of numbers and checks its type.
Handle open_numbers(hid_t group, const char* name, const std::string& file)
{
  Handle set = open_dataset(group, name, file);
  const Handle type(H5Dget_type(set));
  require(type.ok() && H5Tget_class(type) == H5T_FLOAT && H5Tget_size(type) <= widest_number, file,
          "floating-point numbers expected in", name);
  return set;
}

}  // namespace

Silence::Silence()
{
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Silence::~Silence()
{
  H5Eset_auto2(H5E_DEFAULT, function_, data_);
}

Handle& Handle::operator=(Handle&& other) noexcept
{
  std::swap(id_, other.id_);
  return *this;
}

Handle::~Handle()
{
  if (id_ >= 0) H5Idec_ref(id_);
}

Handle create_group(hid_t parent, const char* name, const std::string& file)
{
  Handle group(H5Gcreate2(parent, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  require(group.ok(), file, "cannot write", name);
  return group;
}

void write_text_attribute(hid_t object, const char* name, const std::string& text, const std::string& file)
{
  const Handle type = text_type(text.size()), space(H5Screate(H5S_SCALAR));
  const Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT));
  require(attribute.ok() && H5Awrite(attribute, type, text.c_str()) >= 0, file, "cannot write", name);
}

void write_int_attribute(hid_t object, const char* name, int value, const std::string& file)
{
  const Handle space(H5Screate(H5S_SCALAR));
  const Handle attribute(H5Acreate2(object, name, H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT));
  require(attribute.ok() && H5Awrite(attribute, H5T_NATIVE_INT, &value) >= 0, file, "cannot write", name);
}

void write_scalar(hid_t group, const Field& field, double value, const std::string& file)
{
  const Handle space(H5Screate(H5S_SCALAR));
  const Handle set(
      H5Dcreate2(group, field.name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  require(set.ok() && H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value) >= 0, file,
          "cannot write", field.name);
  describe(set, field, file);
}

void write_vector(hid_t group, const Field& field, std::span<const double> values, const std::string& file,
                  hid_t stored)
{
  const hsize_t extent = values.size();
  const Handle space(H5Screate_simple(1, &extent, nullptr));
  const Handle set(H5Dcreate2(group, field.name, stored, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  require(set.ok() && H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0,
          file, "cannot write", field.name);
  describe(set, field, file);
}

void write_texts(hid_t group, const char* name, const std::vector<std::string>& texts,
                 const std::string& file)
{
  std::size_t size = 1;
  for (const std::string& text : texts) size = std::max(size, text.size());
  std::string block(size * texts.size(), '\0');
  for (std::size_t k = 0; k < texts.size(); ++k) texts[k].copy(block.data() + k * size, size);
  const hsize_t extent = texts.size();
  const Handle type = text_type(size), space(H5Screate_simple(1, &extent, nullptr));
  const Handle set(H5Dcreate2(group, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  require(
      set.ok() && (texts.empty() || H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, block.data()) >= 0),
      file, "cannot write", name);
}

bool has_link(hid_t group, const char* name)
{
  return H5Lexists(group, name, H5P_DEFAULT) > 0;
}

Handle open_group(hid_t parent, const char* name, const std::string& file)
{
  require_own(parent, name, file, "the law file lacks the group");
  Handle group(H5Gopen2(parent, name, H5P_DEFAULT));
  require(group.ok(), file, "cannot read the group", name);
  return group;
}

std::string read_text_attribute(hid_t object, const char* name, const std::string& file)
{
  require(H5Aexists(object, name) > 0, file, "the law file lacks the attribute", name);
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT));
  require(attribute.ok(), file, "cannot read the attribute", name);
  const Handle type(H5Aget_type(attribute)), space(H5Aget_space(attribute));
  const std::size_t size = fixed_text_size(type, file, name);
  require(H5Sget_simple_extent_npoints(space) == 1, file, "one text expected in", name);
  std::string text(size, '\0');
  require(H5Aread(attribute, type, text.data()) >= 0, file, "cannot read the attribute", name);
  text = trimmed(text.data(), size);
  Checksum::add(name, text.data(), text.size());
  return text;
}

int read_int_attribute(hid_t object, const char* name, const std::string& file)
{
  require(H5Aexists(object, name) > 0, file, "the law file lacks the attribute", name);
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT));
  require(attribute.ok(), file, "cannot read the attribute", name);
  const Handle type(H5Aget_type(attribute)), space(H5Aget_space(attribute));
  int value = 0;
  require(H5Tget_class(type) == H5T_INTEGER && H5Tget_size(type) <= widest_number &&
              H5Sget_simple_extent_npoints(space) == 1,
          file, "one integer expected in", name);
  require(H5Aread(attribute, H5T_NATIVE_INT, &value) >= 0, file, "cannot read the attribute", name);
  return value;
}

double read_scalar(hid_t group, const Field& field, const std::string& file)
{
  const Handle set = open_numbers(group, field.name, file);
  const Handle space(H5Dget_space(set));
  double value = 0;
  require(H5Sget_simple_extent_npoints(space) == 1, file, "one number expected in", field.name);
  require_stored(set, file, field.name);
  require(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value) >= 0, file, "cannot read",
          field.name);
  Checksum::add(field.name, &value, sizeof value);
  return value;
}

std::vector<double> read_vector(hid_t group, const Field& field, std::size_t most, const std::string& file)
{
  const Handle set = open_numbers(group, field.name, file);
  const Handle space(H5Dget_space(set));
  require(H5Sget_simple_extent_ndims(space) == 1, file, "a list of numbers expected in", field.name);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (count < 0 || static_cast<std::size_t>(count) > most)
    fail(file, fmt::format("'{}' has an unusable number of values", field.name), std::to_string(count),
         fmt::format("up to {}", most));
  require_stored(set, file, field.name);
  std::vector<double> values(static_cast<std::size_t>(count));
  require(
      values.empty() || H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0,
      file, "cannot read", field.name);
  Checksum::add(field.name, values.data(), values.size() * sizeof(double));
  return values;
}

std::vector<std::string> read_texts(hid_t group, const char* name, std::size_t most, const std::string& file)
{
  const Handle set = open_dataset(group, name, file);
  const Handle type(H5Dget_type(set)), space(H5Dget_space(set));
  const std::size_t size = fixed_text_size(type, file, name);
  require(H5Sget_simple_extent_ndims(space) == 1, file, "a list of texts expected in", name);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  require(count >= 0 && static_cast<std::size_t>(count) <= most &&
              size * static_cast<std::size_t>(count) <= longest_text_list,
          file, "too much text in", name);
  if (count > 0) require_stored(set, file, name);
  std::string block(size * static_cast<std::size_t>(count), '\0');
  require(count == 0 || H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, block.data()) >= 0, file,
          "cannot read", name);
  std::vector<std::string> texts;
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
    texts.push_back(trimmed(block.data() + k * size, size));
  add_texts(name, texts);
  return texts;
}

namespace {

/// The `count` names that `read(k, buffer, size)` gives; what it returns is a name's length.
template <class Read>
std::vector<std::string> read_names(hsize_t count, const std::string& file, const char* unusable,
                                    const Read& read)
{
  std::vector<std::string> names;
  for (hsize_t k = 0; k < count; ++k) {
    char name[256];
    const ssize_t size = read(k, name, sizeof name);
    if (size <= 0 || size >= static_cast<ssize_t>(sizeof name)) fail(file, unusable);
    names.emplace_back(name);
  }
  add_texts("", names);
  return names;
}

}  // namespace

std::vector<std::string> link_names(hid_t group, std::size_t most, const std::string& file)
{
  H5G_info_t info{};
  if (H5Gget_info(group, &info) < 0 || info.nlinks > most)
    fail(file, "a group has an unusable number of entries", std::to_string(info.nlinks),
         fmt::format("up to {}", most));
  return read_names(
      info.nlinks, file, "a group has an unusable entry name", [&](hsize_t k, char* name, std::size_t size) {
        return H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, k, name, size, H5P_DEFAULT);
      });
}

std::vector<std::string> attribute_names(hid_t object, std::size_t most, const std::string& file)
{
  const int count = H5Aget_num_attrs(object);  // H5Oget_info2's structure differs between HDF5 1.10 and 1.14
  if (count < 0 || static_cast<std::size_t>(count) > most)
    fail(file, "an object has an unusable number of attributes", std::to_string(count), fmt::format("up to {}", most));
  return read_names(static_cast<hsize_t>(count), file, "an attribute has an unusable name",
                    [&](hsize_t k, char* name, std::size_t size) {
                      return H5Aget_name_by_idx(object, ".", H5_INDEX_NAME, H5_ITER_INC, k, name, size,
                                                H5P_DEFAULT);
                    });
}

}  // namespace granulaw::h5
