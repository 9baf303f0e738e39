#include "base/atomic_write.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "base/error.hpp"

namespace granulaw {

namespace fs = std::filesystem;

void write_atomically(const std::string& path, const std::function<void(const std::string&)>& write)
{
  const fs::path target(path);
  const std::string temporary = (target.parent_path() / fmt::format(".{}.tmp{}{}", target.stem().string(),
                                                                    getpid(), target.extension().string()))
                                    .string();
  try {
    write(temporary);
    if (std::rename(temporary.c_str(), path.c_str()) != 0)
      fail(path, fmt::format("cannot be written ({})", std::strerror(errno)));
  } catch (...) {
    std::remove(temporary.c_str());
    throw;
  }
}

void require_writable(const std::string& path, const std::string& where)
{
  const fs::path target(path);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (fs::is_directory(target)) fail(where, fmt::format("'{}' is a folder, not a file", path));
  if (!fs::is_directory(folder)) fail(where, fmt::format("the folder '{}' does not exist", folder.string()));
  if (access(folder.c_str(), W_OK) != 0)
    fail(where, fmt::format("the folder '{}' cannot be written to", folder.string()));
}

}  // namespace granulaw
