#include "gran_sub_mod_granulaw.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "atom.h"
#include "error.h"
#include "granular_model.h"
#include "modify.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace Granular_NS;

FixGranulawLaw::FixGranulawLaw(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg), materials(arg + std::min(narg, 4), arg + narg)
{
  if (narg < 5) error->all(FLERR, std::string("fix ID all granulaw/law FILE MATERIAL ..."));
  vector_flag = 1, extvector = 1, size_vector = GRANULAW_MECHANISMS, global_freq = 1;
  granulaw_why why;
  if (granulaw_open(arg[3], &law, &why)) error->all(FLERR, std::string("fix granulaw/law: ") + why.text);
  granulaw_usual_pair(&units, sizeof units);
  const std::string style = update->unit_style;
  if (style == "cgs") units.length = 1e-2, units.mass = 1e-3;
  else if (style == "micro") units.length = 1e-6, units.mass = 1e-15, units.time = 1e-6;
  else if (style == "nano") units.length = 1e-9, units.mass = 1e-21, units.time = 1e-9;
  else if (style != "si") error->all(FLERR, std::string("fix granulaw/law: units are si, cgs, micro or nano"));
}

double FixGranulawLaw::compute_vector(int k)
{
  double mine = own[k] + 0.5 * shared[k], all;
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

const char *FixGranulawLaw::material(double number) const
{
  if (number == 0.0) return "wall";
  if (!(number >= 1.0 && number <= materials.size())) error->all(FLERR, std::string("normal granulaw: fix granulaw/law has no material of this number"));
  return materials[static_cast<std::size_t>(number) - 1].c_str();
}

// largest overlap, impact overlap, five of the last reversal; three of the shear, which change sign; six of `tangential plastic`
static constexpr int VALUES = 16, SHEAR = 7;

GranSubModNormalGranulaw::GranSubModNormalGranulaw(GranularModel *gm, LAMMPS *lmp) : GranSubModNormal(gm, lmp)
{
  num_coeffs = 2, size_history = VALUES, nondefault_history_transfer = 1, material_properties = 1;
  transfer_history_factor = new double[VALUES];    // GranularModel copies it before init()
  for (int k = 0; k < VALUES; ++k) transfer_history_factor[k] = k >= SHEAR && k < SHEAR + 3 ? -1.0 : 1.0;
}

void GranSubModNormalGranulaw::mix_coeffs(double *i, double *j)
{
  coeffs[0] = i[0], coeffs[1] = j[1];
  coeffs_to_local();
}

void GranSubModNormalGranulaw::init()
{
  for (int k = 0; k < modify->nfix; ++k)
    if (auto *found = dynamic_cast<FixGranulawLaw *>(modify->fix[k])) fix = found;
  if (!fix) error->all(FLERR, std::string("normal granulaw: fix granulaw/law is missing"));
  const auto *shear = dynamic_cast<GranSubModTangentialGranulaw *>(gm->tangential_model);
  granulaw_pair pair = fix->units;
  pair.a = fix->material(coeffs[0]), pair.b = fix->material(coeffs[1]);
  if (shear) pair.friction = shear->get_mu(), pair.shear_damping = shear->get_damp(), pair.yields_in_shear = shear->plastic();
  granulaw_contact_law *made;
  granulaw_why why;
  if (granulaw_contact(fix->law, &pair, &made, &why)) error->all(FLERR, std::string("normal granulaw: ") + why.text);
  contact.reset(made, granulaw_close_contact);
  for (int k = 0; k < VALUES; ++k)
    if (granulaw_history(made) > VALUES || (granulaw_changes_sign(made, k) != 0) != (k >= SHEAR && k < SHEAR + 3 && k < static_cast<int>(granulaw_history(made))))
      error->all(FLERR, std::string("normal granulaw: this library keeps other history values: ") + granulaw_version());
  granulaw_material m{};
  m.size = sizeof m;
  for (std::size_t k = 0; granulaw_material_of(fix->law, k, &m) == GRANULAW_OK; ++k)
    if (std::strcmp(m.name, pair.a) == 0) Emod = m.youngs_modulus * pair.length * pair.time * pair.time / pair.mass, poiss = m.poisson_ratio;
}

granulaw_motion GranSubModNormalGranulaw::motion() const
{
  granulaw_motion m{};
  m.size = sizeof m;
  m.radius_a = gm->radi, m.radius_b = gm->contact_type == PAIR ? gm->radj : INFINITY;
  m.m_eff = gm->meff, m.overlap = gm->delta, m.approach = -gm->vnnr, m.dt = gm->dt, m.asked_again = !gm->history_update;
  std::copy_n(gm->nx, 3, m.normal);
  std::copy_n(gm->vtr, 3, m.slide);
  double turn[3];
  for (int c = 0; c < 3; ++c) turn[c] = gm->omegai[c] - gm->omegaj[c];
  for (int c = 0; c < 3; ++c) m.rolling[c] = turn[(c + 1) % 3] * gm->nx[(c + 2) % 3] - turn[(c + 2) % 3] * gm->nx[(c + 1) % 3];
  return m;
}

double GranSubModNormalGranulaw::calculate_contact_radius()
{
  const granulaw_motion m = motion();
  granulaw_state state{};
  state.size = sizeof state;
  granulaw_state_of(contact.get(), 1, &m, &gm->history[history_index], &state);
  return state.contact_radius;
}

double GranSubModNormalGranulaw::calculate_forces()
{
  const granulaw_motion m = motion();
  now.size = sizeof now;
  double *book = gm->contact_type == PAIR && gm->j >= atom->nlocal ? fix->shared : fix->own;
  if (granulaw_advance(contact.get(), 1, &m, &gm->history[history_index], &now, book, nullptr))
    error->one(FLERR, std::string("normal granulaw: a motion has no number"));
  return now.normal;
}

static const granulaw_answer &answer_of(GranularModel *gm, LAMMPS *lmp)
{
  auto *normal = dynamic_cast<GranSubModNormalGranulaw *>(gm->normal_model);
  if (!normal) lmp->error->all(FLERR, std::string("tangential and rolling granulaw need normal granulaw"));
  return normal->now;
}

GranSubModTangentialGranulaw::GranSubModTangentialGranulaw(GranularModel *gm, LAMMPS *lmp) : GranSubModTangential(gm, lmp)
{
  num_coeffs = 3;
}
void GranSubModTangentialGranulaw::calculate_forces()
{
  std::copy_n(answer_of(gm, lmp).shear, 3, gm->fs);
}

GranSubModRollingGranulaw::GranSubModRollingGranulaw(GranularModel *gm, LAMMPS *lmp) : GranSubModRolling(gm, lmp) {}
void GranSubModRollingGranulaw::calculate_forces()
{
  // the model's torque is R* n x fr; the couple has no part along n
  const double *couple = answer_of(gm, lmp).couple;
  for (int c = 0; c < 3; ++c) gm->fr[c] = (couple[(c + 1) % 3] * gm->nx[(c + 2) % 3] - couple[(c + 2) % 3] * gm->nx[(c + 1) % 3]) / gm->Reff;
}
