#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "liggghts_plugin/command_models.hpp"
#include "liggghts_plugin/fix_style.hpp"
#include "liggghts_plugin/pair_table.hpp"
#include "liggghts_plugin/superquadric.hpp"
#include "liggghts_plugin/tallied_model.hpp"
#include "liggghts_plugin/wall_loop.hpp"

namespace granulaw::plugin {

/// fix wall/gran with one of our models.
template <class Style, NormalPhysics Physics>
class WallStyle final : public WallLoop<TalliedModel<Style>>, public CountedStyle
{
  using Base = WallLoop<TalliedModel<Style>>;

 public:
  WallStyle(LAMMPS* lmp, FixWallGran* parent, int64_t hash)
      : Base(lmp, parent, hash), lmp_(lmp), parent_(parent)
  {
  }
  ~WallStyle() override
  {
    if (!setup_.session) return;
    setup_.session->one_size.erase(&setup_);
    setup_.session->styles.erase(parent_);
  }

  const ContactInquiry* contacts() const override { return setup_.contacts; }

  void each_open(const std::function<void(const OpenContact&)>& visit) const override
  {
    this->each_open_contact([&](int i, int wall_type, const double* history) {
      const int type = lmp_->atom->type[i];
      visit({pair_key(setup_, type, wall_type),
             i,
             -1,
             1.0,
             {type, wall_type, lmp_->atom->radius[i], flat, 0.0, history}});
    });
  }

  double heat_overlap(const cm::SurfacesIntersectData& contact) const override
  {
    if (!setup_.options.heat_by_law.value_or(false)) return contact.deltan;
    // area pi a^2 of the law's own contact radius, which is less than R
    const double r = contact.radi;
    const double a =
        setup_.contacts
            ->state({contact.itype, contact.jtype, r, flat, contact.deltan, contact.contact_history})
            .contact_radius;
    return r - std::sqrt(std::max(0.0, r * r - a * a));
  }

  void settings(int nargs, char** args, LIGGGHTS::IContactHistorySetup* hsetup) override
  {
    guarded(lmp_, [&] {
      const UnfinishedFix unfinished(lmp_, parent_);  // we are in its constructor
      setup_.session = Session::of(lmp_);
      setup_.wall = parent_;
      setup_.where = fmt::format("fix {} wall/gran model {}", parent_->id, Physics::name);
      read_command(lmp_, command_models<Style, Physics>, setup_, nargs, args,
                   [&](int n, char** words) { Base::settings(n, words, hsetup); });
      setup_.session->styles[parent_] = this;
      provide_fixes(lmp_);
    });
  }

  void init_granular() override
  {
    guarded(lmp_, [&] {
      Base::init_granular();
      check_run(lmp_, setup_);
    });
  }

 private:
  LAMMPS* lmp_;
  FixWallGran* parent_;
  Setup setup_;
};

template <class Style, NormalPhysics Physics>
LIGGGHTS::Walls::IGranularWall* make_wall_style(LAMMPS* lmp, FixWallGran* parent, int64_t hash)
{
  check_liggghts(lmp, dynamic_cast<void*>(parent), sizeof(FixWallGran), "fix wall/gran");
  check_particles<Style>(lmp);
  return new WallStyle<Style, Physics>(lmp, parent, hash);
}

}  // namespace granulaw::plugin
