#pragma once

#include <hdf5.h>

#include <functional>
#include <string>
#include <vector>

namespace granulaw::tests {

/// One way to spoil a good law file, through the HDF5 API: what comes out is a well-formed HDF5 file, so that
/// the law reader and not HDF5 has to see what is wrong.
struct Damage
{
  std::string name;                   ///< for messages
  std::function<void(hid_t)> change;  ///< applied to the file opened for writing; may fail silently
  bool big = false;                   ///< writes megabytes: once is enough
  bool leads_away = false;            ///< to another file: a further change would go there, or hang
};

/// Applies the damages in order, of those that lead away only the first, as the last.
void spoil(hid_t file, const std::vector<const Damage*>& damages);

/// Every damage to every dataset, group and attribute of the file that SyntheticLaw::whole_law() writes.
/// `folder` must hold `other.h5`, a good law, and `fifo`, a named pipe that nobody writes to: links lead
/// there.
std::vector<Damage> hostile_damages(const std::string& folder);

}  // namespace granulaw::tests
