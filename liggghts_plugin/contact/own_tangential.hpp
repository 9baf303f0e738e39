#pragma once

#include "contact/tangential.hpp"
#include "liggghts_plugin/contact/plastic_model.hpp"

namespace granulaw::plugin {

/// A tangential law of ours in the place of LIGGGHTS's: it has the normal law of the contact and its memory.
/// Made of a pair's ShearPair, or of it, the normal law and BodiesInShear. Spheres alone.
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
  void follow(PlasticModel<Physics>& normal) { normal_ = &normal; }

  void registerSettings(Settings&) override {}
  void postSettings(LIGGGHTS::IContactHistorySetup*, cm::ContactModelBase*) override {}
  void connectToProperties(PropertyRegistry& registry) override
  {
    registry.registerProperty("coeffFrict", &MODEL_PARAMS::createCoeffFrict);
    registry.connect("coeffFrict", friction_, "tangential model");
    laws_ = normal_->template tangential_laws<Law>(friction_);
  }

  void surfacesIntersect(const SurfacesIntersectData& s, ForceData& on_i, ForceData& on_j) override
  {
    if (s.contact_flags) *s.contact_flags |= CONTACT_TANGENTIAL_MODEL;
    const auto& entry = normal_->entry_of(s);
    const Law& law = laws_[normal_->place(entry)];
    double* const depth = normal_->kept_of(s.contact_history);
    const double before = *depth, r_eff = effective_radius(s);
    const bool held = normal_->was_held();
    ContactMotion motion{{r_eff, s.deltan, -s.vn, s.computeflag && s.shearupdate && !held},
                         s.meff,
                         update->dt,
                         {s.en[0], s.en[1], s.en[2]},
                         {s.vtr1, s.vtr2, s.vtr3}};
    double shorter = 0.0;
    if constexpr (requires { law.turns(); })
      if (law.turns()) {
        motion.turn = rolling(s);
        shorter = shorter_lever(s);
        if (shorter != 0.0) {  // nearer to the centre the spin moves the surface less
          const double omega[3] = {s.omega_i[0], s.omega_i[1], s.omega_i[2]};
          const Vector of_spin = cross(omega, s.en);
          for (int c = 0; c < 3; ++c) motion.slide[c] += shorter * of_spin[c];
        }
      }
    double normal_force = s.Fn;
    Ledger books;
    const Grip grip = law.advance(entry.contact, motion, normal_force, depth, s.contact_history + offset_, books);
    if (*depth != before) {
      normal_->change_depth(s, entry, r_eff, before);
      // it goes deeper, though its overlap is less than its depth: `elasticDamping` is of contacts that return
      if (*depth > before && s.vn < 0.0) normal_force = std::max(normal_force + s.gamman * s.vn, 0.0);
    }
    normal_->book(s, entry, books);
    add(s, grip, shorter, normal_force - s.Fn, on_i, on_j);
  }

  void surfacesClose(cm::SurfacesCloseData& contact, ForceData&, ForceData&) override
  {
    if (contact.contact_flags) *contact.contact_flags &= ~CONTACT_TANGENTIAL_MODEL;
    if (contact.contact_history) std::fill_n(contact.contact_history + offset_, values_of(Law::keeps), 0.0);
  }
  void beginPass(SurfacesIntersectData&, ForceData&, ForceData&) override {}
  void endPass(SurfacesIntersectData&, ForceData&, ForceData&) override {}

 private:
  /// (omega_i - omega_j) x en; walls do not turn.
  static Vector rolling(const SurfacesIntersectData& s)
  {
    double omega[3];
    for (int c = 0; c < 3; ++c) omega[c] = s.omega_i[c] - (s.is_wall ? 0.0 : s.omega_j[c]);
    return cross(omega, s.en);
  }
  /// m, by which the tangential force acts nearer to the centre than LIGGGHTS has it. On a rigid wall that is at
  /// R - d, with the overlap d of the real contact; LIGGGHTS says R - d/2, which two like bodies have.
  double shorter_lever(const SurfacesIntersectData& s) const
  {
    return normal_->rigid_wall() ? s.cri - (s.radi - s.deltan * normal_->per_stretch()) : 0.0;
  }

  /// The shear force, its torques and the couple, and the change of the normal force.
  static void add(const SurfacesIntersectData& s, const Grip& grip, double shorter, double more, ForceData& on_i,
                  ForceData& on_j)
  {
    const Vector torque = cross(s.en, grip.force);
    const double share = s.is_wall ? s.area_ratio : 1.0, lever = s.cri - shorter;
    for (int c = 0; c < 3; ++c) {
      on_i.delta_F[c] += grip.force[c] * share;
      on_i.delta_torque[c] += -lever * torque[c] * share;
      if (grip.couple[c] != 0.0) on_i.delta_torque[c] += grip.couple[c] * share;
      if (more != 0.0) on_i.delta_F[c] += more * s.en[c] * share;
      if (s.is_wall) continue;
      on_j.delta_F[c] += -grip.force[c];
      on_j.delta_torque[c] += -s.crj * torque[c];
      if (grip.couple[c] != 0.0) on_j.delta_torque[c] -= grip.couple[c];
      if (more != 0.0) on_j.delta_F[c] -= more * s.en[c];
    }
  }

  PlasticModel<Physics>* normal_ = nullptr;
  std::vector<Law> laws_;  // by PlasticModel::place
  double** friction_ = nullptr;
  int offset_;
};

}  // namespace granulaw::plugin
