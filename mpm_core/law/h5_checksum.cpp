#include "law/h5_checksum.hpp"

#include <fmt/format.h>

#include <cstring>

#include "base/error.hpp"

namespace granulaw::h5 {

namespace {

thread_local Checksum* current = nullptr;

constexpr const char* checksum_attribute = "checksum";  // of the root group

std::uint64_t continued(std::uint64_t hash, const void* data, std::size_t bytes)
{
  const auto* byte = static_cast<const unsigned char*>(data);
  for (std::size_t k = 0; k < bytes; ++k) hash = (hash ^ byte[k]) * 0x100000001b3u;
  return hash;
}

}  // namespace

Checksum::Checksum() : outer_(current)
{
  current = this;
}

Checksum::~Checksum()
{
  current = outer_;
}

void Checksum::add(const char* name, const void* values, std::size_t bytes)
{
  if (!current) return;
  constexpr std::uint64_t start = 0xcbf29ce484222325u;
  current->sum_ += continued(continued(start, name, std::strlen(name) + 1), values, bytes);
}

std::string Checksum::text() const
{
  return fmt::format("{:016x}", sum_);
}

std::string verify(hid_t file, const Checksum& found, bool required, const std::string& path)
{
  const std::string now = found.text();
  if (H5Aexists(file, checksum_attribute) <= 0) {
    if (required) fail(path, "is damaged: its checksum is missing; copy the file again, or make it anew");
    return {};
  }
  const std::string stored = read_text_attribute(file, checksum_attribute, path);
  if (stored != now)
    fail(path,
         "is damaged or was changed: its data do not have its checksum; copy the file again, or make it anew",
         now, stored);
  return now;
}

void write(hid_t file, const Checksum& found, const std::string& path)
{
  write_text_attribute(file, checksum_attribute, found.text(), path);
}

}  // namespace granulaw::h5
