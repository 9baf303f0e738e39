#pragma once

#include "contact/tangential.hpp"
#include "liggghts_plugin/contact/normal_host.hpp"

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
      : TangentialModelBase(lmp, hsetup, contact),
        offset_(add_history(*hsetup, Law::keeps)),
        largest_offset_(hsetup->add_history_value("largest_overlap", "0"))
  {
  }
  /// The contact's normal model, which is called before this one.
  void follow(NormalHost<Physics>& normal)
  {
    normal_ = &normal;
    normal.count_overlaps_at(largest_offset_);
  }

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
    double& largest = s.contact_history[largest_offset_];
    const double r_eff = effective_radius(s), shorter = shorter_lever(s, law);
    ContactMotion moves = motion(s, r_eff, shorter);
    moves.turn = rolling(s);
    if (s.deltan > largest && s.computeflag && s.shearupdate) {
      normal_->reach(s, entry, r_eff, largest);
      largest = s.deltan;
    }
    double* const depth = normal_->kept_of(s.contact_history);
    const double before = *depth;
    double normal_force = s.Fn;
    Ledger books;
    const Grip grip = law.advance(entry.contact, moves, normal_force, depth, s.contact_history + offset_, books);
    if (*depth != before || books[Mechanism::shear] != 0.0) normal_force = book(s, entry, r_eff, before, normal_force, books);
    add(s, grip.force, shorter, on_i, on_j);
    add_more(s, normal_force - s.Fn, grip.couple, on_i, on_j);
  }

  void surfacesClose(cm::SurfacesCloseData& contact, ForceData&, ForceData&) override
  {
    if (contact.contact_flags) *contact.contact_flags &= ~CONTACT_TANGENTIAL_MODEL;
    if (!contact.contact_history) return;
    std::fill_n(contact.contact_history + offset_, values_of(Law::keeps), 0.0);
    contact.contact_history[largest_offset_] = 0.0;
  }
  void beginPass(SurfacesIntersectData&, ForceData&, ForceData&) override {}
  void endPass(SurfacesIntersectData&, ForceData&, ForceData&) override {}

 private:
  /// Books a step of a law that took the contact's depth along; the normal force behind it. Apart from the loop over contacts,
  /// whose numbers live in registers: it gets a copy.
  template <class Entry>
  [[gnu::noinline]] double book(SurfacesIntersectData s, const Entry& entry, double r_eff, double before, double normal_force,
                                Ledger books) const
  {
    const double depth = *normal_->kept_of(s.contact_history);
    if (depth != before) normal_->change_depth(s, entry, r_eff, before);
    normal_->book(s, entry, books);
    // it goes deeper, though its overlap is less than its depth: `elasticDamping` is of contacts that return
    return depth > before && s.vn < 0.0 ? std::max(normal_force + s.gamman * s.vn, 0.0) : normal_force;
  }

  [[gnu::always_inline]] ContactMotion motion(const SurfacesIntersectData& s, double r_eff, double shorter)
  {
    const bool held = normal_->was_held();
    ContactMotion now{{r_eff, s.deltan, -s.vn, s.computeflag && s.shearupdate && !held},
                      s.meff,
                      update->dt,
                      {s.en[0], s.en[1], s.en[2]},
                      {s.vtr1, s.vtr2, s.vtr3}};
    if (shorter != 0.0)  // nearer to the centre the spin moves the surface less
      now.slide = sum(now.slide, cross(Vector{s.omega_i[0], s.omega_i[1], s.omega_i[2]}, now.normal), shorter);
    return now;
  }
  /// (omega_i - omega_j) x en; walls do not turn.
  static Vector rolling(const SurfacesIntersectData& s)
  {
    double omega[3];
    for (int c = 0; c < 3; ++c) omega[c] = s.omega_i[c] - (s.is_wall ? 0.0 : s.omega_j[c]);
    return cross(omega, s.en);
  }
  /// m, by which the tangential force acts nearer to the centre than LIGGGHTS has it. On a rigid wall that is at
  /// R - d, with the overlap d of the real contact; LIGGGHTS says R - d/2, which two like bodies have.
  double shorter_lever(const SurfacesIntersectData& s, const Law& law) const
  {
    if constexpr (requires { law.turns(); })
      if (s.is_wall && law.turns() && normal_->rigid_wall()) return s.cri - (s.radi - s.deltan * normal_->per_stretch());
    return 0.0;
  }

  static double share_of(const SurfacesIntersectData& s) { return s.is_wall ? s.area_ratio : 1.0; }
  /// The shear force and its torques.
  static void add(const SurfacesIntersectData& s, const Vector& shear, double shorter, ForceData& on_i, ForceData& on_j)
  {
    const Vector torque = cross(s.en, shear);
    const double share = share_of(s), lever = s.cri - shorter;
    for (int c = 0; c < 3; ++c) {
      on_i.delta_F[c] += shear[c] * share;
      on_i.delta_torque[c] += -lever * torque[c] * share;
      if (s.is_wall) continue;
      on_j.delta_F[c] += -shear[c];
      on_j.delta_torque[c] += -s.crj * torque[c];
    }
  }
  /// The change of the normal force, N, and the couple.
  static void add_more(const SurfacesIntersectData& s, double force, const Vector& couple, ForceData& on_i, ForceData& on_j)
  {
    const double share = share_of(s);
    for (int c = 0; c < 3; ++c) {
      on_i.delta_F[c] += force * s.en[c] * share;
      on_i.delta_torque[c] += couple[c] * share;
      if (s.is_wall) continue;
      on_j.delta_F[c] -= force * s.en[c];
      on_j.delta_torque[c] -= couple[c];
    }
  }

  NormalHost<Physics>* normal_ = nullptr;
  std::vector<Law> laws_;  // by NormalHost::place
  double** friction_ = nullptr;
  int offset_, largest_offset_;
};

}  // namespace granulaw::plugin
