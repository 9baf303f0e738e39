#include "liggghts_plugin/styles.hpp"
#include "liggghts_plugin/thornton_physics.hpp"

namespace LIGGGHTS::ContactModels {

template <>
class NormalModel<granulaw::plugin::thornton_id>
    : public granulaw::plugin::PlasticModel<granulaw::plugin::ThorntonPhysics>
{
 public:
  using PlasticModel::PlasticModel;
};

}  // namespace LIGGGHTS::ContactModels

namespace granulaw::plugin {

void register_thornton()
{
  register_model<thornton_id, Model::thornton>();
}

}  // namespace granulaw::plugin
