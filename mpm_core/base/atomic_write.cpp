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

}  // namespace

void write_atomically(const std::string& path, const std::function<void(const std::string&)>& write)
{
  const std::string temporary = temporary_name(path);
  try {
    write(temporary);
    if (std::rename(temporary.c_str(), path.c_str()) != 0)
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
  const fs::path target(path);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (fs::is_directory(target)) fail(where, fmt::format("'{}' is a folder, not a file", path));
  if (!fs::is_directory(folder)) fail(where, fmt::format("the folder '{}' does not exist", folder.string()));
  const std::string probe = temporary_name(path);  // permissions alone do not show it: /proc, a full disk
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
