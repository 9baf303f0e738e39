#pragma once

#include "contact/tangential.hpp"
#include "liggghts_plugin/contact/plastic_model.hpp"

namespace granulaw::plugin {

/// A tangential law of ours in the place of LIGGGHTS's: it has the normal law of the contact and its memory.
/// Made of a pair's ShearPair for each contact. Spheres alone.
template <NormalPhysics Physics, TangentialLaw<typename Physics::Contact> Law>
class OwnTangential : public cm::TangentialModelBase
{
  using SurfacesIntersectData = cm::SurfacesIntersectData;
  using ForceData = cm::ForceData;

 public:
  OwnTangential(LAMMPS* lmp, LIGGGHTS::IContactHistorySetup* hsetup, cm::ContactModelBase* contact)
      : TangentialModelBase(lmp, hsetup, contact), offset_(add_history(*hsetup, Law::keeps))
  {
  }
  /// The contact's normal model, which is called before this one.
  void follow(const PlasticModel<Physics>& normal) { normal_ = &normal; }

  void registerSettings(Settings&) override {}
  void postSettings(LIGGGHTS::IContactHistorySetup*, cm::ContactModelBase*) override {}
  void connectToProperties(PropertyRegistry& registry) override
  {
    registry.registerProperty("coeffFrict", &MODEL_PARAMS::createCoeffFrict);
    registry.connect("coeffFrict", friction_, "tangential model");
  }

  void surfacesIntersect(const SurfacesIntersectData& s, ForceData& on_i, ForceData& on_j) override
  {
    if (s.contact_flags) *s.contact_flags |= CONTACT_TANGENTIAL_MODEL;
    const auto& entry = normal_->entry_of(s);
    const Law law(ShearPair{entry.tangential, friction_[s.itype][s.jtype], entry.tangential_damping});
    const ContactMotion motion{{effective_radius(s), s.deltan, -s.vn, s.computeflag && s.shearupdate},
                               s.meff,
                               update->dt,
                               {s.en[0], s.en[1], s.en[2]},
                               {s.vtr1, s.vtr2, s.vtr3}};
    double normal_force = s.Fn;
    Ledger books;
    const Vector shear = law.advance(entry.contact, motion, normal_force, normal_->kept_of(s.contact_history),
                                     s.contact_history + offset_, books);
    normal_->book(s, entry, books);
    add(s, shear, normal_force - s.Fn, on_i, on_j);
  }

  void surfacesClose(cm::SurfacesCloseData& contact, ForceData&, ForceData&) override
  {
    if (contact.contact_flags) *contact.contact_flags &= ~CONTACT_TANGENTIAL_MODEL;
    if (contact.contact_history) std::fill_n(contact.contact_history + offset_, values_of(Law::keeps), 0.0);
  }
  void beginPass(SurfacesIntersectData&, ForceData&, ForceData&) override {}
  void endPass(SurfacesIntersectData&, ForceData&, ForceData&) override {}

 private:
  /// The shear force, its torques, and the change of the normal force.
  static void add(const SurfacesIntersectData& s, const Vector& shear, double more, ForceData& on_i,
                  ForceData& on_j)
  {
    const double* n = s.en;
    const double torque[3] = {n[1] * shear[2] - n[2] * shear[1], n[2] * shear[0] - n[0] * shear[2],
                              n[0] * shear[1] - n[1] * shear[0]};
    const double share = s.is_wall ? s.area_ratio : 1.0;
    for (int c = 0; c < 3; ++c) {
      on_i.delta_F[c] += shear[c] * share;
      on_i.delta_torque[c] += -s.cri * torque[c] * share;
      if (more != 0.0) on_i.delta_F[c] += more * n[c] * share;
      if (s.is_wall) continue;
      on_j.delta_F[c] += -shear[c];
      on_j.delta_torque[c] += -s.crj * torque[c];
      if (more != 0.0) on_j.delta_F[c] -= more * n[c];
    }
  }

  const PlasticModel<Physics>* normal_ = nullptr;
  double** friction_ = nullptr;
  int offset_;
};

}  // namespace granulaw::plugin
