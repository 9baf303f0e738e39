#include "base/state_archive.hpp"

#include <fmt/format.h>

#include "base/error.hpp"

namespace granulaw {

std::uint64_t checksum(std::string_view bytes, std::uint64_t start)
{
  for (const char c : bytes) start = (start ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  return start;
}

void StateArchive::raw(void* x, std::size_t size)
{
  if (size == 0) return;
  if (!loading_) {
    bytes_.append(static_cast<const char*>(x), size);
    return;
  }
  if (size > bytes_.size() - at_) fail(where_, "its state of the run ends too early");
  std::memcpy(x, bytes_.data() + at_, size);
  at_ += size;
}

void StateArchive::value(bool& x)
{
  std::uint8_t byte = x;
  raw(&byte, 1);
  x = byte != 0;
}

void StateArchive::value(std::string& x)
{
  x.resize(count(x.size(), 1));
  raw(x.data(), x.size());
}

void StateArchive::expect(std::uint64_t own, const char* what)
{
  std::uint64_t stored = own;
  value(stored);
  if (stored != own)
    fail(where_, fmt::format("its state does not fit this run ({})", what), fmt::format("{:#x}", stored),
         fmt::format("{:#x}", own));
}

std::size_t StateArchive::count(std::size_t own, std::size_t bytes_each)
{
  std::uint64_t stored = own;
  value(stored);
  if (loading_ && stored > (bytes_.size() - at_) / bytes_each)
    fail(where_, "its state of the run ends too early");
  return static_cast<std::size_t>(stored);
}

void StateArchive::finish() const
{
  if (loading_ && at_ != bytes_.size()) fail(where_, "its state of the run is followed by something else");
}

}  // namespace granulaw
