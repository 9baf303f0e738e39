#include "liggghts_plugin/confine/fix_confined.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "liggghts_plugin/contact/contact_pieces.hpp"
#include "liggghts_plugin/engine/deck_units.hpp"

namespace granulaw::plugin {

namespace {

/// Of the smaller radius: a plane's largest move, and how near surfaces come before the contact is followed, and how far it is.
constexpr double largest_way = 2e-3, near = 0.02, far = 0.1;

}  // namespace

FixConfined::FixConfined(LAMMPS_NS::LAMMPS* lmp_, int narg, char** arg) : Fix(lmp_, narg, arg), session_(Session::of(lmp_))
{
  if (narg > 3) stop_all(lmp, fmt::format("fix {} {}: found '{}', takes no arguments", id, style_name, arg[3]));
  vector_flag = peratom_flag = restart_peratom = create_attribute = 1;
  size_vector = 7, size_peratom_cols = 4;
  global_freq = peratom_freq = nevery = 1;
  extvector = 0;
  comm_forward = largest_row, comm_reverse = 6;
  session_->confinement = this;
  atom->add_callback(0), atom->add_callback(1);
  grow_arrays(atom->nmax);
  reserve_exchange();
}

FixConfined::~FixConfined()
{
  atom->delete_callback(id, 0), atom->delete_callback(id, 1);
  memory->destroy(rows_);
  if (session_->confinement == this) session_->confinement = nullptr;
}

void FixConfined::init()
{
  if (is_planning) return;
  force_reneighbor = !takes_all, next_reneighbor = -1;
  just_created = 0;  // else Modify::setup() would make all particles new, behind the first forces
  pressed = nullptr, widens_ = false;
  walls_known_ = links_known_ = false;
  only_material_.clear();
  const Law& law = session_->pair_law->law;
  const auto& names = session_->pair_options->own_words("materials");
  const double unit = DeckUnits::of(update->unit_style, style_name).pressure();
  const auto types = static_cast<std::size_t>(atom->ntypes + 1);
  bodies_.clear(), bodies_.resize(types);
  yield_.assign(types, 0.0), pressing_overlaps_.assign(types, 0.0);
  counts_.assign(types, nullptr);
  for (int t = 1; t <= atom->ntypes; ++t) {
    const auto at = static_cast<std::size_t>(t);
    const auto found = law.bodies.find(names[at - 1]);
    const auto counts = session_->statistics.pairs.find({PairKey::particles, t, t});
    if (counts == session_->statistics.pairs.end()) continue;
    if (counts->second.info.needed) check_material(t, found == law.bodies.end() ? nullptr : &found->second);
    if (found == law.bodies.end() || !found->second.material.yields()) continue;
    const LawMaterial& material = found->second.material;
    bodies_[at] = std::make_unique<PlasticBody>(found->second.curve, material.youngs_modulus, material.poisson_ratio, material.flow_stress());
    yield_[at] = material.yield_stress / unit;
    pressing_overlaps_[at] = pressing_overlaps(*bodies_[at]);
    counts_[at] = &counts->second;
  }
  friction_ = nullptr;
  const auto said = session_->meanings.find(pairs_record);
  if (said != session_->meanings.end() && ModelIds::of(said->second.combination).tangential != cm::TANGENTIAL_OFF) {
    force->registry.registerProperty("coeffFrict", &MODEL_PARAMS::createCoeffFrict);
    friction_ = force->registry.getMatrixProperty("coeffFrict", style_name)->data;
  }
}

void FixConfined::check_material(int type, const BodyLaw* body)
{
  const auto refuse = [&](const std::string& why) {
    stop_all(lmp, fmt::format("pair_style gran model mpm: 'confinement {}' {}", takes_all ? "on" : "auto", why));
  };
  if (!body || !body->material.yields()) refuse(fmt::format("needs particles that yield: those of type {} are elastic", type));
  const std::string& name = body->material.name;
  if (!body->is_sphere()) refuse(fmt::format("needs homogeneous spheres: '{}' of type {} has layers or a shape", name, type));
  if (body->curve.axis() && body->curve.axis()->by == AxisTable::By::rate)
    refuse(fmt::format("needs a flow stress without a rate: that of '{}' of type {} depends on it", name, type));
  if (!only_material_.empty() && only_material_ != name)
    refuse(fmt::format("is for particles of one material: between unlike ones, as '{}' and '{}', forces are 9 to 31 % high", only_material_, name));
  only_material_ = name;
}

void FixConfined::find_walls()
{
  walls_.clear();
  std::map<WallPlanes::Key, const FixWallGran*> first;
  for (const auto& [wall, style] : session_->styles) {
    if (!wall) continue;
    const auto [planes, is_new] = walls_.emplace(wall, WallPlanes(*const_cast<FixWallGran*>(wall), world));
    if (const auto [other, is_first] = first.emplace(planes->second.first_key(), wall); !is_first)
      stop_all(lmp, fmt::format("fix {} and fix {} wall/gran: 'confinement' cannot tell these two ids apart: rename one", wall->id, other->second->id));
  }
  walls_known_ = true;
}

void FixConfined::renew(const LAMMPS_NS::NeighList& list)
{
  const int nlocal = atom->nlocal, count = nlocal + atom->nghost;
  links_known_ = true;
  if (!walls_known_) find_walls();
  follow_numbers();
  reach_.resize(static_cast<std::size_t>(count)), pressed_.resize(static_cast<std::size_t>(count));
  for (int i = 0; i < nlocal; ++i) {
    Particle& p = particle(i);
    if (!std::exchange(p.restored, true)) p.law.restore(body(i), room_);
    for (std::size_t q = 0; q < p.links.size(); ++q)
      if (p.law.sides[q].key > 0) p.links[q].partner = p.links[q].slot = -1;
    reach_[static_cast<std::size_t>(i)] = p.reach * atom->radius[i];
  }
  mark_pressed();
  check_reach();
  std::size_t slots = 0;
  for (int ii = 0; ii < list.inum; ++ii) slots += static_cast<std::size_t>(list.numneigh[list.ilist[ii]]);
  taken_.assign(slots, 0);
  const auto meets = [&](int i, int j, int slot, const Vector& normal) {
    Particle& p = particle(i);
    const int q = p.law.find(atom->tag[j], normal);
    if (q >= 0) p.links[static_cast<std::size_t>(q)].partner = j, p.links[static_cast<std::size_t>(q)].slot = slot;
    return q >= 0;
  };
  int slot = 0;
  for (int ii = 0; ii < list.inum; ++ii) {
    const int i = list.ilist[ii];
    for (int jj = 0; jj < list.numneigh[i]; ++jj, ++slot) {
      const int j = list.firstneigh[i][jj] & NEIGHMASK;
      const Vector normal = unit(Vector{atom->x[j][0] - atom->x[i][0], atom->x[j][1] - atom->x[i][1], atom->x[j][2] - atom->x[i][2]});
      const bool first = meets(i, j, slot, normal), second = j >= nlocal || meets(j, i, slot, times(normal, -1.0));
      taken_[static_cast<std::size_t>(slot)] = first && second;
    }
  }
}

void FixConfined::check_reach() const
{
  double largest = 1.0;
  for (int i = 0; i < atom->nlocal; ++i) largest = std::max(largest, particle(i).reach);
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, world);
  if (largest + near <= neighbor->contactDistanceFactor || !session_->first_time("reach of bulged particles") || comm->me != 0) return;
  error->warning(FLERR, fmt::format("granulaw: at step {} a particle bulges to {:.3g} of its radius, and neighbour lists reach {:g} of the radii: contacts that "
                                    "bulging makes beyond that are missed; say 'neigh_modify contact_distance_factor {:.2g}' before the run",
                                    update->ntimestep, largest, neighbor->contactDistanceFactor, largest + 0.1)
                            .c_str());
}

void FixConfined::compute(PairGran& pair, const Observer* observer)
{
  if (pair.computeflag()) {
    const int nlocal = atom->nlocal;
    const bool moves_planes = advances_ && update->ntimestep % planes_every == 0;
    if (moves_planes) {
      for (int i = 0; i < nlocal; ++i) {
        particle(i).reach = std::max(1.0, particle(i).law.state.grown_radius);
        reach_[static_cast<std::size_t>(i)] = particle(i).reach * atom->radius[i];
      }
      send(Sent::reach);
      send(Sent::planes);
    }
    collect(*pair.list);
    collect_walls();
    ghost_halves_.assign(static_cast<std::size_t>(comm_reverse * atom->nghost), 0.0);
    for (int i = 0; i < nlocal; ++i) step(i, moves_planes, !walls_.empty());
    comm->reverse_comm_fix(this);
  }
  if (observer) observe(pair, *observer);
}

void FixConfined::collect(const LAMMPS_NS::NeighList& list)
{
  const double* const x = atom->x[0];
  const double *const radius = atom->radius, *const reach = reach_.data();
  const char* taken = taken_.data();
  for (int ii = 0; ii < list.inum; ++ii) {
    const int i = list.ilist[ii], count = list.numneigh[i];
    const int* const neighbours = list.firstneigh[i];
    for (int jj = 0; jj < count; ++jj) {
      if (taken[jj]) continue;
      const int j = neighbours[jj] & NEIGHMASK;
      if (!(pressed_[static_cast<std::size_t>(i)] | pressed_[static_cast<std::size_t>(j)])) continue;
      const Vector d{x[3 * j] - x[3 * i], x[3 * j + 1] - x[3 * i + 1], x[3 * j + 2] - x[3 * i + 2]};
      const double limit = reach[i] + reach[j] + near * std::min(radius[i], radius[j]), d2 = dot(d, d);
      if (!(d2 < limit * limit)) continue;
      const double distance = std::sqrt(d2);
      const int slot = static_cast<int>(taken - taken_.data()) + jj;
      add_side(i, j, slot, times(d, 1.0 / distance), distance);
      if (j < atom->nlocal) add_side(j, i, slot, times(d, -1.0 / distance), distance);
      taken_[static_cast<std::size_t>(slot)] = 1;
    }
    taken += count;
  }
}

void FixConfined::add_side(int i, int j, int slot, const Vector& normal, double distance)
{
  Particle& p = particle(i);
  if (p.law.find(atom->tag[j], normal) >= 0) return;
  const double radius = atom->radius[i];
  const int q = p.law.insert(atom->tag[j], normal, 1.0 - 0.5 * (distance + grown(i) - grown(j)) / radius);
  p.links.insert(p.links.begin() + q, Link{.partner = j, .slot = slot});
}

void FixConfined::remove_side(Particle& particle, int q, bool is_lost)
{
  if (is_lost && particle.law.sides[static_cast<std::size_t>(q)].force > 0) ++lost_;
  particle.law.remove(q);
  particle.links.erase(particle.links.begin() + q);
  if (q < static_cast<int>(particle.walls.size())) particle.walls.erase(particle.walls.begin() + q);
}

void FixConfined::collect_walls()
{
  collecting_ = true;
  for (const auto& [wall, planes] : walls_) const_cast<FixWallGran*>(wall)->post_force(0);
  collecting_ = false;
}

Confinement::AtWall FixConfined::at_wall(const FixWallGran& wall, const ContactData& contact, const double* wall_velocity, int mesh,
                                         int triangle, ForceData& on_i)
{
  const int i = contact.i;
  if (seeks_) {
    Load& load = loads_[static_cast<std::size_t>(i)];
    if (const double overlap = atom->radius[i] - contact.r; overlap > 0) load.overlaps += overlap / atom->radius[i], ++load.contacts;
    return AtWall::collected;
  }
  if (!pressed_[static_cast<std::size_t>(i)]) return collecting_ ? AtWall::collected : AtWall::apart;
  Particle& p = particle(i);
  const Vector normal{-contact.en[0], -contact.en[1], -contact.en[2]};
  const WallPlanes::Key key = walls_.at(&wall).key(mesh, triangle);
  int q = p.law.find(key, normal);
  if (!collecting_) {
    if (q < 0) return AtWall::open;
    const Link& link = p.links[static_cast<std::size_t>(q)];
    const Half& half = p.halves[static_cast<std::size_t>(q)];
    if (link.partner != triangle || half.arm == 0.0) return AtWall::open;
    for (int c = 0; c < 3; ++c) on_i.delta_F[c] = half.force[c], on_i.delta_torque[c] = half.arm * half.turn[c];
    return AtWall::acts;
  }
  const double radius = atom->radius[i];
  HandedOver had;
  if (contact.contact_history) {
    had = session_->contacts_of(&wall)->hand_over({contact.itype, contact.jtype, radius, flat, radius - contact.r, contact.contact_history},
                                                  times(normal, -1.0), 1.0);
    std::fill_n(contact.contact_history, wall.dnum(), 0.0);
  }
  if (q < 0) {
    if (!(contact.r < grown(i) + near * radius)) return AtWall::collected;
    if (had.largest_overlap > 0)
      q = take_side(i, key, {}, normal, contact.r, radius - contact.r, had.largest_overlap, had.shear, had.stored);
    else {
      q = p.law.insert(key, normal, 1.0 - contact.r / radius);
      p.links.insert(p.links.begin() + q, Link{});
    }
    p.walls.insert(p.walls.begin() + q, Wall{});
  }
  Wall& now = p.walls[static_cast<std::size_t>(q)];
  if (now.seen && now.distance <= contact.r) return AtWall::collected;  // another triangle of the plane is nearer
  now = {true, contact.r, normal, wall_velocity ? Vector{wall_velocity[0], wall_velocity[1], wall_velocity[2]} : Vector{}};
  p.links[static_cast<std::size_t>(q)] = {triangle, contact.jtype};
  return AtWall::collected;
}

bool FixConfined::follow(int i, int q, bool moves_planes)
{
  Particle& p = particle(i);
  SideState& side = p.law.sides[static_cast<std::size_t>(q)];
  const Link link = p.links[static_cast<std::size_t>(q)];
  const double radius = atom->radius[i];
  const bool is_wall = side.key < 0, is_new = side.distance == 0.0;
  const int j = link.partner;
  if (is_wall ? !std::exchange(p.walls[static_cast<std::size_t>(q)].seen, false) : j < 0) {
    remove_side(p, q, true);
    return false;
  }
  double reach = grown(i), smaller = radius;
  Contact now{.normal = {}, .distance = 0.0, .before = side.force};
  if (is_wall)
    now.normal = p.walls[static_cast<std::size_t>(q)].normal, now.distance = p.walls[static_cast<std::size_t>(q)].distance;
  else {
    const double *const a = atom->x[i], *const b = atom->x[j];
    const Vector d{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    now.distance = norm(d), now.normal = times(d, 1.0 / now.distance);
    reach += grown(j), smaller = std::min(radius, atom->radius[j]);
  }
  if (now.distance > reach + far * smaller && !(side.force > 0)) {
    if (!is_wall) taken_[static_cast<std::size_t>(link.slot)] = 0;
    remove_side(p, q, false);
    return false;
  }
  double way = is_new || !advances_ ? 0.0 : side.distance - now.distance;
  if (!is_wall) way *= 0.5;
  if (advances_ && is_new) {  // what began with an overlap, inserted or read, is pressed there now
    side.overlap = is_wall ? 1.0 - now.distance / radius : 1.0 - 0.5 * (now.distance + grown(i) - grown(j)) / radius;
    way = std::max(side.overlap, 0.0) * radius;
    side.overlap = std::min(side.overlap, 0.0);
    begins_pressed_ |= way > 0.0;
  } else if (advances_ && !is_wall && !side.touched)
    side.overlap = 1.0 - (0.5 * (now.distance + grown(i) - grown(j)) + way) / radius;
  if (moves_planes && !is_wall && !is_new) {
    const double *const own = sent_side(i, side.key, now.normal), *const other = sent_side(j, atom->tag[i], times(now.normal, -1.0));
    if (own) now.before = own[0] / force_unit(i);
    if (own && other && (own[0] > 0 || other[0] > 0))
      now.way = std::clamp(plane_way(own[0], own[1], other[0], other[1]), -largest_way * smaller, largest_way * smaller);
  }
  steps_.push_back({now.normal, (way + now.way) / radius});
  contacts_.push_back(now);
  return true;
}

void FixConfined::step(int i, bool moves_planes, bool keeps_halves)
{
  Particle& p = particle(i);
  if (p.links.empty()) return;
  steps_.clear(), contacts_.clear();
  begins_pressed_ = false;
  const double dissipated = p.law.state.dissipated;
  for (int q = 0; q < static_cast<int>(p.links.size());)
    if (follow(i, q, moves_planes)) ++q;
  if (keeps_halves) p.halves.resize(p.links.size());
  p.area = 0.0;
  if (p.links.empty()) return;
  const double held = begins_pressed_ ? p.law.state.dissipated + p.law.stored(body(i)) : 0.0;
  const std::span<const SideAnswer> answers = advances_ ? p.law.advance(body(i), steps_, room_, p.pressed) : p.law.answers(room_);
  const double unit = force_unit(i), energy = unit * atom->radius[i];
  double taken = (p.law.state.dissipated - dissipated) * energy, other = 0.0, paid = 0.0;
  for (std::size_t q = 0; q < p.links.size(); ++q) {
    SideState& side = p.law.sides[q];
    const SideAnswer& answer = answers[q];
    const Contact& contact = contacts_[q];
    p.area += answer.area;
    const double mean = 0.5 * (contact.before + answer.force);
    taken -= mean * unit * contact.way;
    if (begins_pressed_ && side.distance != 0.0) paid += mean * steps_[q].advance;
    if (advances_) side.distance = contact.distance;
    const Half half = half_of(i, static_cast<int>(q), contact, answer, other);
    if (keeps_halves) p.halves[q] = half;
    if (side.key < 0 || !(answer.force > 0)) continue;
    add_to(i, half.force, half.turn, half.arm);
    add_to(p.links[q].partner, times(half.force, -1.0), half.turn, contact.distance - half.arm);
  }
  if (!advances_) return;
  ContactStatistics::Pair& counts = *counts_[static_cast<std::size_t>(atom->type[i])];
  counts.taken[Mechanism::plastic] += taken;
  counts.other_work += other;
  if (begins_pressed_) ++counts.sudden, counts.brought += (p.law.state.dissipated + p.law.stored(body(i)) - held - paid) * energy;
  if (const ParticleColumns energies = session_->energy ? session_->energy->per_atom : ParticleColumns()) {
    double* const row = energies.rows()[i];
    row[EnergyTally::stored] += p.law.stored(body(i)) * energy;
    row[EnergyTally::dissipated] += taken, row[EnergyTally::other_work] += other;
  }
}

FixConfined::Half FixConfined::half_of(int i, int q, const Contact& contact, const SideAnswer& answer, double& work)
{
  Particle& p = particle(i);
  SideState& side = p.law.sides[static_cast<std::size_t>(q)];
  if (!(answer.force > 0)) {
    if (advances_) side.shear = {};
    return {};
  }
  const Link link = p.links[static_cast<std::size_t>(q)];
  const bool is_wall = side.key < 0;
  const int j = link.partner;
  const double radius = atom->radius[i], unit = force_unit(i), share = is_wall ? 1.0 : 0.5, arm = is_wall ? contact.distance : (1.0 - side.overlap) * radius;
  const Vector& n = contact.normal;
  const double friction = friction_ ? friction_[atom->type[i]][is_wall ? link.slot : atom->type[j]] : 0.0;
  if (friction > 0 && advances_) {
    const auto surface = [&](int k, double lever) {  // of k's surface at the contact, n the way to it
      return sum(Vector{atom->v[k][0], atom->v[k][1], atom->v[k][2]}, cross(atom->omega[k], n), lever);
    };
    Vector slide = sum(surface(i, arm), is_wall ? p.walls[static_cast<std::size_t>(q)].velocity : surface(j, arm - contact.distance), -1.0);
    slide = times(sum(slide, n, -dot(slide, n)), update->dt / radius);
    const Vector before = side.shear;
    advance_shear(side, answer, n, slide, friction, share);
    work -= 0.5 * dot(sum(before, side.shear), slide) * unit * radius;
  }
  const Vector shear = times(side.shear, unit);
  return {sum(shear, n, -share * answer.force * unit), cross(n, shear), arm};
}

void FixConfined::add_to(int i, const Vector& force, const Vector& turn, double arm)
{
  double *f = atom->f[i], *torque = atom->torque[i];
  if (i >= atom->nlocal) f = ghost_halves_.data() + comm_reverse * (i - atom->nlocal), torque = f + 3;
  for (int c = 0; c < 3; ++c) f[c] += force[c], torque[c] += arm * turn[c];
}

void FixConfined::find_halves(int i)
{
  Particle& p = particle(i);
  p.halves.resize(p.links.size());
  if (p.links.empty()) return;
  advances_ = false;
  const std::span<const SideAnswer> answers = p.law.answers(room_);
  double work = 0.0;
  for (std::size_t q = 0; q < p.links.size(); ++q) {
    const int j = p.links[q].partner;
    if (p.law.sides[q].key < 0 || j < 0) continue;
    const double *const a = atom->x[i], *const b = atom->x[j];
    const Vector way{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    p.halves[q] = half_of(i, static_cast<int>(q), {.normal = granulaw::unit(way), .distance = norm(way), .before = 0.0}, answers[q], work);
  }
}

void FixConfined::observe(PairGran& pair, const Observer& observer)
{
  const int nlocal = atom->nlocal;
  for (int i = 0; i < nlocal; ++i) find_halves(i);
  send(Sent::halves);
  std::vector<double> history(static_cast<std::size_t>(pair.dnum()), 0.0);
  int flags = 0;
  for (int i = 0; i < nlocal; ++i)
    for (std::size_t q = 0; q < particle(i).links.size(); ++q) {
      const int j = particle(i).links[q].partner;
      if (particle(i).law.sides[q].key < 0 || j < 0 || (j < nlocal && j < i)) continue;
      const double *const a = atom->x[i], *const b = atom->x[j];
      const Vector way{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, normal = granulaw::unit(way);
      const double distance = norm(way);
      Half other;
      if (const double* sent = sent_side(j, atom->tag[i], times(normal, -1.0)))
        other = {{sent[0], sent[1], sent[2]}, {sent[3], sent[4], sent[5]}, sent[6]};
      const Half& own = particle(i).halves[q];
      if (own.arm == 0.0 && other.arm == 0.0) continue;
      ContactData contact;
      ForceData on_i, on_j;
      contact.is_wall = false, contact.has_force_update = true;
      contact.computeflag = pair.computeflag(), contact.shearupdate = pair.shearupdate();
      contact.i = i, contact.j = j, contact.itype = atom->type[i], contact.jtype = atom->type[j];
      contact.radi = atom->radius[i], contact.radj = atom->radius[j], contact.radsum = contact.radi + contact.radj;
      contact.v_i = atom->v[i], contact.v_j = atom->v[j], contact.omega_i = atom->omega[i], contact.omega_j = atom->omega[j];
      contact.r = distance, contact.rsq = contact.r * contact.r, contact.rinv = 1.0 / contact.r, contact.deltan = contact.radsum - contact.r;
      contact.contact_history = history.data(), contact.contact_flags = &flags, contact.area_ratio = 1.0;
      for (int c = 0; c < 3; ++c) {
        contact.en[c] = -normal[c], contact.delta[c] = contact.r * contact.en[c];
        on_i.delta_F[c] = own.force[c] - other.force[c], on_j.delta_F[c] = -on_i.delta_F[c];
        on_i.delta_torque[c] = own.arm * own.turn[c] + (other.arm > 0 ? distance - other.arm : 0.0) * other.turn[c];
        on_j.delta_torque[c] = other.arm * other.turn[c] + (own.arm > 0 ? distance - own.arm : 0.0) * own.turn[c];
      }
      observer(contact, on_i, on_j);
    }
}

double FixConfined::compute_vector(int n)
{
  double own = n == 2 ? 1.0 : n == 5 ? lost_ : 0.0, all = 0.0;
  for (int i = 0; i < atom->nlocal && n != 5; ++i) {
    const Particle& p = particle(i);
    if (n == 0) own += p.law.confined();
    if (n == 6) own += p.pressed;
    if (n == 1) own += p.law.state.closed;
    if (n == 2) own = std::max(own, p.law.state.grown_radius);
    for (std::size_t q = 0; (n == 3 || n == 4) && q < p.links.size(); ++q) {
      const SideState& side = p.law.sides[q];
      const int j = p.links[q].partner;
      if (side.key > 0 && j >= 0 && side.force > 0) own += n == 3 ? 0.5 : 0.5 * (side.distance > atom->radius[i] + atom->radius[j]);
    }
  }
  MPI_Allreduce(&own, &all, 1, MPI_DOUBLE, n == 2 ? MPI_MAX : MPI_SUM, world);
  return all;
}

void FixConfined::write_rows()
{
  for (int i = 0; i < atom->nlocal; ++i) {
    const Particle& p = particle(i);
    if (!bodies_[static_cast<std::size_t>(atom->type[i])]) continue;
    const double unit = force_unit(i), radius = atom->radius[i];
    double* const row = rows_[i];
    row[0] = p.links.empty() ? 0.0 : p.law.pressure() * yield(i), row[1] = p.area * radius * radius, row[2] = p.law.free_share();
    row[3] = p.law.state.dissipated * unit * radius;
  }
}

}  // namespace granulaw::plugin
