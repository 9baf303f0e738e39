#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <string>

namespace granulaw::plugin::plan {

/// Writes a file though those of the deck are closed (deck_files.hpp), by calls that a handler of signals may make.
inline bool write_result(const std::string& path, const std::string& text)
{
  const int out = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  std::size_t done = 0;
  for (ssize_t n; out >= 0 && done < text.size(); done += static_cast<std::size_t>(n))
    if ((n = write(out, text.data() + done, text.size() - done)) <= 0) break;
  return out >= 0 && done == text.size() && close(out) == 0;
}

}  // namespace granulaw::plugin::plan
