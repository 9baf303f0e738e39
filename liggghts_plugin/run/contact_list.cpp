#include "liggghts_plugin/run/contact_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "liggghts_plugin/deck/session.hpp"
#include "liggghts_plugin/engine/fix_style.hpp"

namespace granulaw::plugin {

namespace {

LAMMPS_NS::Compute* make_compute(LAMMPS_NS::LAMMPS* lmp, int iarg, int narg, char** arg)
{
  bool flags[3];
  std::vector<char*> rest = stock_words_of_list(narg, arg, flags);
  return new ContactList(lmp, iarg, static_cast<int>(rest.size()), rest.data(), flags);
}

}  // namespace

std::vector<char*> stock_words_of_list(int narg, char** arg, bool (&ours)[3])
{
  constexpr int fixed_words = 3;  // ID, group, style
  static char id[] = "id";
  const char* names[3] = {"contactRadius", "largestOverlap", "dissipatedEnergy"};
  std::vector<char*> rest;
  std::fill_n(ours, 3, false);
  for (int k = 0; k < narg; ++k) {
    const auto* const name = std::find_if(names, names + 3, [&](const char* n) { return k >= fixed_words && std::strcmp(arg[k], n) == 0; });
    if (name == names + 3)
      rest.push_back(arg[k]);
    else
      ours[name - names] = true;
  }
  if (static_cast<int>(rest.size()) == fixed_words && narg > fixed_words) rest.push_back(id);
  return rest;
}

void provide_contact_list(LAMMPS_NS::LAMMPS* lmp)
{
  for (const char* name : {"pair/gran/local", "wall/gran/local"})
    replace_compute_style(lmp, name, &make_compute);
}

ContactList::ContactList(LAMMPS_NS::LAMMPS* lmp, int& iarg, int narg, char** arg, const bool (&words)[3])
    : ComputePairGranLocal(lmp, iarg, narg, arg), radius_(words[0]), overlap_(words[1]), dissipated_(words[2])
{
}

const ContactInquiry* ContactList::contacts() const
{
  return Session::of(lmp)->contacts_of(wall ? fixwall : nullptr);
}

void ContactList::init()
{
  ComputePairGranLocal::init();
  if ((radius_ || overlap_ || dissipated_) && atom->superquadric_flag)
    stop_all(lmp,
             fmt::format("compute {} {}: contactRadius, largestOverlap and dissipatedEnergy are for spheres",
                         id, style));
  if ((radius_ || overlap_ || dissipated_) && !contacts())
    stop_all(
        lmp,
        fmt::format("compute {} {}: contactRadius, largestOverlap and dissipatedEnergy are known of contacts "
                    "of the models {}, and {} is of another",
                    id, style, model_names(), wall ? "the mesh wall" : "the pair style"));
}

void ContactList::init_cpgl(bool requestflag)
{
  ComputePairGranLocal::init_cpgl(requestflag);
  first_ = nvalues;
  nvalues += radius_ + overlap_ + dissipated_;
  size_local_cols = nvalues;
}

void ContactList::add_pair(int i, int j, double fx, double fy, double fz, double tor1, double tor2,
                           double tor3, double* hist, const double* contact_point)
{
  const int before = ipair;
  ComputePairGranLocal::add_pair(i, j, fx, fy, fz, tor1, tor2, tor3, hist, contact_point);
  if (ipair == before) return;  // counted by another rank
  double rsq = 0.0;
  for (int c = 0; c < 3; ++c) {
    const double d = atom->x[i][c] - atom->x[j][c];
    rsq += d * d;
  }
  const double r_i = atom->radius[i], r_j = atom->radius[j];
  fill({atom->type[i], atom->type[j], r_i, r_j, r_i + r_j - std::sqrt(rsq), hist});
}

void ContactList::add_wall_2(int i, double fx, double fy, double fz, double tor1, double tor2, double tor3,
                             double* hist, double rsq, double* normal)
{
  const int before = ipair;
  ComputePairGranLocal::add_wall_2(i, fx, fy, fz, tor1, tor2, tor3, hist, rsq, normal);
  if (ipair == before) return;
  fill({atom->type[i], fixwall->atom_type_wall(), atom->radius[i], flat, atom->radius[i] - std::sqrt(rsq),
        hist});
}

void ContactList::fill(const ContactPlace& contact)
{
  if (!radius_ && !overlap_ && !dissipated_) return;
  const ContactState state = contacts()->state(contact);
  int column = first_;
  if (radius_) array[ipair - 1][column++] = state.contact_radius;
  if (overlap_) array[ipair - 1][column++] = state.largest_overlap;
  if (dissipated_) array[ipair - 1][column++] = state.dissipated;
}

}  // namespace granulaw::plugin
