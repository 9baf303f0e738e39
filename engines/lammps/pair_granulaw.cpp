#include "pair_granulaw.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "comm.h"
#include "domain.h"
#include "fix.h"
#include "fix_granulaw_history.hpp"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

namespace granulaw::lammps {

namespace {
constexpr const char* history_id = "GRANULAW_HISTORY";
constexpr const char* place_id = "GRANULAW_PLACE";
constexpr const char* style_name = "pair_style granulaw";

/// LAMMPS's own names of two calls changed after 2021.
template <class Neighbor>
void request_list(Neighbor* neighbor, LAMMPS_NS::Pair* pair, int instance)
{
  if constexpr (requires { neighbor->add_request(pair); })
    neighbor->add_request(pair), (void)instance;
  else
    neighbor->request(pair, instance);
}
template <class Comm>
void send_to_ghosts(Comm* comm, LAMMPS_NS::Pair* pair)
{
  if constexpr (requires { comm->forward_comm_pair(pair); })
    comm->forward_comm_pair(pair);
  else
    comm->forward_comm(pair);
}
}  // namespace

PairGranulaw::PairGranulaw(LAMMPS* lmp) : Pair(lmp)
{
  single_enable = 1, single_extra = 10, svector = new double[10]{};
  no_virial_fdotr_compute = 1, finitecutflag = 1, writedata = 0, one_coeff = 0;
  centroidstressflag = LAMMPS_NS::CENTROID_NOTAVAIL;
  nextra = Books::values, pvector = new double[Books::values]{};
  comm_forward = 1;
  if (!domain->box_exist) stop_all(lmp, fmt::format("{}: it stands behind create_box, read_data or read_restart", style_name));
  if (modify->find_fix(place_id) >= 0 || modify->find_fix(history_id) >= 0) stop_all(lmp, fmt::format("{}: a deck has one of it", style_name));
  // Its place among the fixes: histories go to the atoms before a later fix adds or removes some.
  modify->add_fix(fmt::format("{} all DUMMY", place_id));
}

PairGranulaw::~PairGranulaw()
{
  delete[] svector;
  delete[] pvector;
  if (copymode) return;
  if (modify->nfix) modify->delete_fix(history_ ? history_id : place_id);
  if (allocated) memory->destroy(setflag), memory->destroy(cutsq);
}

void PairGranulaw::settings(int narg, char** arg)
{
  if (narg < 1) stop_all(lmp, fmt::format("{}: the law file is missing", style_name));
  words_ = Words::usual(lmp);
  const int end = words_.read(lmp, 1, narg, arg, style_name);
  if (end < narg) stop_all(lmp, fmt::format("{}: unknown keyword '{}'", style_name, arg[end]));
  file_ = LawFile::read(lmp, arg[0]);
  said_.assign(1, std::vector<std::string>(arg, arg + narg));
  material_.clear();
}

void PairGranulaw::coeff(int narg, char** arg)
{
  ntypes_ = atom->ntypes;
  const bool all = narg > 1 && std::strcmp(arg[0], "*") == 0 && std::strcmp(arg[1], "*") == 0;
  if (all && narg != 2 + ntypes_) stop_all(lmp, fmt::format("pair_coeff * * of granulaw: one material for each of the {} types, found {}", ntypes_, narg - 2));
  if (!all && material_.empty()) stop_all(lmp, "pair_coeff of granulaw: 'pair_coeff * * MATERIAL ...' stands first");
  if (!allocated) {
    allocated = 1;
    memory->create(setflag, ntypes_ + 1, ntypes_ + 1, "pair:setflag");
    memory->create(cutsq, ntypes_ + 1, ntypes_ + 1, "pair:cutsq");
  }
  if (all) {
    material_.assign(1, "");
    for (int t = 1; t <= ntypes_; ++t) {
      (void)file_.material(lmp, arg[1 + t]);
      material_.emplace_back(arg[1 + t]);
      for (int j = t; j <= ntypes_; ++j) setflag[t][j] = 1;
    }
    said_.resize(1);
  } else {
    Words trial = words_;
    const int end = trial.read(lmp, 2, narg, arg, "pair_coeff of granulaw");
    if (end < narg) stop_all(lmp, fmt::format("pair_coeff of granulaw: unknown keyword '{}'", arg[end]));
    for (const char* fixed : {"tangential", "stretch"})
      if (std::any_of(arg + 2, arg + narg, [&](const char* word) { return std::strcmp(word, fixed) == 0; }))
        stop_all(lmp, fmt::format("pair_coeff of granulaw: '{}' belongs to pair_style, for all types", fixed));
  }
  said_.emplace_back(arg, arg + narg);
}

void PairGranulaw::find_sizes()
{
  radius_.assign(ntypes_ + 1, 0.0), least_.assign(ntypes_ + 1, 1e300);
  for (int i = 0; i < atom->nlocal; ++i) {
    double &most = radius_[atom->type[i]], &least = least_[atom->type[i]];
    most = std::max(most, atom->radius[i]), least = std::min(least, atom->radius[i]);
  }
  for (int f = 0; f < modify->nfix; ++f) {
    LAMMPS_NS::Fix& fix = *modify->fix[f];
    if (std::strncmp(fix.style, "pour", 4) != 0 && std::strncmp(fix.style, "deposit", 7) != 0) continue;
    for (int t = 1; t <= ntypes_; ++t) {
      int type = t;
      if (const auto* largest = static_cast<const double*>(fix.extract("radius", type)); largest && *largest > 0)
        radius_[t] = std::max(radius_[t], *largest), least_[t] = std::min(least_[t], *largest);
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, radius_.data(), ntypes_ + 1, MPI_DOUBLE, MPI_MAX, world);
  MPI_Allreduce(MPI_IN_PLACE, least_.data(), ntypes_ + 1, MPI_DOUBLE, MPI_MIN, world);
}

void PairGranulaw::check_densities()
{
  if (densities_checked_) return;
  densities_checked_ = true;
  const double unit = words_.pair.mass / std::pow(words_.pair.length, 3);
  for (int t = 1; t <= ntypes_; ++t) {
    const granulaw_material material = file_.material(lmp, material_[t]);
    double found[2] = {0.0, 0.0};  // most, and less least
    for (int i = 0; i < atom->nlocal; ++i) {
      if (atom->type[i] != t || !(atom->radius[i] > 0)) continue;
      const double density = unit * atom->rmass[i] / (4.0 / 3.0 * M_PI * std::pow(atom->radius[i], 3));
      found[0] = std::max(found[0], density), found[1] = std::max(found[1], 1.0 / density);
    }
    MPI_Allreduce(MPI_IN_PLACE, found, 2, MPI_DOUBLE, MPI_MAX, world);
    const double off = std::max(found[0] / material.density, material.density * found[1]);
    if (found[0] > 0 && off > 1.001 && comm->me == 0)
      error->warning(FLERR, fmt::format("{}: particles of type {} have density {:.6g} to {:.6g} kg/m^3, '{}' in {} has {:.6g}: the force does not depend on it, "
                                        "the law's limit of velocity does", style_name, t, 1.0 / found[1], found[0], material_[t], file_.path, material.density));
  }
}

void PairGranulaw::init_style()
{
  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag) stop_all(lmp, fmt::format("{}: it needs atom_style sphere", style_name));
  if (atom->tag_enable == 0) stop_all(lmp, fmt::format("{}: it needs atom IDs", style_name));
  if (force->newton_pair) stop_all(lmp, fmt::format("{}: it needs 'newton off'", style_name));
  if (!comm->ghost_velocity) stop_all(lmp, fmt::format("{}: it needs 'comm_modify vel yes'", style_name));
  if (material_.empty()) stop_all(lmp, fmt::format("{}: 'pair_coeff * * MATERIAL ...' is missing", style_name));
  request_list(neighbor, this, instance_me);
  find_sizes();
  check_densities();
  masses_.find(lmp);
  const int n = ntypes_ + 1;
  std::vector<Words> words(static_cast<std::size_t>(n) * n, words_);
  for (std::size_t line = 2; line < said_.size(); ++line) {
    std::vector<char*> arg;
    for (std::string& word : said_[line]) arg.push_back(word.data());
    int ilo, ihi, jlo, jhi;
    LAMMPS_NS::utils::bounds(FLERR, arg[0], 1, ntypes_, ilo, ihi, error);
    LAMMPS_NS::utils::bounds(FLERR, arg[1], 1, ntypes_, jlo, jhi, error);
    for (int i = ilo; i <= ihi; ++i)
      for (int j = jlo; j <= jhi; ++j)
        for (Words* one : {&words[i * n + j], &words[j * n + i]}) one->read(lmp, 2, static_cast<int>(arg.size()), arg.data(), "pair_coeff of granulaw");
  }
  laws_.clear();
  laws_.resize(words.size());
  values_ = 0;
  const auto usual = [&](int t) { return radius_[t] > 0 ? 0.5 * (least_[t] + radius_[t]) : 0.0; };
  for (int i = 1; i < n; ++i)
    for (int j = 1; j < n; ++j) {
      laws_[i * n + j] = words[i * n + j].contact(lmp, file_, material_[i], material_[j], usual(i), usual(j));
      values_ = std::max(values_, laws_[i * n + j].values);
    }
  if (!history_)
    history_ = dynamic_cast<FixGranulawHistory*>(modify->replace_fix(place_id, fmt::format("{} all granulaw/history {}", history_id, values_), 1));
  history_->attach(*this);
}

bool PairGranulaw::changes_sign(int place) const
{
  for (const ContactLaw& law : laws_)
    if (law.law && law.values == values_) {
      const int own = static_cast<int>(granulaw_history(law.law.get()));
      return place >= own || granulaw_changes_sign(law.law.get(), static_cast<std::size_t>(place));  // then the rolling spring
    }
  return false;
}

void PairGranulaw::refresh_masses()
{
  if (!masses_.any() || neighbor->ago != 0) return;
  inverse_mass_.resize(static_cast<std::size_t>(atom->nmax));
  for (int i = 0; i < atom->nlocal; ++i) inverse_mass_[i] = masses_.inverse(*atom, i);
  send_to_ghosts(comm, this);
}
int PairGranulaw::pack_forward_comm(int n, int* list, double* buffer, int, int*)
{
  for (int k = 0; k < n; ++k) buffer[k] = inverse_mass_[list[k]];
  return n;
}
void PairGranulaw::unpack_forward_comm(int n, int first, double* buffer)
{
  std::copy_n(buffer, n, &inverse_mass_[first]);
}

PairGranulaw::Particles PairGranulaw::particles() const
{
  return {atom->x, atom->v, atom->omega, atom->radius, atom->rmass, masses_.any() ? inverse_mass_.data() : nullptr};
}

inline bool PairGranulaw::touches(const Particles& of, int i, int j, granulaw_motion& m, double& lever_i, double& lever_j)
{
  const double *xi = of.x[i], *xj = of.x[j], ri = of.radius[i], rj = of.radius[j], sum = ri + rj;
  const double dx = xi[0] - xj[0], dy = xi[1] - xj[1], dz = xi[2] - xj[2], square = dx * dx + dy * dy + dz * dz;
  if (square >= sum * sum) return false;
  const double distance = std::sqrt(square), per = 1.0 / distance;
  m.normal[0] = dx * per, m.normal[1] = dy * per, m.normal[2] = dz * per;
  m.overlap = sum - distance;
  m.radius_a = ri, m.radius_b = rj;
  const double mi = of.mass[i], mj = of.mass[j];
  m.m_eff = mi * mj / (mi + mj);
  if (of.inverse_mass)
    if (const double inverse = of.inverse_mass[i] + of.inverse_mass[j]; inverse > 0.0) m.m_eff = 1.0 / inverse;
  lever_i = ri - 0.5 * m.overlap, lever_j = rj - 0.5 * m.overlap;
  const double *vi = of.v[i], *vj = of.v[j], v[3] = {vi[0] - vj[0], vi[1] - vj[1], vi[2] - vj[2]};
  set_velocities(m, v, of.omega[i], of.omega[j], lever_i, lever_j);
  return true;
}

void PairGranulaw::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);
  refresh_masses();
  const Particles of = particles();
  double *const *f = atom->f, *const *torque = atom->torque;
  const int *type = atom->type, nlocal = atom->nlocal, values = history_->values();
  Books& books = history_->books;
  granulaw_motion m{};
  granulaw_answer now{};
  m.size = sizeof m, now.size = sizeof now;
  m.dt = update->dt, m.asked_again = update->setupflag;
  for (int ii = 0; ii < list->inum; ++ii) {
    const int i = list->ilist[ii], *neighbours = list->firstneigh[i], count = list->numneigh[i];
    unsigned char* open = history_->open_of(i);
    double* history = history_->values_of(i);
    for (int jj = 0; jj < count; ++jj) {
      const int j = neighbours[jj] & NEIGHMASK;
      double lever_i, lever_j;
      if (!touches(of, i, j, m, lever_i, lever_j)) {
        if (open[jj]) {
          open[jj] = 0;
          std::fill_n(history + jj * values, values, 0.0);
        }
        continue;
      }
      open[jj] = 1;
      const ContactLaw& contact = law(type[i], type[j]);
      double* book = j < nlocal ? books.own.data() : books.shared.data();
      if (!advance(contact, m, history + jj * values, now, book))
        stop_one(lmp, fmt::format("granulaw: the motion of atoms {} and {} has no number", atom->tag[i], atom->tag[j]));
      if (now.beyond) Books::range(lmp, book, contact, m, now, atom->tag[i]);
      const double* n = m.normal;
      const double push[3] = {now.normal * n[0] + now.shear[0], now.normal * n[1] + now.shear[1], now.normal * n[2] + now.shear[2]};
      double arm[3];
      cross(n, now.shear, arm);
      for (int c = 0; c < 3; ++c) f[i][c] += push[c], torque[i][c] += now.couple[c] - lever_i * arm[c];
      if (j < nlocal)
        for (int c = 0; c < 3; ++c) f[j][c] -= push[c], torque[j][c] -= now.couple[c] + lever_j * arm[c];
      if (!evflag) continue;
      granulaw_state state{};
      state.size = sizeof state;
      if (eflag_either) granulaw_state_of(contact.law.get(), 1, &m, history + jj * values, &state);
      const double distance = m.radius_a + m.radius_b - m.overlap;
      ev_tally_xyz(i, j, nlocal, 0, state.stored_energy, 0.0, push[0], push[1], push[2], distance * n[0], distance * n[1], distance * n[2]);
    }
  }
  for (int k = 0; k < Books::values; ++k) pvector[k] = books.value(k);
}

const double* PairGranulaw::history_of(int i, int j) const
{
  if (i >= history_->local()) return nullptr;
  for (int jj = 0; jj < list->numneigh[i]; ++jj)
    if ((list->firstneigh[i][jj] & NEIGHMASK) == j) return history_->open_of(i)[jj] ? history_->values_of(i) + jj * history_->values() : nullptr;
  return nullptr;
}

double PairGranulaw::single(int i, int j, int, int, double, double, double, double& fforce)
{
  fforce = 0.0;
  std::fill_n(svector, single_extra, 0.0);
  const double* open = history_of(i, j);
  const bool other_way = !open;
  if (other_way) std::swap(i, j), open = history_of(i, j);
  granulaw_motion m{};
  granulaw_answer now{};
  granulaw_state state{};
  m.size = sizeof m, now.size = sizeof now, state.size = sizeof state;
  m.dt = update->dt, m.asked_again = 1;
  double lever_i, lever_j;
  if (!touches(particles(), i, j, m, lever_i, lever_j)) return 0.0;
  std::vector<double> history(static_cast<std::size_t>(history_->values()), 0.0);
  if (open) std::copy_n(open, history.size(), history.begin());
  const ContactLaw& contact = law(atom->type[i], atom->type[j]);
  if (!advance(contact, m, history.data(), now, nullptr)) return 0.0;
  granulaw_state_of(contact.law.get(), 1, &m, history.data(), &state);
  double size = 0.0;
  for (int c = 0; c < 3; ++c) svector[c] = other_way ? -now.shear[c] : now.shear[c], size += now.shear[c] * now.shear[c];
  svector[3] = std::sqrt(size), svector[4] = now.normal, svector[5] = m.overlap;
  svector[6] = state.contact_radius, svector[7] = state.largest_overlap, svector[8] = state.stiffness, svector[9] = state.branch;
  fforce = now.normal / (m.radius_a + m.radius_b - m.overlap);
  return state.stored_energy;
}

void PairGranulaw::write_restart(FILE* file)
{
  std::string text;
  for (const auto& line : said_) {
    const char* between = "";
    for (const auto& word : line) text += std::exchange(between, "\t") + word;
    text += '\n';
  }
  const int size = static_cast<int>(text.size());
  fwrite(&size, sizeof size, 1, file);
  fwrite(text.data(), 1, text.size(), file);
}

void PairGranulaw::read_restart(FILE* file)
{
  int size = 0;
  if (comm->me == 0 && fread(&size, sizeof size, 1, file) != 1) size = -1;
  MPI_Bcast(&size, 1, MPI_INT, 0, world);
  if (size < 0) stop_all(lmp, fmt::format("{}: the restart file ends in its words", style_name));
  std::string text(static_cast<std::size_t>(size), '\0');
  if (comm->me == 0 && fread(text.data(), 1, text.size(), file) != text.size()) text.clear();
  MPI_Bcast(text.data(), size, MPI_CHAR, 0, world);
  bool first = true;
  for (std::size_t at = 0, end; (end = text.find('\n', at)) != std::string::npos; at = end + 1) {
    std::string line = text.substr(at, end - at);
    std::vector<char*> arg{line.data()};
    for (char& letter : line)
      if (letter == '\t') letter = '\0', arg.push_back(&letter + 1);
    if (first) settings(static_cast<int>(arg.size()), arg.data());
    else coeff(static_cast<int>(arg.size()), arg.data());
    first = false;
  }
}

}  // namespace granulaw::lammps
