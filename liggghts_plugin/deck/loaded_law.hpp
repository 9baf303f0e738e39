#pragma once

#include <memory>
#include <string>

#include "law/law.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace granulaw::plugin {

/// A law file in memory.
struct LoadedLaw
{
  std::string path;
  Law law;
};

/// Collective. Rank 0 reads `path` and hands the file's bytes to the others. Throws the same Error on all
/// ranks if it cannot be read, so that an MPI run stops with one sentence.
std::shared_ptr<const LoadedLaw> load_law(LAMMPS_NS::LAMMPS* lmp, const std::string& path,
                                          const std::string& where);

}  // namespace granulaw::plugin
