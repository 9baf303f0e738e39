#include "base/atomic_write.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "base/error.hpp"

namespace granulaw {

namespace fs = std::filesystem;

namespace {

/// A name beside `path` that no other thread, process or machine that shares the folder takes.
std::string temporary_name(const std::string& path)
{
  static std::atomic<long> count{0};
  char host[256] = "";
  gethostname(host, sizeof host - 1);
  const fs::path target(path);
  return (target.parent_path() / fmt::format(".{}.tmp{}-{}-{}{}", target.stem().string(), host, getpid(),
                                             count++, target.extension().string()))
      .string();
}

/// Throws Error where something other than a regular file, or nothing, has this name: a rename would replace it.
void require_regular(const std::string& path, const std::string& where)
{
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_directory(status)) fail(where, fmt::format("'{}' is a folder, not a file", path));
  if (fs::exists(status) && !fs::is_regular_file(status))
    fail(where, fmt::format("'{}' is no regular file (a device or a pipe), and results are not written there", path));
}

}  // namespace

std::string linked_file(const std::string& path)
{
  constexpr int most = 40;  // as the kernel
  fs::path file(path);
  std::error_code error;
  for (int links = 0; fs::is_symlink(file, error); ++links) {
    if (links == most) fail(path, "is a link that leads to itself");
    file = file.parent_path() / fs::read_symlink(file);  // an absolute one replaces what stands before it
  }
  return file.string();
}

void write_atomically(const std::string& path, const std::function<void(const std::string&)>& write)
{
  require_regular(path, path);
  const std::string file = linked_file(path), temporary = temporary_name(file);
  try {
    write(temporary);
    if (std::rename(temporary.c_str(), file.c_str()) != 0)
      fail(path, fmt::format("cannot be written ({})", std::strerror(errno)));
  } catch (...) {
    std::remove(temporary.c_str());
    throw;
  }
}

void write_text_atomically(const std::string& path, const std::string& text)
{
  write_atomically(path, [&](const std::string& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    out.close();
    if (!out) fail(path, "cannot be written (disk full?)");
  });
}

void require_writable(const std::string& path, const std::string& where)
{
  require_regular(path, where);
  const fs::path target(linked_file(path));
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(folder)) fail(where, fmt::format("the folder '{}' does not exist", folder.string()));
  const std::string probe = temporary_name(target.string());  // permissions alone do not show it: /proc, a full disk
  const bool written = static_cast<bool>(std::ofstream(probe));
  std::remove(probe.c_str());
  if (!written) fail(where, fmt::format("the folder '{}' cannot be written to", folder.string()));
}

void check_output(const std::string& option, const std::string& path, const std::string& endings)
{
  if (path.empty()) return;
  const std::string ending = fs::path(path).extension().string();
  if (ending.empty() || endings.find(ending) == std::string::npos)
    fail(option, "the ending of an output name says its format", path, endings);
  require_writable(path, path);
}

}  // namespace granulaw
