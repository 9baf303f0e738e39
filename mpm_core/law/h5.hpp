#pragma once

#include <hdf5.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

/// A thin, owning layer over the HDF5 C API: what this project needs of it and no more.
/// Every failure is an Error with the file's name and one sentence; HDF5's own error stack stays silent.
namespace granulaw::h5 {

struct Field;

/// While one lives, HDF5 prints nothing.
class Silence
{
 public:
  Silence();
  ~Silence();
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// Owns any HDF5 identifier.
class Handle
{
 public:
  Handle() = default;
  explicit Handle(hid_t id) : id_(id) {}
  Handle(Handle&& other) noexcept : id_(other.id_) { other.id_ = -1; }
  Handle& operator=(Handle&& other) noexcept;
  ~Handle();
  operator hid_t() const { return id_; }  // so that it can be passed to the C API
  bool ok() const { return id_ >= 0; }

 private:
  hid_t id_ = -1;
};

// Writing. `file` is the name that messages lead with.
Handle create_group(hid_t parent, const char* name, const std::string& file);
void write_text_attribute(hid_t object, const char* name, const std::string& text, const std::string& file);
void write_int_attribute(hid_t object, const char* name, int value, const std::string& file);
void write_scalar(hid_t group, const Field& field, double value, const std::string& file);
/// `stored`: the type in the file; with H5T_IEEE_F32LE numbers are rounded to single precision.
void write_vector(hid_t group, const Field& field, std::span<const double> values, const std::string& file,
                  hid_t stored = H5T_IEEE_F64LE);
/// A one-dimensional dataset of fixed-length UTF-8 strings.
void write_texts(hid_t group, const char* name, const std::vector<std::string>& texts,
                 const std::string& file);

// Reading: type and extent are checked before anything is allocated; what is not stored plainly in this file
// itself (links, external, virtual, compressed or unwritten data) is refused.
bool has_link(hid_t group, const char* name);
Handle open_group(hid_t parent, const char* name, const std::string& file);
std::string read_text_attribute(hid_t object, const char* name, const std::string& file);
int read_int_attribute(hid_t object, const char* name, const std::string& file);
double read_scalar(hid_t group, const Field& field, const std::string& file);
std::vector<double> read_vector(hid_t group, const Field& field, std::size_t most, const std::string& file);
std::vector<std::string> read_texts(hid_t group, const char* name, std::size_t most, const std::string& file);
/// Names of the links of a group, at most `most`.
std::vector<std::string> link_names(hid_t group, std::size_t most, const std::string& file);
/// Names of the attributes of an object, at most `most`.
std::vector<std::string> attribute_names(hid_t object, std::size_t most, const std::string& file);

}  // namespace granulaw::h5
