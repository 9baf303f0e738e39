#pragma once

#include <mpi.h>

#include <functional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace granulaw::plugin {

/// Particles whose numbers a command changed (delete_atoms, insertion with compress_tags), for those who name neighbours by number.
class NumberChanges
{
 public:
  /// `tags`: the numbers of this rank's particles now. `kept(i)`: the number of the i-th as its owner knows it, which is set to that
  /// of now; 0: it is new. Collective.
  NumberChanges(const int* tags, int count, const std::function<int&(int)>& kept, MPI_Comm world);

  bool none() const { return taken_.empty(); }
  /// The number now of what was `number`; 0: it was deleted, and another particle has its number.
  int now(int number) const;

 private:
  std::unordered_map<int, int> now_;
  std::unordered_set<int> taken_;
};

}  // namespace granulaw::plugin
