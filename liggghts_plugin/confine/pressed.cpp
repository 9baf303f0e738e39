// Which particles are pressed, and how their contacts come from the loops of single contacts.
#include <algorithm>
#include <cmath>

#include "contact/confined_modes.hpp"
#include "liggghts_plugin/confine/fix_confined.hpp"
#include "liggghts_plugin/engine/private_members.hpp"

namespace granulaw::plugin {

GRANULAW_EXPOSE(SquaredReach, LAMMPS_NS::Neighbor, cutneighmaxsq);

namespace {

/// Of the sum of radii: reach of the neighbour lists. A ball in a bed of density .99 bulges to 1.34 of its radius.
constexpr double list_reach = 1.4;

}  // namespace

double FixConfined::pressing_overlaps(const PlasticBody& body)
{
  constexpr double pressed_from = 0.5;  // of the pressure where a particle begins to be confined: 20 steps bring it nowhere near that
  constexpr double deepest = 0.1;       // overlap of one contact, over R, to which this bounds its force
  double per_overlap = 0.0;
  for (int k = 1; k <= 20; ++k) per_overlap = std::max(per_overlap, body.force(k * deepest / 20) / (k * deepest / 20));
  return pressed_from * ConfinedParticle::begins_at * 3.0 * confined_volume / per_overlap;
}

void FixConfined::widen_lists()
{
  const auto& words = session_->pair_options->own_words("confinement");
  takes_all = words.empty() || words[0] != "auto";
  int any = std::ranges::any_of(particles_.begin(), particles_.begin() + atom->nlocal, &Particle::pressed);
  MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, world);
  takes_some = asks_walls = takes_all || any != 0;
  if (takes_some) neighbor->register_contact_dist_factor(list_reach);
}

/// The first particle was pressed in a run: wide lists are the costly part of a bed that flows, and it had none.
void FixConfined::pre_exchange()
{
  if (!std::exchange(widens_, false)) return;
  const double before = neighbor->contactDistanceFactor;
  neighbor->register_contact_dist_factor(list_reach);
  neighbor->cutneighmax = (neighbor->cutneighmax - neighbor->skin) * neighbor->contactDistanceFactor / before + neighbor->skin;
  neighbor->*exposed(SquaredReach{}) = neighbor->cutneighmax * neighbor->cutneighmax;
  comm->setup();
  if (neighbor->style) neighbor->setup_bins();
}

int FixConfined::look(const LAMMPS_NS::NeighList& list)
{
  const int nlocal = atom->nlocal;
  int changes = 0;
  if (takes_all) {
    for (int i = 0; i < nlocal; ++i) changes += !std::exchange(particle(i).pressed, true);
    return changes;
  }
  if (!walls_known_) find_walls();
  loads_.assign(static_cast<std::size_t>(nlocal), {});
  const double *const x = atom->x[0], *const radius = atom->radius;
  for (int ii = 0; ii < list.inum; ++ii) {
    const int i = list.ilist[ii], count = list.numneigh[i];
    const int* const neighbours = list.firstneigh[i];
    for (int jj = 0; jj < count; ++jj) {
      const int j = neighbours[jj] & NEIGHMASK;
      const Vector d{x[3 * j] - x[3 * i], x[3 * j + 1] - x[3 * i + 1], x[3 * j + 2] - x[3 * i + 2]};
      const double touch = radius[i] + radius[j], d2 = dot(d, d);
      if (!(d2 < touch * touch)) continue;
      const double half = 0.5 * (touch - std::sqrt(d2));
      for (const int k : {i, j}) {
        if (k >= nlocal) continue;
        Load& load = loads_[static_cast<std::size_t>(k)];
        load.overlaps += half / radius[k], ++load.contacts;
      }
    }
  }
  seeks_ = asks_walls = true;
  collect_walls();
  seeks_ = false, asks_walls = takes_some;
  for (int i = 0; i < nlocal; ++i) {
    const Load& load = loads_[static_cast<std::size_t>(i)];
    bool& pressed = particle(i).pressed;
    const bool begins = !pressed && load.contacts > 1 && load.overlaps > pressing_overlaps_[static_cast<std::size_t>(atom->type[i])];
    const bool ends = pressed && load.contacts == 0 && !particle(i).law.confined();
    if (begins || ends) pressed = begins, ++changes;
  }
  return changes;
}

void FixConfined::choose(PairGran& pair)
{
  if (!pair.computeflag()) return;
  const bool renewed = neighbor->ago == 0;
  advances_ = pair.shearupdate() != 0;
  links_known_ &= !renewed;
  const bool looks = takes_all ? renewed : advances_ && update->ntimestep % planes_every == 0;
  if (!looks && !(renewed && takes_some)) return;
  int found[2] = {looks ? look(*pair.list) : 0, 0};  // changes, particles that are pressed
  for (int i = 0; i < atom->nlocal; ++i) found[1] += particle(i).pressed;
  MPI_Allreduce(MPI_IN_PLACE, found, 2, MPI_INT, MPI_SUM, world);
  const bool some = takes_all || found[1] > 0;
  if (some || found[0] > 0) {
    if (!links_known_) renew(*pair.list);
    if (found[0] > 0) {
      mark_pressed();
      drop_sides();
      take_over(pair);
    }
  }
  if (some != takes_some) {
    takes_some = asks_walls = some;
    if (some && neighbor->contactDistanceFactor < list_reach) widens_ = true, next_reneighbor = update->ntimestep + 1;
    write_rows();
  }
  pressed = takes_all || !some ? nullptr : pressed_.data();
}

void FixConfined::mark_pressed()
{
  for (int i = 0; i < atom->nlocal; ++i) pressed_[static_cast<std::size_t>(i)] = particle(i).pressed;
  send(Sent::reach);
}

void FixConfined::drop_sides()
{
  for (int i = 0; i < atom->nlocal; ++i) {
    Particle& p = particle(i);
    if (p.pressed) continue;
    for (int q = static_cast<int>(p.links.size()); q-- > 0;) {
      const Link link = p.links[static_cast<std::size_t>(q)];
      const bool is_wall = p.law.sides[static_cast<std::size_t>(q)].key < 0;
      if (!is_wall && link.partner >= 0 && pressed_[static_cast<std::size_t>(link.partner)]) continue;
      if (!is_wall && link.slot >= 0) taken_[static_cast<std::size_t>(link.slot)] = 0;
      remove_side(p, q, false);
    }
  }
}

void FixConfined::take_over(PairGran& pair)
{
  const LAMMPS_NS::NeighList &list = *pair.list, &histories = *pair.listgranhistory;
  const ContactInquiry& loop = *session_->contacts_of(nullptr);
  int slot = 0;
  for (int ii = 0; ii < list.inum; ++ii) {
    const int i = list.ilist[ii];
    for (int jj = 0; jj < list.numneigh[i]; ++jj, ++slot) {
      int& flags = histories.firstneigh[i][jj];
      const int j = list.firstneigh[i][jj] & NEIGHMASK;
      if (flags == 0 || !(pressed_[static_cast<std::size_t>(i)] || pressed_[static_cast<std::size_t>(j)])) continue;
      double* const history = &histories.firstdouble[i][pair.dnum() * jj];
      const double *const a = atom->x[i], *const b = atom->x[j], ri = atom->radius[i], rj = atom->radius[j];
      const Vector way{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, normal = unit(way);
      const double distance = norm(way), overlap = ri + rj - distance;
      const HandedOver had =
          loop.hand_over({atom->type[i], atom->type[j], ri, rj, overlap, history}, times(normal, -1.0), j < atom->nlocal ? 1.0 : 0.5);
      std::fill_n(history, pair.dnum(), 0.0);
      flags = 0;
      if (had.largest_overlap == 0.0) continue;
      const auto take = [&](int k, int other, double sign) {
        if (k < atom->nlocal)
          take_side(k, atom->tag[other], {other, slot}, times(normal, sign), distance, 0.5 * overlap, 0.5 * had.largest_overlap, times(had.shear, 0.5 * sign),
                    0.5 * had.stored);
      };
      take(i, j, 1.0), take(j, i, -1.0);
      taken_[static_cast<std::size_t>(slot)] = 1;
    }
  }
}

int FixConfined::take_side(int i, std::int64_t key, const Link& link, const Vector& normal, double distance, double overlap, double deepest,
                           const Vector& shear, double stored)
{
  Particle& p = particle(i);
  const double radius = atom->radius[i], unit = force_unit(i);
  const int q = p.law.take(body(i), key, normal, overlap / radius, deepest / radius);
  p.links.insert(p.links.begin() + q, link);
  SideState& side = p.law.sides[static_cast<std::size_t>(q)];
  side.distance = distance, side.shear = times(shear, 1.0 / unit);
  counts_[static_cast<std::size_t>(atom->type[i])]->taken[Mechanism::plastic] +=
      stored - body(i).pair(overlap / radius, deepest / radius).stored * unit * radius;
  return q;
}

}  // namespace granulaw::plugin
