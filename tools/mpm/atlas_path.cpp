#include "characterise/atlas_file.hpp"
#include "atlas_path.hpp"

#include <cstdlib>
#include <filesystem>

namespace granulaw {

std::string own_file(const std::string& name)
{
  namespace fs = std::filesystem;
  const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
  for (const fs::path& candidate : {here / name, here / "../share/granulaw" / name})
    if (fs::exists(candidate)) return candidate.string();
  return {};
}

std::string atlas_path()
{
  if (const char* chosen = std::getenv("GRANULAW_ATLAS"); chosen && *chosen) return chosen;
  return own_file("atlas.h5");
}

std::optional<Atlas> own_atlas()
{
  const std::string path = atlas_path();
  if (path.empty()) return std::nullopt;
  return read_atlas(path);
}

}  // namespace granulaw
