#pragma once

#include <fmt/format.h>

#include <algorithm>

#include "liggghts_plugin/books/energy_tally.hpp"
#include "liggghts_plugin/contact/contact_pieces.hpp"
#include "liggghts_plugin/contact/own_tangential.hpp"
#include "liggghts_plugin/contact/normal_host.hpp"

namespace granulaw::plugin {

/// A contact of five pieces, in the place of LIGGGHTS's own (ContactModels::ContactModel): a normal model of
/// ours, and LIGGGHTS's surface, cohesion, tangential and rolling models, each Fixed, Chosen or Off. With
/// `energy on` it books the work of all but the normal law.
template <NormalPhysics OwnPhysics, int surface, class Cohesion, class Tangential, class Rolling>
class ComposedContact final : public cm::ContactModelBase
{
  using ForceData = cm::ForceData;
  using SurfacesIntersectData = cm::SurfacesIntersectData;

 public:
  using Physics = OwnPhysics;
  static constexpr bool superquadric = surface == cm::SURFACE_SUPERQUADRIC;

  ComposedContact(LAMMPS* lmp, LIGGGHTS::IContactHistorySetup* hsetup, bool is_wall, int64_t hash)
      : ContactModelBase(lmp, is_wall),
        lmp_(lmp),
        ids_(ModelIds::of(hash)),
        surface_(lmp, hsetup, this, surface),
        normal_(lmp, hsetup, this, ids_.normal),
        cohesion_(lmp, hsetup, this, ids_.cohesion),
        tangential_(lmp, hsetup, this, ids_.tangential),
        rolling_(lmp, hsetup, this, ids_.rolling)
  {
    if constexpr (requires { tangential_->follow(*normal_.operator->()); }) tangential_->follow(*normal_.operator->());
  }

  int64_t hashcode() const { return ids_.hash(); }
  bool contact_match(const std::string& kind, const std::string& model) const
  {
    cm::Factory& known = cm::Factory::instance();
    if (kind == "surface") return ids_.surface == known.getSurfaceModelId(model);
    if (kind == "normal") return ids_.normal == known.getNormalModelId(model);
    if (kind == "cohesion") return ids_.cohesion == known.getCohesionModelId(model);
    if (kind == "tangential") return ids_.tangential == known.getTangentialModelId(model);
    return kind == "rolling_friction" && ids_.rolling == known.getRollingModelId(model);
  }

  void registerSettings(Settings& settings)
  {
    each([&](auto& piece) { piece->registerSettings(settings); });
  }
  void postSettings(LIGGGHTS::IContactHistorySetup* hsetup)
  {
    each([&](auto& piece) { piece->postSettings(hsetup, this); });
    tally_ = Setup::current->session->energy;
    if (!tally_) return;
    for (int k = 0; k < EnergyTally::history_values; ++k) {
      const int offset = hsetup->add_history_value(fmt::format("other_force_{}", k), "1");
      if (k == 0) offset_ = offset;
    }
  }
  void connectToProperties(PropertyRegistry& registry)
  {
    each([&](auto& piece) { piece->connectToProperties(registry); });
  }
  double stressStrainExponent() { return normal_->stressStrainExponent(); }
  void tally_pp(double value, int i, int j, int index) override { surface_->tally_pp(value, i, j, index); }
  void tally_pw(double value, int i, int j, int index) override { surface_->tally_pw(value, i, j, index); }

  /// True: particles that do not touch may act on each other.
  bool acts_at_distance() const
  {
    if constexpr (requires { Cohesion::always_off; })
      return false;
    else
      return ids_.has_bridges();
  }

  void beginPass(SurfacesIntersectData& contact, ForceData& on_i, ForceData& on_j)
  {
    each([&](auto& piece) { piece->beginPass(contact, on_i, on_j); });
  }
  void endPass(SurfacesIntersectData& contact, ForceData& on_i, ForceData& on_j)
  {
    each([&](auto& piece) { piece->endPass(contact, on_i, on_j); });
  }
  bool checkSurfaceIntersect(SurfacesIntersectData& contact)
  {
    return surface_->checkSurfaceIntersect(contact);
  }
  void surfacesIntersect(SurfacesIntersectData& contact, ForceData& on_i, ForceData& on_j)
  {
    each([&](auto& piece) { piece->surfacesIntersect(contact, on_i, on_j); });
    if (tally_) [[unlikely]]
      tally_->account(contact, on_i, &contact.contact_history[offset_], lmp_->update->dt,
                      lmp_->atom->nlocal);
  }
  void endSurfacesIntersect(SurfacesIntersectData& contact, LAMMPS_NS::TriMesh* mesh, ForceData& on_i,
                            ForceData& on_j)
  {
    surface_->endSurfacesIntersect(contact, mesh, on_i.delta_F);
    if (cohesion_) cohesion_->endSurfacesIntersect(contact, on_i, on_j);
  }
  void surfacesClose(cm::SurfacesCloseData& contact, ForceData& on_i, ForceData& on_j)
  {
    each([&](auto& piece) { piece->surfacesClose(contact, on_i, on_j); });
    if (tally_ && contact.contact_history)
      std::fill_n(&contact.contact_history[offset_], EnergyTally::history_values, 0.0);
  }

 private:
  /// Calls visit for each piece that is on, in LIGGGHTS's order.
  template <class Visit>
  [[gnu::always_inline]] void each(Visit&& visit)
  {
    visit(surface_);
    visit(normal_);
    if (cohesion_) visit(cohesion_);
    if (tangential_) visit(tangential_);
    if (rolling_) visit(rolling_);
  }

  LAMMPS* lmp_;
  ModelIds ids_;
  Fixed<cm::SurfaceModel<surface>> surface_;
  Fixed<NormalHost<Physics>> normal_;
  Cohesion cohesion_;
  Tangential tangential_;
  Rolling rolling_;
  EnergyTally* tally_ = nullptr;
  int offset_ = -1;  // in the history: the forces that the tally keeps
};

/// Most decks: all of it in one loop.
template <NormalPhysics Physics>
using UsualContact =
    ComposedContact<Physics, cm::SURFACE_DEFAULT, Off<cm::CohesionModelBase>,
                    Fixed<cm::TangentialModel<cm::TANGENTIAL_HISTORY>>, Off<cm::RollingModelBase>>;

/// A tangential law of ours, which the normal law shares its memory with. `Other`: of the cohesion and the rolling
/// model, Off or Chosen.
template <NormalPhysics Physics, class Law, template <class> class Other>
using OwnContact =
    ComposedContact<Physics, cm::SURFACE_DEFAULT, Other<cm::CohesionModelBase>,
                    Fixed<OwnTangential<Physics, Law>>, Other<cm::RollingModelBase>>;

/// All others, with a virtual call for each model that is on: docs/evidence/loop-time.md has the cost.
template <NormalPhysics Physics, int surface = cm::SURFACE_DEFAULT>
using AnyContact = ComposedContact<Physics, surface, Chosen<cm::CohesionModelBase>,
                                   Chosen<cm::TangentialModelBase>, Chosen<cm::RollingModelBase>>;

}  // namespace granulaw::plugin
