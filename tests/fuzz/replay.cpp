// Runs a fuzz target on kept inputs, without libFuzzer: each file of the folders given, one after the other.
// A finding aborts. usage: PROGRAM FOLDER...
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "counted_memory.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int count, char** folders)
{
  // libFuzzer's -malloc_limit_mb of tools/fuzz; the largest law allowed takes 30 MB
  constexpr std::size_t most_bytes = 64u << 20;
  int files = 0;
  for (int k = 1; k < count; ++k)
    for (const auto& entry : std::filesystem::directory_iterator(folders[k])) {
      std::ifstream file(entry.path(), std::ios::binary);
      const std::string bytes{std::istreambuf_iterator<char>(file), {}};
      std::printf("%s\n", entry.path().c_str());
      std::fflush(stdout);  // the last line names the file that aborts
      const granulaw::tests::CountedMemory memory;
      LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
      if (memory.peak() > most_bytes) {
        std::printf("finding: %zu bytes allocated\n", memory.peak());
        return 1;
      }
      ++files;
    }
  std::printf("%d files\n", files);
  return files > 0 ? 0 : 1;
}
