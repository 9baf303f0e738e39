#include "liggghts_plugin/run/heat_conduction.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "base/error.hpp"
#include "contact/pair.hpp"
#include "liggghts_plugin/deck/session.hpp"
#include "liggghts_plugin/engine/fix_style.hpp"
#include "liggghts_plugin/engine/private_members.hpp"

namespace granulaw::plugin {

GRANULAW_EXPOSE(WallAreaMode, LAMMPS_NS::FixWallGran, area_calculation_mode_);

namespace {

constexpr int area_of_overlap = 0;  // LIGGGHTS's contact_area overlap, its default

LAMMPS_NS::Fix* make_heat(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg)
{
  return new FixHeatConduction(lmp, narg, arg);
}

}  // namespace

void provide_heat_conduction(LAMMPS_NS::LAMMPS* lmp)
{
  for (const char* name : {"heat/gran", "heat/gran/conduction"}) replace_fix_style(lmp, name, &make_heat);
}

void check_heat(LAMMPS_NS::LAMMPS* lmp, const Setup& setup)
{
  const bool heat = lmp->modify->n_fixes_style("heat/gran") > 0;
  if (!setup.options.heat_by_law.value_or(false)) {
    const double s = setup.options.stretch.value_or(1.0);
    if (heat && s > 1.0 && setup.session->first_time("stretched heat") && lmp->comm->me == 0)
      lmp->error->warning(
          FLERR, fmt::format("{}: 'stretch {:g}' makes the overlap, through which fix heat/gran conducts, "
                             "larger: say 'heatArea law' for the real contact",
                             setup.where, s)
                     .c_str());
    return;
  }
  if (lmp->atom->superquadric_flag)
    fail(setup.where, "'heatArea law' is for spheres: leave it out, or say atom_style granular");
  if (setup.wall) {
    if (setup.wall->heattransfer_flag() && setup.wall->*exposed(WallAreaMode{}) != area_of_overlap)
      fail(setup.where, "'heatArea law' and another 'contact_area' than overlap exclude each other");
    return;
  }
  for (int f = 0; f < lmp->modify->nfix; ++f) {
    LAMMPS_NS::Fix* fix = lmp->modify->fix[f];
    if (std::strncmp(fix->style, "heat/gran", 9) == 0 && !dynamic_cast<FixHeatConduction*>(fix))
      fail(setup.where,
           fmt::format("'heatArea law' does not reach fix {} {}, which stands before the pair_style: put "
                       "it behind",
                       fix->id, fix->style));
  }
}

bool FixHeatConduction::by_law() const
{
  const auto session = Session::of(lmp);
  return session->contacts_of(nullptr) && session->pair_options &&
         session->pair_options->heat_by_law.value_or(false);
}

void FixHeatConduction::init()
{
  FixHeatGranCond::init();
  if (by_law() && (area_calculation_mode_ != area_of_overlap || area_correction_flag_))
    stop_all(lmp, fmt::format(
                      "fix {} {}: 'heatArea law' in the pair style leaves no room for another 'contact_area' "
                      "than overlap, nor for 'area_correction': the law's contact radius is the real one",
                      id, style));
}

void FixHeatConduction::post_force(int vflag)
{
  if (by_law())
    conduct(nullptr);
  else
    FixHeatGranCond::post_force(vflag);
}

void FixHeatConduction::cpl_evaluate(LAMMPS_NS::ComputePairGranLocal* caller)
{
  if (by_law() && caller == cpl)
    conduct(caller);
  else
    FixHeatGranCond::cpl_evaluate(caller);
}

void FixHeatConduction::conduct(LAMMPS_NS::ComputePairGranLocal* list)
{
  updatePtrs();
  if (store_contact_data_ && !list) {
    fix_conduction_contact_area_->set_all(0.);
    fix_n_conduction_contacts_->set_all(0.);
  }
  const ContactInquiry& contacts = *Session::of(lmp)->contacts_of(nullptr);
  const LAMMPS_NS::NeighList &neighbours = *pair_gran->list, &history = *pair_gran->listgranhistory;
  const int dnum = pair_gran->dnum();
  for (int ii = 0; ii < neighbours.inum; ++ii) {
    const int i = neighbours.ilist[ii];
    for (int jj = 0; jj < neighbours.numneigh[i]; ++jj) {
      const int j = neighbours.firstneigh[i][jj] & NEIGHMASK;
      if (!history.firstneigh[i][jj]) continue;
      if (!(atom->mask[i] & groupbit) && !(atom->mask[j] & groupbit)) continue;
      double delta[3], rsq = 0.0;
      for (int c = 0; c < 3; ++c) {
        delta[c] = atom->x[i][c] - atom->x[j][c];
        rsq += delta[c] * delta[c];
      }
      const double sum = atom->radius[i] + atom->radius[j];
      if (rsq >= sum * sum) continue;
      const double a = contacts
                           .state({atom->type[i], atom->type[j], atom->radius[i], atom->radius[j],
                                   sum - std::sqrt(rsq), &history.firstdouble[i][dnum * jj]})
                           .contact_radius;
      const double area = M_PI * a * a, k_i = conductivity_[atom->type[i] - 1],
                   k_j = conductivity_[atom->type[j] - 1];
      const double flux = k_i > 0.0 && k_j > 0.0
                              ? 4.0 * k_i * k_j / (k_i + k_j) * std::sqrt(area) * (Temp[j] - Temp[i])
                              : 0.0;
      if (list) {
        list->add_heat(i, j, flux);
        continue;
      }
      const bool own = force->newton_pair || j < atom->nlocal;
      heatFlux[i] += flux;
      if (own) heatFlux[j] -= flux;
      for (int c = 0; c < 3; ++c) {
        directionalHeatFlux[i][c] += 0.5 * flux * delta[c];
        if (own) directionalHeatFlux[j][c] += 0.5 * flux * delta[c];
      }
      if (!store_contact_data_) continue;
      for (const int k : {i, j})
        if (k == i || own) {
          conduction_contact_area_[k] += area;
          n_conduction_contacts_[k] += 1.0;
        }
    }
  }
  if (list || !store_contact_data_) return;
  for (int i = 0; i < atom->nlocal; ++i)
    if (n_conduction_contacts_[i] > 0.5) conduction_contact_area_[i] /= n_conduction_contacts_[i];
}

}  // namespace granulaw::plugin
