#pragma once

#include "granulaw_words.hpp"  // before LAMMPS's headers

#include "fix.h"

namespace granulaw::lammps {

class PairGranulaw;

/// Histories of contacts between particles: beside the neighbour list while it lasts, with the atoms when they move, in restart files.
/// pair_style granulaw adds it.
class FixGranulawHistory : public LAMMPS_NS::Fix
{
 public:
  FixGranulawHistory(LAMMPS* lmp, int narg, char** arg);
  ~FixGranulawHistory() override;
  int setmask() override;
  void setup(int) override { on_list_ = true; }  // `run N pre no` goes on with the list
  void setup_pre_exchange() override { pre_exchange(); }
  void setup_post_neighbor() override { post_neighbor(); }
  void pre_exchange() override;
  void post_neighbor() override;
  void post_run() override;
  void min_pre_exchange() override { pre_exchange(); }
  void min_post_neighbor() override { post_neighbor(); }
  void write_restart(FILE* file) override;
  void restart(char* buffer) override;
  void grow_arrays(int n) override { partners_.resize(static_cast<std::size_t>(n)); }
  void copy_arrays(int i, int j, int) override { partners_[j] = partners_[i]; }
  void set_arrays(int i) override { partners_[i].clear(); }
  int pack_exchange(int i, double* buffer) override;
  int unpack_exchange(int i, double* buffer) override;
  int pack_restart(int i, double* buffer) override;
  void unpack_restart(int i, int nth) override;
  int size_restart(int i) override { return 3 + static_cast<int>(partners_[i].size()) * (1 + values_); }
  int maxsize_restart() override { return 3 + most_partners() * (1 + values_); }
  double memory_usage() override { return static_cast<double>(history_.capacity() * sizeof(double) + open_.capacity()); }

  /// Once a run, when the contact laws are known.
  void attach(const PairGranulaw& pair);
  int values() const { return values_; }
  int local() const { return list_local_; }
  /// Of each neighbour of a local atom on the list: true if it touched in the last step; its values.
  unsigned char* open_of(int i) { return &open_[begin_[i]]; }
  double* values_of(int i) { return &history_[begin_[i] * static_cast<std::size_t>(values_)]; }

  Books books;

 private:
  struct Partner
  {
    LAMMPS_NS::tagint tag;
    std::vector<double> history;
  };
  int most_partners() const;
  void gather();

  const PairGranulaw* pair_ = nullptr;
  int values_;
  std::vector<std::vector<Partner>> partners_;  // of each atom
  std::vector<std::size_t> begin_;              // of a local atom's neighbours
  std::vector<unsigned char> open_;
  std::vector<double> history_;
  bool on_list_ = false;  // the list has what the atoms do not
  int list_local_ = 0;    // atoms that the list has
  std::array<double, 4> warned_{};
};

}  // namespace granulaw::lammps
