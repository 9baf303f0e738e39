#pragma once

#include <fmt/format.h>

#include "liggghts_plugin/command_models.hpp"
#include "liggghts_plugin/pair_loop.hpp"
#include "liggghts_plugin/pair_table.hpp"
#include "liggghts_plugin/superquadric.hpp"
#include "liggghts_plugin/tallied_model.hpp"

namespace granulaw::plugin {

/// pair_style gran with one of our models.
template <class Style, NormalPhysics Physics>
class PairStyle final : public PairLoop<TalliedModel<Style>>, public CountedStyle
{
  using Base = PairLoop<TalliedModel<Style>>;

 public:
  PairStyle(LAMMPS* lmp, PairGran* parent, int64_t hash) : Base(lmp, parent, hash), lmp_(lmp), parent_(parent)
  {
  }
  ~PairStyle() override
  {
    if (!setup_.session) return;
    setup_.session->one_size.erase(&setup_);
    const auto own = setup_.session->styles.find(nullptr);
    if (own != setup_.session->styles.end() && own->second == this) setup_.session->styles.erase(own);
  }

  const ContactInquiry* contacts() const override { return setup_.contacts; }
  void each_open(const std::function<void(const OpenContact&)>& visit) const override
  {
    this->each_open_contact(*parent_, [&](int i, int j, double weight, const double* history) {
      const LAMMPS_NS::Atom& atom = *lmp_->atom;
      const int itype = atom.type[i], jtype = atom.type[j];
      visit({pair_key(setup_, itype, jtype),
             i,
             j,
             weight,
             {itype, jtype, atom.radius[i], atom.radius[j], 0.0, history}});
    });
  }

  void settings(int nargs, char** args, LIGGGHTS::IContactHistorySetup* hsetup) override
  {
    guarded(lmp_, [&] {
      setup_.session = Session::of(lmp_);
      setup_.where = fmt::format("pair_style gran model {}", Physics::name);
      read_command(lmp_, command_models<Style, Physics>, setup_, nargs, args,
                   [&](int n, char** words) { Base::settings(n, words, hsetup); });
      setup_.session->styles[nullptr] = this;
      this->set_bodies(&setup_.session->bodies);
      provide_fixes(lmp_);
    });
  }

  void init_granular() override
  {
    guarded(lmp_, [&] {
      Base::init_granular();
      check_run(lmp_, setup_);
      provide_fixes(lmp_);  // the box did not exist when pair_style stood before create_box
    });
  }

 private:
  LAMMPS* lmp_;
  PairGran* parent_;
  Setup setup_;
};

template <class Style, NormalPhysics Physics>
LIGGGHTS::PairStyles::IGranularPairStyle* make_pair_style(LAMMPS* lmp, PairGran* parent, int64_t hash)
{
  check_liggghts(lmp, dynamic_cast<void*>(parent), sizeof(PairGranProxy), "pair style");
  check_particles<Style>(lmp);
  return new PairStyle<Style, Physics>(lmp, parent, hash);
}

}  // namespace granulaw::plugin
