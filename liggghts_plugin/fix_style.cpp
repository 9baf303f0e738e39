#include "liggghts_plugin/fix_style.hpp"

namespace granulaw::plugin {

namespace {

// Modify::fix_map is private, and LIGGGHTS has no call that adds a fix style. An explicit instantiation may
// name private members ([temp.spec]), so it can hand out the pointer to member.
template <class Tag, auto member>
struct Expose
{
  friend auto exposed(Tag) { return member; }
};
struct FixMapTag
{
  friend auto exposed(FixMapTag);
};
template struct Expose<FixMapTag, &LAMMPS_NS::Modify::fix_map>;

}  // namespace

void register_fix_style(LAMMPS_NS::LAMMPS* lmp, const char* name, FixCreator create)
{
  (lmp->modify->*exposed(FixMapTag{}))->emplace(name, create);
}

}  // namespace granulaw::plugin
