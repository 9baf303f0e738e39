#include "fix_granulaw_history.hpp"

#include <algorithm>

#include "comm.h"
#include "force.h"
#include "neigh_list.h"
#include "pair_granulaw.hpp"
#include "update.h"

namespace granulaw::lammps {

using namespace LAMMPS_NS::FixConst;

FixGranulawHistory::FixGranulawHistory(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg)
{
  if (narg != 4) stop_all(lmp, "fix granulaw/history: pair_style granulaw adds it");
  values_ = LAMMPS_NS::utils::inumeric(FLERR, arg[3], false, lmp);
  restart_peratom = 1, restart_global = 1, create_attribute = 1, maxexchange_dynamic = 1;
  FixGranulawHistory::grow_arrays(atom->nmax);
  atom->add_callback(LAMMPS_NS::Atom::GROW);
  atom->add_callback(LAMMPS_NS::Atom::RESTART);
}
FixGranulawHistory::~FixGranulawHistory()
{
  atom->delete_callback(id, LAMMPS_NS::Atom::GROW);
  atom->delete_callback(id, LAMMPS_NS::Atom::RESTART);
}
int FixGranulawHistory::setmask()
{
  return PRE_EXCHANGE | POST_NEIGHBOR | MIN_PRE_EXCHANGE | MIN_POST_NEIGHBOR | POST_RUN;
}

void FixGranulawHistory::attach(const PairGranulaw& pair)
{
  pair_ = &pair;
  if (values_ != pair.values())
    stop_all(lmp, fmt::format("pair_style granulaw: its contacts had {} history values and have {} now: friction, rolling and tangential stay as they were in the "
                              "first run, or in the restart file", values_, pair.values()));
}

void FixGranulawHistory::gather()
{
  const LAMMPS_NS::NeighList& list = pair_->neighbours();
  const LAMMPS_NS::tagint* tag = atom->tag;
  std::vector<double> sign(static_cast<std::size_t>(values_));
  for (int k = 0; k < values_; ++k) sign[k] = pair_->changes_sign(k) ? -1.0 : 1.0;
  for (int i = 0; i < list_local_; ++i) partners_[i].clear();
  for (int ii = 0; ii < list.inum; ++ii) {
    const int i = list.ilist[ii];
    for (int jj = 0; jj < list.numneigh[i]; ++jj) {
      if (!open_of(i)[jj]) continue;
      const int j = list.firstneigh[i][jj] & NEIGHMASK;
      const double* mine = values_of(i) + jj * values_;
      partners_[i].push_back({tag[j], {mine, mine + values_}});
      if (j >= list_local_) continue;
      std::vector<double> other(mine, mine + values_);
      for (int k = 0; k < values_; ++k) other[k] *= sign[k];
      partners_[j].push_back({tag[i], std::move(other)});
    }
  }
}

int FixGranulawHistory::most_partners() const
{
  std::size_t most = 0;
  for (int i = 0; i < atom->nlocal; ++i) most = std::max(most, partners_[i].size());
  return static_cast<int>(most);
}

void FixGranulawHistory::pre_exchange()
{
  if (on_list_) gather();
  on_list_ = false;
  maxexchange = 2 + most_partners() * (1 + values_);
}

void FixGranulawHistory::post_neighbor()
{
  const LAMMPS_NS::NeighList& list = pair_->neighbours();
  const LAMMPS_NS::tagint* tag = atom->tag;
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->radius[i] > pair_->radius(atom->type[i]) * (1 + 1e-12))
      stop_one(lmp, fmt::format("pair_style granulaw: atom {} has radius {:.6g}, and the largest of its type was {:.6g} when the run began: contacts would be missed",
                                tag[i], atom->radius[i], pair_->radius(atom->type[i])));
  begin_.assign(static_cast<std::size_t>(std::max(atom->nmax, 1)), 0);
  std::size_t all = 0;
  for (int ii = 0; ii < list.inum; ++ii) begin_[list.ilist[ii]] = all, all += static_cast<std::size_t>(list.numneigh[list.ilist[ii]]);
  open_.assign(all + 1, 0);
  history_.assign((all + 1) * static_cast<std::size_t>(values_), 0.0);
  for (int ii = 0; ii < list.inum; ++ii) {
    const int i = list.ilist[ii];
    if (partners_[i].empty()) continue;
    for (int jj = 0; jj < list.numneigh[i]; ++jj) {
      const LAMMPS_NS::tagint other = tag[list.firstneigh[i][jj] & NEIGHMASK];
      for (const Partner& partner : partners_[i])
        if (partner.tag == other) {
          open_of(i)[jj] = 1;
          std::copy(partner.history.begin(), partner.history.end(), values_of(i) + jj * values_);
        }
    }
  }
  on_list_ = true, list_local_ = atom->nlocal;
}

void FixGranulawHistory::post_run()
{
  pre_exchange();
  Books::warn(lmp, books, warned_, "pair_style granulaw");
}

void FixGranulawHistory::write_restart(FILE* file)
{
  if (on_list_) gather();
  books.write(lmp, file);
}
void FixGranulawHistory::restart(char* buffer)
{
  books.read(lmp, buffer, warned_);
}

int FixGranulawHistory::pack_exchange(int i, double* buffer)
{
  int m = 0;
  buffer[m++] = static_cast<double>(partners_[i].size());
  for (const Partner& partner : partners_[i]) {
    buffer[m++] = LAMMPS_NS::ubuf(partner.tag).d;
    for (const double value : partner.history) buffer[m++] = value;
  }
  return m;
}
int FixGranulawHistory::unpack_exchange(int i, double* buffer)
{
  int m = 0;
  partners_[i].resize(static_cast<std::size_t>(buffer[m++]));
  for (Partner& partner : partners_[i]) {
    partner.tag = static_cast<LAMMPS_NS::tagint>(LAMMPS_NS::ubuf(buffer[m++]).i);
    partner.history.assign(buffer + m, buffer + m + values_);
    m += values_;
  }
  return m;
}
int FixGranulawHistory::pack_restart(int i, double* buffer)
{
  buffer[1] = values_;
  buffer[0] = 2 + pack_exchange(i, buffer + 2);
  return static_cast<int>(buffer[0]);
}
void FixGranulawHistory::unpack_restart(int i, int nth)
{
  double* extra = atom->extra[i];
  int m = 0;
  for (int k = 0; k < nth; ++k) m += static_cast<int>(extra[m]);
  if (extra[m + 1] != values_)
    stop_one(lmp, fmt::format("pair_style granulaw: its contacts have {} history values and {:.0f} in the restart file: friction, rolling and tangential stay as they "
                              "were", values_, extra[m + 1]));
  unpack_exchange(i, extra + m + 2);
}

}  // namespace granulaw::lammps
