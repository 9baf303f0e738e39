#pragma once

#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace granulaw::tests {

/// Ends a fuzz target: libFuzzer, or the replay of a corpus, reports the input.
[[noreturn]] inline void finding(const std::string& what)
{
  std::fprintf(stderr, "finding: %s\n", what.c_str());
  std::abort();
}

/// Fault of the sentence of an Error about the file `path`; "" if none.
inline std::string unclear(const std::string& sentence, const std::string& path)
{
  if (!sentence.starts_with(path)) return "does not name the file";
  if (sentence.size() > path.size() + 600) return "too long";  // a name of 255 bytes twice, and the words
  for (const char c : sentence)
    if (std::iscntrl(static_cast<unsigned char>(c))) return "holds a control character";
  return "";
}

/// Folder in which targets write the files that they read: in memory if there is such a folder.
inline std::filesystem::path scratch()
{
  namespace fs = std::filesystem;
  return fs::exists("/dev/shm") ? fs::path("/dev/shm") : fs::temp_directory_path();
}

}  // namespace granulaw::tests
