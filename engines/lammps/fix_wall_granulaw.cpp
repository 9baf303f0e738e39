#include "fix_wall_granulaw.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include "comm.h"
#include "domain.h"
#include "force.h"
#include "pair_granulaw.hpp"
#include "update.h"

namespace granulaw::lammps {

namespace {
/// LAMMPS's own names of this call changed after 2021.
template <class Domain>
LAMMPS_NS::Region* region_of(Domain* domain, const std::string& id)
{
  if constexpr (requires { domain->get_region_by_id(id); })
    return domain->get_region_by_id(id);
  else {
    const int k = domain->find_region(id);
    return k < 0 ? nullptr : domain->regions[k];
  }
}
}  // namespace

FixWallGranulaw::FixWallGranulaw(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg), where_(fmt::format("fix {} wall/granulaw", arg[0]))
{
  restart_peratom = 1, restart_global = 1, create_attribute = 1;
  scalar_flag = 1, extscalar = 1, vector_flag = 1, extvector = 1, global_freq = 1, size_vector = Books::values + 3;
  const auto* pair = dynamic_cast<PairGranulaw*>(force->pair_match("granulaw", 1));
  if (!pair || !pair->has_materials()) stop_all(lmp, fmt::format("{}: it stands behind pair_style granulaw and pair_coeff, whose law file and materials it has", where_));
  const std::string style = narg > 3 ? arg[3] : "";
  int k = 4;
  const auto next = [&] {
    if (k >= narg) stop_all(lmp, fmt::format("{}: a value is missing behind '{}'", where_, arg[k - 1]));
    return arg[k++];
  };
  const auto number = [&](double none) {
    const char* word = next();
    return std::strcmp(word, "NULL") == 0 ? none : LAMMPS_NS::utils::numeric(FLERR, word, false, lmp);
  };
  if (style == "xplane" || style == "yplane" || style == "zplane") {
    axis_ = style[0] - 'x', slots_ = 2;
    place_[0] = number(-std::numeric_limits<double>::max()), place_[1] = number(std::numeric_limits<double>::max());
  } else if (style == "zcylinder") {
    kind_ = Kind::cylinder, slots_ = 1;
    place_[0] = number(0.0);
    if (!(place_[0] > 0)) stop_all(lmp, fmt::format("{}: zcylinder needs a radius over 0", where_));
  } else if (style == "region") {
    kind_ = Kind::region, region_id_ = next();
    region_ = region_of(domain, region_id_);
    if (!region_) stop_all(lmp, fmt::format("{}: no region '{}'", where_, region_id_));
    slots_ = std::max(region_->tmax, 1);
  } else
    stop_all(lmp, fmt::format("{}: the wall is xplane, yplane, zplane, zcylinder or region, found '{}'", where_, style));
  std::string wall = "wall";
  if (k < narg && std::strcmp(arg[k], "of") == 0) ++k, wall = next();
  Words words = pair->words();
  k = words.read(lmp, k, narg, arg, where_);
  if (k < narg) stop_all(lmp, fmt::format("{}: unknown keyword '{}'", where_, arg[k]));
  const bool rigid = wall == "wall";
  rigid_plastic_ = rigid && words.pair.yields_in_shear;
  file_ = pair->file();
  laws_.resize(1);
  for (int t = 1; t <= atom->ntypes; ++t) {
    laws_.push_back(words.contact(lmp, file_, pair->material(t), wall, rigid ? 0.0 : 1.0, rigid ? 0.0 : INFINITY));
    values_ = std::max(values_, laws_.back().values);
  }
  stride_ = slots_ * (1 + values_);
  maxexchange = stride_;
  FixWallGranulaw::grow_arrays(atom->nmax);
  atom->add_callback(LAMMPS_NS::Atom::GROW);
  atom->add_callback(LAMMPS_NS::Atom::RESTART);
}
FixWallGranulaw::~FixWallGranulaw()
{
  atom->delete_callback(id, LAMMPS_NS::Atom::GROW);
  atom->delete_callback(id, LAMMPS_NS::Atom::RESTART);
}

void FixWallGranulaw::init()
{
  masses_.find(lmp);
  if (kind_ == Kind::planes && domain->periodicity[axis_]) stop_all(lmp, fmt::format("{}: the box is periodic across the planes", where_));
  if (kind_ == Kind::cylinder && (domain->xperiodic || domain->yperiodic)) stop_all(lmp, fmt::format("{}: the box is periodic across the cylinder", where_));
  if (kind_ != Kind::region) return;
  region_ = region_of(domain, region_id_);
  if (!region_ || region_->tmax > slots_) stop_all(lmp, fmt::format("{}: region '{}' is gone or another one", where_, region_id_));
  moves_ = region_->dynamic_check();
}

int FixWallGranulaw::walls_near(int i, std::vector<Near>& found)
{
  found.clear();
  double *x = atom->x[i], r = atom->radius[i];
  if (kind_ == Kind::planes) {
    for (int k = 0; k < 2; ++k) {
      const double d = x[axis_] - place_[k];
      if (!(std::abs(d) < r)) continue;
      Near near{.wall = k + 1, .normal = {0, 0, 0}, .distance = std::abs(d)};
      near.normal[axis_] = d * (1.0 / std::abs(d));
      found.push_back(near);
    }
  } else if (kind_ == Kind::cylinder) {
    const double off = std::hypot(x[0], x[1]), d = place_[0] - off;
    if (std::abs(d) < r && off > 0) {
      const double per = (d > 0 ? -1.0 : 1.0) / off;
      found.push_back({.wall = 1, .normal = {x[0] * per, x[1] * per, 0.0}, .distance = std::abs(d)});
    }
  } else if (region_->match(x[0], x[1], x[2])) {
    const int count = region_->surface(x[0], x[1], x[2], r);
    for (int k = 0; k < count; ++k) {
      const auto& c = region_->contact[k];
      Near near{.wall = c.iwall + 1, .normal = {c.delx / c.r, c.dely / c.r, c.delz / c.r}, .distance = c.r};
      if (moves_) region_->velocity_contact(near.velocity, x, k);
      found.push_back(near);
    }
  }
  return static_cast<int>(found.size());
}

void FixWallGranulaw::set_motion(int i, const Near& wall, granulaw_motion& m, double& lever) const
{
  std::copy_n(wall.normal, 3, m.normal);
  m.radius_a = atom->radius[i], m.radius_b = INFINITY;
  m.overlap = m.radius_a - wall.distance;
  m.m_eff = atom->rmass[i];
  if (masses_.any())
    if (const double inverse = masses_.inverse(*atom, i); inverse > 0) m.m_eff = 1.0 / inverse;
  lever = rigid_plastic_ ? wall.distance : m.radius_a - 0.5 * m.overlap;
  static constexpr double none[3] = {0, 0, 0};
  const double *v = atom->v[i], moves[3] = {v[0] - wall.velocity[0], v[1] - wall.velocity[1], v[2] - wall.velocity[2]};
  set_velocities(m, moves, atom->omega[i], none, lever, 0.0);
}

double* FixWallGranulaw::slot(int i, int wall)
{
  double* free = nullptr;
  for (int k = 0; k < slots_; ++k) {
    double* one = of(i) + k * (1 + values_);
    if (one[0] == wall) return one;
    if (one[0] == 0.0 && !free) free = one;
  }
  return free;
}

void FixWallGranulaw::post_force(int)
{
  if (moves_) region_->prematch(), region_->set_velocity();
  granulaw_motion m{};
  granulaw_answer now{};
  m.size = sizeof m, now.size = sizeof now;
  m.dt = update->dt, m.asked_again = update->setupflag;
  std::vector<Near> near;
  force_ = {0, 0, 0};
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit)) continue;
    walls_near(i, near);
    for (double* one = of(i); one < of(i) + stride_; one += 1 + values_)
      if (one[0] != 0.0 && std::none_of(near.begin(), near.end(), [&](const Near& wall) { return wall.wall == one[0]; })) std::fill_n(one, 1 + values_, 0.0);
    for (const Near& wall : near) {
      double* mine = slot(i, wall.wall);
      if (!mine) stop_one(lmp, fmt::format("{}: atom {} touches more than {} walls", where_, atom->tag[i], slots_));
      mine[0] = wall.wall;
      double lever, arm[3];
      set_motion(i, wall, m, lever);
      const ContactLaw& law = laws_[atom->type[i]];
      if (!advance(law, m, mine + 1, now, books_.own.data())) stop_one(lmp, fmt::format("{}: the motion of atom {} has no number", where_, atom->tag[i]));
      if (now.beyond) Books::range(lmp, books_.own.data(), law, m, now, atom->tag[i]);
      cross(m.normal, now.shear, arm);
      for (int c = 0; c < 3; ++c) {
        const double push = now.normal * m.normal[c] + now.shear[c];
        force_[c] += push, atom->f[i][c] += push;
        atom->torque[i][c] += now.couple[c] - lever * arm[c];
      }
    }
  }
}

double FixWallGranulaw::compute_scalar()
{
  granulaw_motion m{};
  granulaw_state state{};
  m.size = sizeof m, state.size = sizeof state;
  double mine = 0.0, all = 0.0, lever;
  std::vector<Near> near;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit)) continue;
    walls_near(i, near);
    for (const Near& wall : near) {
      const double* history = slot(i, wall.wall);
      if (!history || history[0] == 0.0) continue;
      set_motion(i, wall, m, lever);
      if (granulaw_state_of(laws_[atom->type[i]].law.get(), 1, &m, history + 1, &state) == GRANULAW_OK) mine += state.stored_energy;
    }
  }
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

double FixWallGranulaw::compute_vector(int k)
{
  double mine = k < Books::values ? books_.value(k) : force_[k - Books::values], all = 0.0;
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

void FixWallGranulaw::write_restart(FILE* file)
{
  books_.write(lmp, file);
}
void FixWallGranulaw::restart(char* buffer)
{
  books_.read(lmp, buffer, warned_);
}
int FixWallGranulaw::pack_exchange(int i, double* buffer)
{
  std::copy_n(of(i), stride_, buffer);
  return stride_;
}
int FixWallGranulaw::unpack_exchange(int i, double* buffer)
{
  std::copy_n(buffer, stride_, of(i));
  return stride_;
}
int FixWallGranulaw::pack_restart(int i, double* buffer)
{
  buffer[0] = 1 + pack_exchange(i, buffer + 1);
  return 1 + stride_;
}
void FixWallGranulaw::unpack_restart(int i, int nth)
{
  double* extra = atom->extra[i];
  int m = 0;
  for (int k = 0; k < nth; ++k) m += static_cast<int>(extra[m]);
  if (static_cast<int>(extra[m]) != 1 + stride_)
    stop_one(lmp, fmt::format("{}: its contacts have {} values and {:.0f} in the restart file: keep the wall, friction, rolling and tangential as they were", where_,
                              stride_, extra[m] - 1));
  unpack_exchange(i, extra + m + 1);
}

}  // namespace granulaw::lammps
