#pragma once

#include <fmt/format.h>

#include <algorithm>

#include "liggghts_plugin/books/energy_tally.hpp"
#include "liggghts_plugin/contact/contact_pieces.hpp"
#include "liggghts_plugin/contact/element_host.hpp"

namespace granulaw::plugin {

/// A contact in the place of LIGGGHTS's own (ContactModels::ContactModel): LIGGGHTS's surface model, the contact element of a
/// normal and a tangential law, and LIGGGHTS's cohesion and rolling model. `Other`: of these, Off or Chosen; where one is on
/// it costs a virtual call. With `energy on` it books the work of all but the normal law.
template <NormalPhysics OwnPhysics, class Tangential, class Beside, template <class> class Other, int surface = cm::SURFACE_DEFAULT>
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
        surface_(lmp, hsetup, this),
        element_(lmp, *hsetup, *this),
        cohesion_(lmp, hsetup, this, ids_.cohesion),
        rolling_(lmp, hsetup, this, ids_.rolling)
  {
  }
  /// The command's setup; it is read before postSettings.
  void take(const Setup& setup) { setup_ = &setup; }

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
    element_.registerSettings(settings);
    each_of_liggghts([&](auto& piece) { piece.registerSettings(settings); });
  }
  void postSettings(LIGGGHTS::IContactHistorySetup* hsetup)
  {
    element_.postSettings(*setup_, *hsetup);
    each_of_liggghts([&](auto& piece) { piece.postSettings(hsetup, this); });
    tally_ = setup_->session->energy;
    if (!tally_) return;
    for (int k = 0; k < EnergyTally::history_values; ++k) {
      const int offset = hsetup->add_history_value(fmt::format("other_force_{}", k), "1");
      if (k == 0) offset_ = offset;
    }
  }
  void connectToProperties(PropertyRegistry& registry)
  {
    element_.connectToProperties(registry);
    each_of_liggghts([&](auto& piece) { piece.connectToProperties(registry); });
  }
  double stressStrainExponent() { return 1.5; }
  void tally_pp(double value, int i, int j, int index) override { surface_.tally_pp(value, i, j, index); }
  void tally_pw(double value, int i, int j, int index) override { surface_.tally_pw(value, i, j, index); }

  /// True: particles that do not touch may act on each other; also those that have not touched.
  bool acts_at_distance() const { return decltype(element_)::acts_at_distance || begins_apart(); }
  bool begins_apart() const
  {
    if constexpr (decltype(element_)::begins_apart) return true;
    if constexpr (requires { cohesion_.always_off; }) return false;
    return ids_.has_bridges();
  }

  void beginPass(SurfacesIntersectData& contact, ForceData& on_i, ForceData& on_j)
  {
    element_.begin_step();
    each_of_liggghts([&](auto& piece) { piece.beginPass(contact, on_i, on_j); });
  }
  void endPass(SurfacesIntersectData& contact, ForceData& on_i, ForceData& on_j)
  {
    each_of_liggghts([&](auto& piece) { piece.endPass(contact, on_i, on_j); });
  }
  bool checkSurfaceIntersect(SurfacesIntersectData& contact) { return surface_.checkSurfaceIntersect(contact); }
  void surfacesIntersect(SurfacesIntersectData& contact, ForceData& on_i, ForceData& on_j)
  {
    surface_.surfacesIntersect(contact, on_i, on_j);
    if constexpr (requires { cohesion_.always_off; })
      element_.surfacesIntersect(contact, on_i, on_j, nullptr);
    else {
      element_.surfacesIntersect(contact, on_i, on_j, [&] {
        if (cohesion_) cohesion_->surfacesIntersect(contact, on_i, on_j);
      });
      if (rolling_) rolling_->surfacesIntersect(contact, on_i, on_j);
    }
    if (tally_) [[unlikely]]
      tally_->account(contact, on_i, &contact.contact_history[offset_], lmp_->update->dt,
                      lmp_->atom->nlocal);
  }
  void endSurfacesIntersect(SurfacesIntersectData& contact, LAMMPS_NS::TriMesh* mesh, ForceData& on_i,
                            ForceData& on_j)
  {
    surface_.endSurfacesIntersect(contact, mesh, on_i.delta_F);
    if (cohesion_) cohesion_->endSurfacesIntersect(contact, on_i, on_j);
  }
  void surfacesClose(SurfacesIntersectData& contact, ForceData& on_i, ForceData& on_j)
  {
    element_.surfacesClose(contact, on_i, on_j);
    each_of_liggghts([&](auto& piece) { piece.surfacesClose(contact, on_i, on_j); });
    if (tally_ && contact.contact_history) [[unlikely]]
      account_gap(contact, on_i);
  }

 private:
  /// Calls visit for each piece of LIGGGHTS's that is on, in its order.
  template <class Visit>
  [[gnu::always_inline]] void each_of_liggghts(Visit&& visit)
  {
    visit(surface_);
    if (cohesion_) visit(*cohesion_.operator->());
    if (rolling_) visit(*rolling_.operator->());
  }

  /// The work of a force over a gap, also in the step that ends it.
  [[gnu::noinline, gnu::cold]] void account_gap(SurfacesIntersectData contact, const ForceData& on_i)
  {
    double* last = &contact.contact_history[offset_];
    if (!contact.has_force_update && std::all_of(last, last + EnergyTally::history_values, [](double f) { return f == 0.0; })) return;
    const double distance = norm({contact.delta[0], contact.delta[1], contact.delta[2]});
    for (int c = 0; c < 3; ++c) contact.en[c] = contact.delta[c] / distance;
    contact.cri = contact.radi, contact.crj = contact.radj;
    element_.book_gap(contact);
    tally_->account(contact, on_i, last, lmp_->update->dt, lmp_->atom->nlocal);
  }

  LAMMPS* lmp_;
  ModelIds ids_;
  const Setup* setup_ = nullptr;
  cm::SurfaceModel<surface> surface_;
  ElementHost<Physics, Tangential, Beside> element_;
  Other<cm::CohesionModelBase> cohesion_;
  Other<cm::RollingModelBase> rolling_;
  EnergyTally* tally_ = nullptr;
  int offset_ = -1;  // in the history: the forces that the tally keeps
};

}  // namespace granulaw::plugin
