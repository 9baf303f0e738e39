#pragma once

#include <fmt/format.h>

#include <algorithm>

#include "liggghts_plugin/command.hpp"
#include "liggghts_plugin/energy_tally.hpp"
#include "liggghts_plugin/session.hpp"
#include "liggghts_plugin/shapes.hpp"

namespace granulaw::plugin {

/// LIGGGHTS's combination of the five models, and with `energy on` the work of all but the normal law.
template <class Style>
class TalliedModel : public cm::ContactModel<Style>
{
  using Base = cm::ContactModel<Style>;

 public:
  static constexpr bool acts_at_distance = has_bridges(Style::COHESION);

  TalliedModel(LAMMPS* lmp, LIGGGHTS::IContactHistorySetup* hsetup, bool is_wall, int64_t hash)
      : Base(lmp, hsetup, is_wall, hash), lmp_(lmp)
  {
  }

  void postSettings(LIGGGHTS::IContactHistorySetup* hsetup)
  {
    Base::postSettings(hsetup);
    tally_ = Setup::current->session->energy;
    if (!tally_) return;
    for (int k = 0; k < EnergyTally::history_values; ++k) {
      const int offset = hsetup->add_history_value(fmt::format("other_force_{}", k), "1");
      if (k == 0) offset_ = offset;
    }
  }

  void surfacesIntersect(cm::SurfacesIntersectData& sidata, cm::ForceData& i_forces, cm::ForceData& j_forces)
  {
    Base::surfacesIntersect(sidata, i_forces, j_forces);
    if (tally_) [[unlikely]]
      tally_->account(sidata, i_forces, &sidata.contact_history[offset_], lmp_->update->dt,
                      lmp_->atom->nlocal);
  }

  void surfacesClose(cm::SurfacesCloseData& scdata, cm::ForceData& i_forces, cm::ForceData& j_forces)
  {
    Base::surfacesClose(scdata, i_forces, j_forces);
    if (tally_ && scdata.contact_history)
      std::fill_n(&scdata.contact_history[offset_], EnergyTally::history_values, 0.0);
  }

 private:
  LAMMPS* lmp_;
  EnergyTally* tally_ = nullptr;
  int offset_ = -1;
};

}  // namespace granulaw::plugin
