#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "law/h5.hpp"

namespace granulaw::h5 {

/// Checksum of the data of a file: everything that the reading functions of h5.hpp return on this thread
/// while the object lives.
///
/// Sum modulo 2^64 of one 64-bit FNV-1a hash for each dataset, attribute and list of names that is read: over
/// its name, a zero byte, and its values as stored (IEEE doubles, low byte first; texts of a list with a zero
/// byte after each). A change of any single byte changes the hash of that item, and with it the sum. The sum
/// does not depend on the order of reading.
class Checksum
{
 public:
  Checksum();
  ~Checksum();
  Checksum(const Checksum&) = delete;
  Checksum& operator=(const Checksum&) = delete;

  /// 16 hexadecimal digits.
  std::string text() const;
  /// Adds one item to the checksum that lives on this thread, if any.
  static void add(const char* name, const void* values, std::size_t bytes);

 private:
  std::uint64_t sum_ = 0;
  Checksum* outer_;
};

/// Compares with the attribute `checksum` of the file. Throws Error where they differ, or where the attribute
/// is missing and `required`. Returns the checksum; empty: the file has none.
std::string verify(hid_t file, const Checksum& found, bool required, const std::string& path);
/// Stores it.
void write(hid_t file, const Checksum& found, const std::string& path);

}  // namespace granulaw::h5
