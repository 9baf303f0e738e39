#include <dlfcn.h>
#include <fmt/format.h>
#include <malloc.h>

#include <cstring>

#include "liggghts_plugin/liggghts.hpp"
#include "liggghts_plugin/session.hpp"

namespace granulaw::plugin {

namespace {

constexpr const char* built_for = "LIGGGHTS-PUBLIC 3.8.0";

[[noreturn]] void refuse(LAMMPS_NS::LAMMPS* lmp, const std::string& why)
{
  stop_all(lmp, fmt::format("granulaw was built for {} without superquadrics (Debian's liggghts): {}",
                            built_for, why));
}

}  // namespace

void check_liggghts(LAMMPS_NS::LAMMPS* lmp, const void* parent, std::size_t parent_size, const char* what)
{
  const char* version = lmp->universe && lmp->universe->version ? lmp->universe->version : "unknown";
  if (!std::strstr(version, built_for)) refuse(lmp, fmt::format("this is '{}'", version));
  // Only builds with superquadrics have this class, and their structures are laid out differently.
  if (dlsym(RTLD_DEFAULT, "_ZTVN9LAMMPS_NS19AtomVecSuperquadricE"))
    refuse(lmp, "this LIGGGHTS was built with superquadrics");
  // malloc rounds up to 16 bytes and keeps a word for itself: the block is at most 24 bytes larger than
  // asked.
  const std::size_t block = malloc_usable_size(const_cast<void*>(parent));
  if (block < parent_size || block > parent_size + 24)
    refuse(lmp, fmt::format("its {} takes {} bytes, {} expected", what, block, parent_size));
}

}  // namespace granulaw::plugin
