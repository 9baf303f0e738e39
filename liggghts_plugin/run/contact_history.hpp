#pragma once

#include <algorithm>
#include <vector>

#include "fix_contact_history_mesh.h"
#include "fix_contact_property_atom_wall.h"
#include "liggghts_plugin/engine/liggghts.hpp"

// LIGGGHTS's fixes that keep the histories of contacts, with histories that outlast the commands between two
// runs. LIGGGHTS makes these fixes itself, in the pair style and in fix wall/gran.
namespace granulaw::plugin {

/// A fix whose partners and histories survive a change of `neigh_modify page` or `one`. LIGGGHTS frees the
/// pages that hold them and leaves the pointers. A page also holds the histories of `one` partners, however
/// many values each has: LIGGGHTS makes no page at all where `page` numbers do not suffice.
template <class Base>
class LastingPages : public Base
{
 public:
  using Base::Base;

 protected:
  /// Places that particle i has for partners.
  virtual int places(int i) const { return this->npartner_[i]; }
  /// After the pages were made anew.
  virtual void remade() { lengthen(this->dpage_); }

  void allocate_pages() override
  {
    const LAMMPS_NS::Neighbor& neighbor = *this->neighbor;
    const bool first = !this->ipage_;
    if (!first && this->pgsize_ == neighbor.pgsize && this->oneatom_ == neighbor.oneatom) return;
    std::vector<int> partners;
    std::vector<double> values;
    const int nlocal = first ? 0 : this->atom->nlocal;
    for (int i = 0; i < nlocal; ++i) {
      partners.insert(partners.end(), this->partner_[i], this->partner_[i] + places(i));
      values.insert(values.end(), this->contacthistory_[i], this->contacthistory_[i] + places(i) * this->dnum_);
    }
    Base::allocate_pages();
    remade();
    auto partner = partners.begin();
    auto value = values.begin();
    for (int i = 0; i < nlocal; ++i) {
      const int n = places(i);
      this->partner_[i] = this->ipage_->get(n);
      this->contacthistory_[i] = this->dpage_->get(n * this->dnum_);
      if (!this->partner_[i] || !this->contacthistory_[i])
        this->error->one(FLERR, "Contact history overflow, boost neigh_modify one");
      std::copy_n(partner, n, this->partner_[i]);
      std::copy_n(value, n * this->dnum_, this->contacthistory_[i]);
      partner += n;
      value += n * this->dnum_;
    }
  }

  /// Makes pages that hold the histories of `one` partners where `page` is shorter.
  void lengthen(LAMMPS_NS::MyPage<double>* pages)
  {
    const int chunk = this->oneatom_ * std::max(1, this->dnum_);
    for (int t = 0; chunk > this->pgsize_ && t < this->comm->nthreads; ++t) pages[t].init(chunk, chunk);
  }
};

/// fix contacthistory, of contacts between particles.
///
/// During a run histories lie beside the neighbour list. LIGGGHTS copies them to the particles when the next
/// run begins; by then the list may have been made anew, empty, and all histories are lost. Here they are
/// copied when a run ends, and a list that is older than the particles' own histories is not looked at.
/// Commands that give particles new numbers (delete_atoms, insertion with compress_tags) are followed: a
/// history names its partner by number.
class PairHistory final : public LastingPages<LAMMPS_NS::FixContactHistory>
{
  using Base = LastingPages<LAMMPS_NS::FixContactHistory>;

 public:
  PairHistory(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);

  int setmask() override;
  void init() override;
  void setup_pre_exchange() override;
  void setup_pre_neighbor() override { follow_numbers(); }
  void pre_neighbor() override { follow_numbers(); }
  void pre_exchange() override;
  void post_run() override;
  void write_restart(FILE* file) override;
  void grow_arrays(int nmax) override;
  void copy_arrays(int i, int j, int delflag) override;
  void set_arrays(int i) override;
  int pack_exchange(int i, double* buffer) override;
  int unpack_exchange(int i, double* buffer) override;
  void unpack_restart(int i, int nth) override;

 private:
  /// Copies histories from the neighbour list to the particles where the list's are the newer ones.
  void save();
  void reserve_exchange() const;
  /// Renames partners whose numbers changed since save(), and drops those that were deleted and whose number
  /// another particle has now. Collective.
  void follow_numbers();

  std::vector<int> number_;  // of each particle when its partners were named; 0: it is newer than that
};

/// fix contacthistory/mesh, of contacts with the triangles of a mesh: always with the particles.
class MeshHistory final : public LastingPages<LAMMPS_NS::FixContactHistoryMesh>
{
  using Base = LastingPages<LAMMPS_NS::FixContactHistoryMesh>;

 public:
  using Base::Base;

  void pre_force(int vflag) override;

 protected:
  int places(int i) const override;
  void remade() override;

 private:
  bool a_place_for_each_neighbour_ = false;
};

/// From now on the deck's histories of contacts are these.
void provide_contact_histories(LAMMPS_NS::LAMMPS* lmp);

}  // namespace granulaw::plugin

/// provide_contact_histories(), for the launcher: decks without a model of ours have these histories, too.
extern "C" [[gnu::visibility("default")]] void granulaw_provide_contact_histories(LAMMPS_NS::LAMMPS* lmp);
