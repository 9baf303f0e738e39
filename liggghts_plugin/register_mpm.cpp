#include "liggghts_plugin/mpm_physics.hpp"
#include "liggghts_plugin/styles.hpp"

namespace LIGGGHTS::ContactModels {

template <>
class NormalModel<granulaw::plugin::mpm_id>
    : public granulaw::plugin::PlasticModel<granulaw::plugin::MpmPhysics>
{
 public:
  using PlasticModel::PlasticModel;
};

}  // namespace LIGGGHTS::ContactModels

namespace granulaw::plugin {

void register_mpm()
{
  register_model<mpm_id, Model::mpm>();
}

}  // namespace granulaw::plugin
