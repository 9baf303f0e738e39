#pragma once

#include <cmath>

#include "liggghts_plugin/contact/composed_contact.hpp"
#include "liggghts_plugin/contact/superquadric.hpp"
#include "liggghts_plugin/loop/command.hpp"
#include "liggghts_plugin/loop/pair_loop.hpp"
#include "liggghts_plugin/loop/wall_loop.hpp"

namespace granulaw::plugin {

/// pair_style gran with one of our models.
template <class Contact>
class PairStyle final : public PairLoop<Contact>, public CommandStyle
{
  using Base = PairLoop<Contact>;

 public:
  PairStyle(LAMMPS* lmp, PairGran* parent, int64_t hash)
      : Base(lmp, parent, hash), CommandStyle(lmp, nullptr), lmp_(lmp), parent_(parent)
  {
    this->model().take(setup());
  }

  void each_open(const std::function<void(const OpenContact&)>& visit) const override
  {
    this->each_open_contact(*parent_, [&](int i, int j, double weight, double* history) {
      const LAMMPS_NS::Atom& atom = *lmp_->atom;
      visit(open_contact(atom.type[i], atom.type[j], i, j, weight, atom.radius[j], history));
    });
  }

  void settings(int nargs, char** args, LIGGGHTS::IContactHistorySetup* hsetup) override
  {
    read<typename Contact::Physics>(this->hashcode(), nargs, args,
                                    [&](int n, char** words) { Base::settings(n, words, hsetup); });
    this->set_bodies(&setup().session->bodies);
    this->set_confinement(says_confinement(setup().options) ? &setup().session->confinement : nullptr);
  }

  void init_granular() override
  {
    begin_run([&] { Base::init_granular(); });
  }

 private:
  LAMMPS* lmp_;
  PairGran* parent_;
};

/// fix wall/gran with one of our models.
template <class Contact>
class WallStyle final : public WallLoop<Contact>, public CommandStyle
{
  using Base = WallLoop<Contact>;

 public:
  WallStyle(LAMMPS* lmp, FixWallGran* parent, int64_t hash)
      : Base(lmp, parent, hash), CommandStyle(lmp, parent), lmp_(lmp), hash_(hash)
  {
    this->model().take(setup());
  }

  void each_open(const std::function<void(const OpenContact&)>& visit) const override
  {
    this->each_open_contact([&](int i, int wall_type, double* history) {
      visit(open_contact(lmp_->atom->type[i], wall_type, i, -1, 1.0, flat, history));
    });
  }

  double heat_overlap(const cm::SurfacesIntersectData& contact, double overlap) const override
  {
    if (!setup().options.heat_by_law.value_or(false)) return overlap;
    // area pi a^2 of the law's own contact radius, which is less than R
    const double r = contact.radi;
    const double a =
        contacts()
            ->state({contact.itype, contact.jtype, r, flat, overlap, contact.contact_history})
            .contact_radius;
    return r - std::sqrt(std::max(0.0, r * r - a * a));
  }

  void settings(int nargs, char** args, LIGGGHTS::IContactHistorySetup* hsetup) override
  {
    read<typename Contact::Physics>(hash_, nargs, args,
                                    [&](int n, char** words) { Base::settings(n, words, hsetup); });
    this->set_confinement(says_confinement(setup().options) ? &setup().session->confinement : nullptr);
  }

  void init_granular() override
  {
    begin_run([&] { Base::init_granular(); });
  }

 private:
  LAMMPS* lmp_;
  int64_t hash_;
};

}  // namespace granulaw::plugin
