#include "liggghts_plugin/run/contact_history.hpp"

#include <algorithm>

#include "liggghts_plugin/deck/session.hpp"
#include "liggghts_plugin/engine/fix_style.hpp"
#include "liggghts_plugin/particles/number_changes.hpp"

namespace granulaw::plugin {

namespace {

template <class Style>
LAMMPS_NS::Fix* make_fix(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg)
{
  return new Style(lmp, narg, arg);
}

}  // namespace

PairHistory::PairHistory(LAMMPS_NS::LAMMPS* lmp_, int narg, char** arg)
    : Base(lmp_, narg, arg), number_(static_cast<std::size_t>(atom->nmax), 0)
{
}

int PairHistory::setmask()
{
  return FixContactHistory::setmask() | LAMMPS_NS::FixConst::PRE_NEIGHBOR;
}

void PairHistory::init()
{
  if (!force->pair_match("gran", 1))
    stop_all(lmp,
             "pair_style hybrid: LIGGGHTS keeps the contact histories of one sub-style gran alone, and this deck has "
             "several: use one");
  FixContactHistory::init();
}

void PairHistory::save()
{
  if (!*computeflag_) return;
  FixContactHistory::pre_exchange();  // sets the flag to 0 until the next forces
  std::copy_n(atom->tag, atom->nlocal, number_.begin());
  reserve_exchange();
}

void PairHistory::reserve_exchange() const
{
  comm->maxexchange_fix = std::max(comm->maxexchange_fix, (dnum_ + 1) * maxtouch_ + 2);
}

void PairHistory::pre_exchange()
{
  save();
}

void PairHistory::post_run()
{
  save();
}

void PairHistory::setup_pre_exchange()
{
  save();
  reserve_exchange();
  follow_numbers();
  // LIGGGHTS compares the present sizes with those before the last neigh_modify, and would make all lists
  // anew whenever a command begins
  neighbor->old_pgsize = neighbor->pgsize;
  neighbor->old_oneatom = neighbor->oneatom;
}

void PairHistory::write_restart(FILE* file)
{
  save();  // a file that a run writes on its way
  FixContactHistory::write_restart(file);
}

void PairHistory::grow_arrays(int nmax)
{
  FixContactHistory::grow_arrays(nmax);
  number_.resize(static_cast<std::size_t>(nmax), 0);
}

void PairHistory::copy_arrays(int i, int j, int delflag)
{
  FixContactHistory::copy_arrays(i, j, delflag);
  number_[static_cast<std::size_t>(j)] = number_[static_cast<std::size_t>(i)];
}

void PairHistory::set_arrays(int i)
{
  FixContactHistory::set_arrays(i);
  number_[static_cast<std::size_t>(i)] = 0;
}

int PairHistory::pack_exchange(int i, double* buffer)
{
  const int n = FixContactHistory::pack_exchange(i, buffer);
  buffer[n] = number_[static_cast<std::size_t>(i)];
  return n + 1;
}

int PairHistory::unpack_exchange(int i, double* buffer)
{
  const int n = FixContactHistory::unpack_exchange(i, buffer);
  number_[static_cast<std::size_t>(i)] = static_cast<int>(buffer[n]);
  return n + 1;
}

void PairHistory::unpack_restart(int i, int nth)
{
  FixContactHistory::unpack_restart(i, nth);
  number_[static_cast<std::size_t>(i)] = atom->tag[i];
}

void PairHistory::follow_numbers()
{
  const NumberChanges changes(atom->tag, atom->nlocal, [this](int i) -> int& { return number_[static_cast<std::size_t>(i)]; }, world);
  if (changes.none()) return;
  for (int i = 0; i < atom->nlocal; ++i) {
    int kept = 0;
    for (int n = 0; n < npartner_[i]; ++n) {
      const int now = changes.now(partner_[i][n]);
      if (now == 0) continue;
      partner_[i][kept] = now;
      std::copy_n(contacthistory_[i] + n * dnum_, dnum_, contacthistory_[i] + kept++ * dnum_);
    }
    npartner_[i] = kept;
  }
}

void MeshHistory::pre_force(int vflag)
{
  FixContactHistoryMesh::pre_force(vflag);
  a_place_for_each_neighbour_ = true;
}

int MeshHistory::places(int i) const
{
  // what a restart file brings has a place for each partner until the first forces
  return a_place_for_each_neighbour_ ? std::max(nneighs(i), npartner_[i]) : npartner_[i];
}

void MeshHistory::remade()
{
  lengthen(dpage1_);
  lengthen(dpage2_);
  // flags of this step, not looked at before the next; they are swapped with the contacts
  for (int i = 0; i < atom->nlocal && a_place_for_each_neighbour_; ++i) {
    keepflag_[i] = keeppage_[0]->get(places(i));
    intersectflag_[i] = intersectpage_[0]->get(places(i));
    std::fill_n(keepflag_[i], places(i), false);
    std::fill_n(intersectflag_[i], places(i), false);
  }
}

void provide_contact_histories(LAMMPS_NS::LAMMPS* lmp)
{
  replace_fix_style(lmp, "contacthistory", &make_fix<PairHistory>);
  replace_fix_style(lmp, "contacthistory/mesh", &make_fix<MeshHistory>);
  replace_fix_style(lmp, "contactproperty/atom", &make_fix<LastingPages<LAMMPS_NS::FixContactPropertyAtom>>);
  replace_fix_style(lmp, "contactproperty/atom/wall",
                    &make_fix<LastingPages<LAMMPS_NS::FixContactPropertyAtomWall>>);
}

}  // namespace granulaw::plugin

void granulaw_provide_contact_histories(LAMMPS_NS::LAMMPS* lmp)
{
  granulaw::plugin::provide_contact_histories(lmp);
}
