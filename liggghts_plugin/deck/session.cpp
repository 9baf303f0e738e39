#include "liggghts_plugin/deck/session.hpp"

#include <map>

#include "liggghts_plugin/engine/liggghts.hpp"

namespace granulaw::plugin {


std::shared_ptr<Session> Session::of(LAMMPS_NS::LAMMPS* lmp)
{
  static std::map<LAMMPS_NS::LAMMPS*, std::weak_ptr<Session>> sessions;
  std::weak_ptr<Session>& slot = sessions[lmp];
  std::shared_ptr<Session> session = slot.lock();
  if (!session) slot = session = std::make_shared<Session>();
  return session;
}

std::string Setup::command() const
{
  const std::string id = wall ? wall->id : pairs_record;
  return wall && id == pairs_record ? "fix " + id : id;
}

}  // namespace granulaw::plugin
