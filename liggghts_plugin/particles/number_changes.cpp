#include "liggghts_plugin/particles/number_changes.hpp"

#include "liggghts_plugin/engine/gather.hpp"

namespace granulaw::plugin {

NumberChanges::NumberChanges(const int* tags, int count, const std::function<int&(int)>& kept, MPI_Comm world)
{
  std::vector<int> own;  // old and new number, in turn
  for (int i = 0; i < count; ++i)
    if (int& number = kept(i); number != tags[i]) {
      own.insert(own.end(), {number, tags[i]});
      number = tags[i];
    }
  const std::vector<int> changed = gather(own, world);
  for (std::size_t k = 0; k < changed.size(); k += 2) {
    if (changed[k] != 0) now_[changed[k]] = changed[k + 1];
    taken_.insert(changed[k + 1]);
  }
}

int NumberChanges::now(int number) const
{
  const auto renamed = now_.find(number);
  if (renamed != now_.end()) return renamed->second;
  return taken_.contains(number) ? 0 : number;
}

}  // namespace granulaw::plugin
