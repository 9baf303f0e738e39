#pragma once

#include <map>
#include <memory>
#include <string>

#include "law/law.hpp"
#include "liggghts_plugin/dissipation.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace granulaw::plugin {

/// A law file in memory, with the work tables that the ledger needs.
struct LoadedLaw
{
  std::string path;
  Law law;
  std::map<std::string, DissipationTable> dissipation;  ///< by material
};

/// Reads `path` on every rank. Throws the same Error on all ranks if any rank cannot read it, so that an MPI
/// run stops with one sentence.
std::shared_ptr<const LoadedLaw> load_law(LAMMPS_NS::LAMMPS* lmp, const std::string& path, const std::string& where);

}  // namespace granulaw::plugin
