#include "characterise/atlas_file.hpp"
#include "atlas_path.hpp"

#include <cstdlib>

#include "deck/process.hpp"

namespace granulaw {

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
