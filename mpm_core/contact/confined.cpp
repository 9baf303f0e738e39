#include "contact/confined.hpp"

#include <algorithm>
#include <cmath>

#include "contact/confined_modes.hpp"

namespace granulaw {

namespace {

// of the law, docs/theory/confined.md
constexpr double least_free = 0.004;    // psi of a closed cell
constexpr double crowded_from = 0.35;   // psi_1, below which the last free surface hardens the faces
constexpr double crowding = 2.0 / 3.0;  // of a hollow sphere's pressure over Y ln
constexpr double stiffening = 0.6;      // exponent of psi in the local compliance of a face
constexpr double least_local = 0.3;     // local part of that compliance
constexpr double closing = 2.75;        // p/Y at which the cell's bulk modulus takes over
constexpr double tabor_strain = 0.2;    // of an indentation, times a/R: Tabor, The Hardness of Metals (1951)
constexpr double largest_ball = 1.6;
// of the step
constexpr double lazy = 2e-3, lazy_young = 2e-4, lazy_of_depth = 0.1, lazy_turn = 1e-2;  // of a refresh
constexpr double largest_mode = 2.0;      // Q beyond which all forces are scaled first
constexpr double largest_raise = 0.05;    // of a force, by one step of the return
constexpr double no_area = 1e-9, no_cap = 1e-9, least_stiffness = 1e-6;

double cube(double x) { return x * x * x; }

std::array<double, 6> dyad(const Vector& n)
{
  return {n[0] * n[0], n[1] * n[1], n[2] * n[2], n[1] * n[2], n[0] * n[2], n[0] * n[1]};
}
/// n.strain.n, of a symmetric tensor.
double along(const std::array<double, 6>& nn, const std::array<double, 6>& e)
{
  return nn[0] * e[0] + nn[1] * e[1] + nn[2] * e[2] + 2 * (nn[3] * e[3] + nn[4] * e[4] + nn[5] * e[5]);
}

/// Of a component, in products of two symmetric tensors.
constexpr double weight(std::size_t component) { return component < 3 ? 1.0 : 2.0; }
constexpr std::size_t at_triangle(std::size_t row, std::size_t column) { return row * (row + 1) / 2 + column; }
double spring_energy(double force, double stiffness) { return 0.5 * force * force / stiffness; }
/// Largest force that the face bears now, on F^2 + 6 T^2: between refreshes it goes on with its last slope.
double cap_now(const SideState& s) { return std::max(s.cap + s.cap_slope * (s.overlap - s.cached_overlap), 0.5 * s.cap) / std::sqrt(1.0 + s.sheared); }

/// Lame's, times the particle's volume.
struct Moduli
{
  double lame, twice_shear;
  static Moduli of(const PlasticBody& body)
  {
    const double nu = body.poisson_ratio(), twice_shear = confined_volume * body.youngs_modulus() / (1.0 + nu);
    return {twice_shear * nu / (1.0 - 2.0 * nu), twice_shear};
  }
};

double strain_energy(const PlasticBody& body, const std::array<double, 6>& e)
{
  const Moduli m = Moduli::of(body);
  const double trace = e[0] + e[1] + e[2];
  return 0.5 * (m.lame * trace * trace + m.twice_shear * along(e, e));
}

double volume_at_rest(const PlasticBody& body) { return confined_volume * std::exp(-closing / body.bulk_modulus()); }
double cell_pressure(const PlasticBody& body, double volume) { return std::max(body.bulk_modulus() * std::log(volume_at_rest(body) / volume), 0.0); }
double cell_energy(const PlasticBody& body, double volume)
{
  const double rest = volume_at_rest(body);
  return volume < rest ? body.bulk_modulus() * (volume * (std::log(volume / rest) - 1.0) + rest) : 0.0;
}

}  // namespace

int ConfinedParticle::find(std::int64_t key, const Vector& normal) const
{
  for (std::size_t i = 0; i < sides.size(); ++i)
    if (sides[i].key == key && dot(sides[i].cached_normal, normal) > 0.3) return static_cast<int>(i);
  return -1;
}

int ConfinedParticle::insert(std::int64_t key, const Vector& normal, double overlap)
{
  const auto at = std::upper_bound(sides.begin(), sides.end(), key, [](std::int64_t k, const SideState& s) { return k < s.key; });
  SideState side;
  side.key = key, side.overlap = side.cached_overlap = overlap, side.cached_normal = normal;
  fresh_ = false;
  const auto place = at - sides.begin();
  sides.insert(at, side);
  return static_cast<int>(place);
}

int ConfinedParticle::take(const PlasticBody& body, std::int64_t key, const Vector& normal, double overlap, double deepest)
{
  const int place = insert(key, normal, overlap);
  SideState& side = sides[static_cast<std::size_t>(place)];
  side.deepest = std::max(deepest, overlap), side.touched = true;
  side.force = body.pair(overlap, side.deepest).force;
  dissipate(body, body.lost(side.deepest));
  return place;
}

void ConfinedParticle::remove(int i)
{
  const SideState& s = sides[static_cast<std::size_t>(i)];
  if (confined() && s.force > 0) state.dissipated += spring_energy(s.force, s.stiffness);
  sides.erase(sides.begin() + i);
  fresh_ = false;
}

void ConfinedParticle::dissipate(const PlasticBody& body, double energy)
{
  state.dissipated += energy;
  if (body.hardens()) state.plastic_strain = std::max(state.plastic_strain + energy / (confined_volume * body.flow_stress(state.plastic_strain)), 0.0);
}

std::span<const SideAnswer> ConfinedParticle::advance(const PlasticBody& body, std::span<const SideStep> steps, ConfinedRoom& room, bool whole)
{
  if (!confined()) return advance_apart(body, steps, room, whole);
  const bool stale = move(steps);
  if (stale) refresh(body, steps, room);
  press_closed_cell(body, stale);
  double lag = strain_energy(body, state.strain);  // the mean strain balances the trial forces: energy that the flow leaves over
  predict(body, steps, room);
  lag -= strain_energy(body, state.strain);
  flow(modes_of(room), room);
  double pressure = 0;
  room.answers.resize(sides.size());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    SideState& s = sides[i];
    const Cache& c = cache_[i];
    const double before = s.force, trial = room.trial[i], v = room.plastic[i] + room.scaled * trial / s.stiffness;
    // modes press a face onto a plane without a force, too
    const double force = trial > 0 ? trial - s.stiffness * room.plastic[i] : c.area > no_area ? -s.stiffness * (room.gaps[i] + v) : 0.0;
    s.force = std::max(force, 0.0);
    s.touched |= force > 0;
    s.gap = force > 0 || !s.touched ? 0.0 : trial > 0 ? -force / s.stiffness : std::max(room.gaps[i] + v, 0.0);
    dissipate(body, 0.5 * (before + s.force) * v);
    lag += 0.5 * (before + s.force) * (steps[i].advance - (s.force - before) / s.stiffness - v);
    room.answers[i] = {s.force + c.area * bulk_, s.stiffness + (bulk_ > 0 ? 3.0 * body.bulk_modulus() * c.area * c.area / volume_ : 0.0),
                       trial > 0 ? std::max(v, 0.0) : 0.0, c.area};
    pressure += s.force * c.lever / 3.0;
  }
  state.dissipated += lag;
  pressure_ = pressure;
  state.share = std::max(state.share, std::clamp((pressure - begins_at) / (complete_at - begins_at), 0.0, 1.0));
  return room.answers;
}

/// The pair law of each side by itself; confines the particle where it must.
std::span<const SideAnswer> ConfinedParticle::advance_apart(const PlasticBody& body, std::span<const SideStep> steps, ConfinedRoom& room, bool whole)
{
  room.answers.resize(sides.size()), room.of_pair.resize(sides.size());
  int loaded = 0;
  pressure_ = 0;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    SideState& s = sides[i];
    s.overlap += steps[i].advance;
    s.cached_normal = steps[i].normal;
    const double before = s.deepest;
    s.deepest = s.overlap > 0 ? std::max(before, s.overlap) : 0.0;  // 0: the contact has ended
    const bool deepens = s.deepest > before;
    const PlasticBody::PairAnswer now = body.pair(s.overlap, s.deepest);
    const double spring = now.stored > 0 ? 0.5 * now.force * now.force / now.stored : least_stiffness;
    const double flow = deepens ? std::max(steps[i].advance - (now.force - s.force) / spring, 0.0) : 0.0;
    if (deepens) dissipate(body, now.lost - body.lost(before));
    s.force = now.force, s.stiffness = spring, s.touched |= now.force > 0;
    s.gap = now.force > 0 || !s.touched ? 0.0 : std::max(now.residual - s.overlap, 0.0);
    room.answers[i] = {now.force, now.stiffness, flow, now.area};
    room.of_pair[i] = {now.force, now.stored, 0.0, s.overlap, s.gap};
    pressure_ += now.force * (1.0 - s.overlap) / (3.0 * confined_volume);
    loaded += now.force > 0;
  }
  if (whole && pressure_ > begins_at && loaded > 1) confine(body, room.of_pair);
  return room.answers;
}

std::span<const SideAnswer> ConfinedParticle::answers(ConfinedRoom& room) const
{
  room.answers.resize(sides.size());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const SideState& s = sides[i];
    const double area = confined() && fresh_ ? cache_[i].area : 0.0;
    room.answers[i] = {s.force + area * bulk_, std::max(s.stiffness, least_stiffness), 0.0, area};
  }
  return room.answers;
}

void ConfinedParticle::confine(const PlasticBody& body, std::span<const SideOfPair> of_pair)
{
  // the mean strain in equilibrium with the forces, as far as the stored energies pay for it
  std::array<double, 6> stress{};
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const std::array<double, 6> nn = dyad(sides[i].cached_normal);
    for (std::size_t q = 0; q < 6; ++q) stress[q] += of_pair[i].force * (1.0 - of_pair[i].overlap) * nn[q] / confined_volume;
  }
  const double compliance = (1.0 + body.poisson_ratio()) / body.youngs_modulus(), mean = body.poisson_ratio() / body.youngs_modulus() * (stress[0] + stress[1] + stress[2]);
  for (std::size_t q = 0; q < 6; ++q) state.strain[q] = compliance * stress[q] - (q < 3 ? mean : 0.0);
  constexpr double most = 0.75;  // of a side's energy
  const auto of_strain = [&](std::size_t i) { return 0.5 * of_pair[i].force * (1.0 - of_pair[i].overlap) * along(dyad(sides[i].cached_normal), state.strain); };
  double part = 1;  // of the energy of that strain
  for (std::size_t i = 0; i < sides.size(); ++i)
    if (const double energy = of_strain(i); energy > most * of_pair[i].stored) part = std::min(part, most * of_pair[i].stored / energy);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    SideState& s = sides[i];
    const SideOfPair& from = of_pair[i];
    s.force = from.force, s.overlap = from.overlap, s.gap = from.gap;
    s.touched |= from.force > 0 || from.gap > 0;
    s.stiffness = from.force > 0 ? 0.5 * from.force * from.force / (from.stored - part * of_strain(i)) : least_stiffness;
    s.cap = s.cap_slope = 0;
    if (from.lost > 0) dissipate(body, from.lost);
  }
  for (double& e : state.strain) e *= std::sqrt(part);
  state.share = 1e-12;
  fresh_ = false;
}

/// Moves the planes. True: the caches no longer hold.
bool ConfinedParticle::move(std::span<const SideStep> steps)
{
  bool stale = !fresh_;
  const double most = lazy * std::max(free_share_, 0.05);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    SideState& s = sides[i];
    s.overlap += steps[i].advance;
    const Vector &n = steps[i].normal, &c = s.cached_normal;
    stale |= std::abs(s.overlap - s.cached_overlap) > std::min(most, lazy_young + lazy_of_depth * std::max(state.grown_radius - 1.0 + s.overlap, 0.0));
    stale |= std::abs(c[0] - n[0]) + std::abs(c[1] - n[1]) + std::abs(c[2] - n[2]) > lazy_turn;
    if (state.closed && fresh_) state.cell_volume -= cache_[i].area * steps[i].advance;
  }
  return stale;
}

void ConfinedParticle::refresh(const PlasticBody& body, std::span<const SideStep> steps, ConfinedRoom& room)
{
  std::vector<double>& before = room.gaps;  // overlaps of the last refresh
  before.resize(sides.size());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    before[i] = sides[i].cached_overlap;
    SideState& s = sides[i];
    s.cached_overlap = s.overlap, s.cached_normal = steps[i].normal;
    s.cached_elastic = s.force > 0 ? s.force / s.stiffness + (1.0 - s.overlap) * along(dyad(s.cached_normal), state.strain) : 0.0;
  }
  if (body.hardens()) state.flow_stress = body.flow_stress(state.plastic_strain);
  cut(true, room);
  const double crowd = free_share_ < crowded_from ? state.flow_stress * crowding * std::log(crowded_from / free_share_) : 0.0;
  const double open = std::pow(free_share_, stiffening), uniform = 1.0 / (confined_volume * body.youngs_modulus());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    SideState& s = sides[i];
    const double area = cache_[i].area, radius = std::sqrt(area / M_PI), height = 1.0 - s.cached_overlap;
    // a face that is younger than its body bears what the body's flow stress gives it
    const double hard = body.hardens() ? std::max(state.flow_stress / body.flow_stress(tabor_strain * radius), 1.0) : 1.0;
    const double all = hard * body.cap(radius) + area * crowd;
    const double cap = std::max(state.share * all + (1.0 - state.share) * body.force(s.cached_overlap), no_cap);
    if (const double way = s.cached_overlap - before[i]; std::abs(way) > 1e-5) s.cap_slope = s.cap > 0 ? std::clamp((cap - s.cap) / way, 0.0, 12.0) : 0.0;
    s.cap = cap;
    // the mean strain has its own part in the compliance of one contact
    const double whole = 1.0 / std::max(body.stiffness(radius), least_stiffness), local = std::max(whole - PlasticBody::own_part * height * height * uniform, least_local * whole) * open;
    if (const double stiffness = 1.0 / local; stiffness > s.stiffness) {  // at constant force: energy is lost
      if (s.force > 0) dissipate(body, spring_energy(s.force, s.stiffness) - spring_energy(s.force, stiffness));
      s.stiffness = stiffness;
    }
  }
  couple(body);
  fresh_ = true;
}

/// Faces of the last refresh's planes, as they stand to the body without its elastic strain. `grows`: the ball grows to its volume first.
void ConfinedParticle::cut(bool grows, ConfinedRoom& room)
{
  const std::size_t n = sides.size();
  room.normals.resize(n), room.heights.resize(n), room.areas.resize(n), cache_.resize(n);
  for (std::size_t i = 0; i < n; ++i) room.normals[i] = sides[i].cached_normal, room.heights[i] = 1.0 - sides[i].cached_overlap + sides[i].cached_elastic;
  room.faces.set_directions(room.normals);
  if (grows) grow(room);
  const CellFaces::Sums sums = room.faces.cut(room.heights, state.grown_radius, room.areas);
  free_share_ = std::max(sums.free_share, least_free), volume_ = sums.volume;
  for (std::size_t i = 0; i < n; ++i) {
    const double height = room.heights[i];
    cache_[i] = {room.areas[i], ConfinedModes::filter(height, state.grown_radius, room.areas[i]), height / confined_volume, dyad(sides[i].cached_normal)};
    for (double& x : cache_[i].dyad) x *= height;
  }
}

/// The ball's radius with which its cell has the particle's volume; no larger than closes the cell.
void ConfinedParticle::grow(ConfinedRoom& room)
{
  double& radius = state.grown_radius;
  const auto at = [&](double r) { return room.faces.cut(room.heights, r, room.areas); };
  for (int k = 0; k < 12; ++k) {
    const CellFaces::Sums now = at(radius);
    const double miss = confined_volume - now.volume;
    if (std::abs(miss) < 1e-6 * confined_volume) return;
    if (now.free_share < least_free && miss >= 0) {
      double low = 0.9, high = radius;
      for (int b = 0; b < 30; ++b) {
        const double middle = 0.5 * (low + high);
        (at(middle).free_share < least_free ? high : low) = middle;
      }
      radius = low;
      return;
    }
    radius = std::clamp(radius + std::clamp(miss / std::max(4 * M_PI * now.free_share * radius * radius, 0.2), -0.1, 0.1), 0.5, largest_ball);
  }
}

/// Matrices of the modes and of the mean strain.
void ConfinedParticle::couple(const PlasticBody& body)
{
  const std::size_t n = sides.size();
  const double over = 1.0 / (state.flow_stress * state.flow_stress);
  const double open = ConfinedModes::open(free_share_);
  coupling_.resize(n * (n + 1) / 2);
  for (std::size_t i = 0, k = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j, ++k)
      coupling_[k] = over * ConfinedModes::coupling(dot(sides[i].cached_normal, sides[j].cached_normal), open * cache_[i].filter * cache_[j].filter);
  const Moduli m = Moduli::of(body);
  std::array<double, 21>& h = elastic_;
  for (std::size_t p = 0; p < 6; ++p)
    for (std::size_t q = 0; q <= p; ++q) h[at_triangle(p, q)] = (p == q ? weight(p) * m.twice_shear : 0.0) + (p < 3 ? m.lame : 0.0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t p = 0; p < 6; ++p)
      for (std::size_t q = 0; q <= p; ++q) h[at_triangle(p, q)] += sides[i].stiffness * weight(p) * cache_[i].dyad[p] * weight(q) * cache_[i].dyad[q];
  for (std::size_t p = 0; p < 6; ++p)
    for (std::size_t q = 0; q <= p; ++q) {
      double z = h[at_triangle(p, q)];
      for (std::size_t t = 0; t < q; ++t) z -= h[at_triangle(p, t)] * h[at_triangle(q, t)];
      h[at_triangle(p, q)] = p == q ? 1.0 / std::sqrt(std::max(z, 1e-12)) : z * h[at_triangle(q, q)];
    }
}

/// A closed cell bears its volume's elastic pressure besides. Its volume is carried; a refresh may only take it to lower energy.
void ConfinedParticle::press_closed_cell(const PlasticBody& body, bool refreshed)
{
  const bool closed = free_share_ <= least_free * 1.0001;
  const double before = state.closed ? cell_energy(body, state.cell_volume) : 0.0;
  const double now = volume_ * std::exp(-(state.strain[0] + state.strain[1] + state.strain[2]));  // volume_: of the body without its strain
  if (closed && !state.closed)
    state.cell_volume = std::max(now, volume_at_rest(body));
  else if (closed && refreshed)
    state.cell_volume = std::max(state.cell_volume, now);
  if (state.closed && refreshed) state.dissipated += before - (closed ? cell_energy(body, state.cell_volume) : 0.0);
  state.closed = closed;
  bulk_ = closed ? cell_pressure(body, state.cell_volume) : 0.0;
}

/// Elastic forces of the step, room.trial, with the mean strain in equilibrium, and gaps of sides without one, room.gaps.
void ConfinedParticle::predict(const PlasticBody& body, std::span<const SideStep> steps, ConfinedRoom& room)
{
  const std::size_t n = sides.size();
  std::array<double, 6>& e = state.strain;
  std::array<double, 6> more{};
  for (std::size_t i = 0; i < n; ++i)
    if (sides[i].force > 0) {
      const double f = sides[i].force + sides[i].stiffness * steps[i].advance;
      for (std::size_t q = 0; q < 6; ++q) more[q] += f * cache_[i].dyad[q];
    }
  const Moduli m = Moduli::of(body);
  for (std::size_t q = 0; q < 6; ++q) more[q] = weight(q) * (more[q] - m.twice_shear * e[q]) - (q < 3 ? m.lame * (e[0] + e[1] + e[2]) : 0.0);
  const std::array<double, 21>& h = elastic_;
  for (std::size_t p = 0; p < 6; ++p) {
    for (std::size_t q = 0; q < p; ++q) more[p] -= h[at_triangle(p, q)] * more[q];
    more[p] *= h[at_triangle(p, p)];
  }
  for (std::size_t p = 6; p-- > 0;) {
    for (std::size_t q = p + 1; q < 6; ++q) more[p] -= h[at_triangle(q, p)] * more[q];
    more[p] *= h[at_triangle(p, p)];
  }
  for (std::size_t q = 0; q < 6; ++q) e[q] += more[q];

  room.trial.resize(n), room.gaps.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const SideState& s = sides[i];
    const double way = steps[i].advance - along(cache_[i].dyad, more);
    room.gaps[i] = (s.force > 0 ? -s.force / s.stiffness : s.gap) - way;
    room.trial[i] = cache_[i].area > no_area ? std::max(-s.stiffness * room.gaps[i], 0.0) : 0.0;
  }
}

/// Q of the trial forces and its slopes, room.mode = dQ^2/dF. Far outside all forces are scaled first.
double ConfinedParticle::modes_of(ConfinedRoom& room)
{
  const std::size_t n = sides.size();
  room.mode.assign(n, 0.0);
  for (std::size_t i = 0, k = 0; i < n; ++i) {
    const double x = room.trial[i] * cache_[i].lever;
    for (std::size_t j = 0; j < i; ++j, ++k) {
      room.mode[i] += coupling_[k] * room.trial[j] * cache_[j].lever;
      room.mode[j] += coupling_[k] * x;
    }
    room.mode[i] += coupling_[k++] * x;
  }
  double q2 = 0;
  for (std::size_t i = 0; i < n; ++i) {
    room.mode[i] *= state.share;
    q2 += room.mode[i] * room.trial[i] * cache_[i].lever;
    room.mode[i] *= 2.0 * cache_[i].lever;
  }
  const double q = std::sqrt(std::max(q2, 1e-12));
  room.scaled = 0;
  if (!(q > largest_mode)) return q;
  const double part = largest_mode / q;
  for (std::size_t i = 0; i < n; ++i) room.trial[i] *= part, room.mode[i] *= part;
  room.scaled = 1.0 / part - 1.0;
  return largest_mode;
}

/// Plastic way of each side, room.plastic: one Newton step onto all yield surfaces that the trial forces are outside of.
///     g_i = [(F_i/L_i)^3 + Q^3]^(1/3) - 1 <= 0,   v_i = lambda_i dg_i/dF_i (own part) + B dQ^2/dF_i,   B = sum lambda_j dg_j/dQ^2
/// The coupling has rank 2, so the multipliers follow from B and S = sum_j stiffness_j lambda_j (own_j) (dQ^2/dF_j).
void ConfinedParticle::flow(double mode, ConfinedRoom& room)
{
  const std::size_t n = sides.size();
  const double mode3 = cube(mode);
  room.outside.clear();
  room.plastic.assign(n, 0.0);
  double stiff_modes = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (!(room.trial[i] > 0)) continue;
    stiff_modes += sides[i].stiffness * room.mode[i] * room.mode[i];
    const double inverse_cap = 1.0 / cap_now(sides[i]), bears = room.trial[i] * inverse_cap, all = cube(bears) + mode3;
    if (!(all > 1.0)) continue;
    const double q = std::cbrt(all), per = 1.0 / (q * q), u = std::max(bears, 0.05);
    room.outside.push_back({i, q - 1.0, u * u * per * inverse_cap, 0.5 * mode * per, 0.0});
  }
  if (room.outside.empty()) return;
  double common = 0;
  for (int pass = 0; pass < 4; ++pass) {
    double a11 = 1, a12 = 0, b1 = 0, a21 = 0, a22 = 1, b2 = 0;
    for (const ConfinedRoom::Surface& g : room.outside) {
      const double k = sides[g.side].stiffness, soft = 1.0 / (g.own * g.own * k), f = g.own * k * room.mode[g.side], e = f + g.common * stiff_modes;
      a11 += g.common * e * soft, a12 += g.common * g.common * soft, b1 += g.common * g.excess * soft;
      a21 += f * e * soft, a22 += f * g.common * soft, b2 += f * g.excess * soft;
    }
    const double det = 1.0 / (a11 * a22 - a12 * a21), b = (b1 * a22 - a12 * b2) * det, s = (a11 * b2 - a21 * b1) * det;
    common = 0;
    for (ConfinedRoom::Surface& g : room.outside) {
      const double k = sides[g.side].stiffness;
      g.rate = (g.excess - (g.own * k * room.mode[g.side] + g.common * stiff_modes) * b - g.common * s) / (g.own * g.own * k);
      common += g.common * std::max(g.rate, 0.0);
    }
    if (std::erase_if(room.outside, [](const ConfinedRoom::Surface& g) { return g.rate < 0; }) == 0) break;
  }
  for (std::size_t i = 0; i < n; ++i) room.plastic[i] = common * room.mode[i];
  for (const ConfinedRoom::Surface& g : room.outside) room.plastic[g.side] += g.rate * g.own;
  bool raises = false;
  for (std::size_t i = 0; i < n; ++i)
    raises |= room.trial[i] > 0 && -sides[i].stiffness * room.plastic[i] > largest_raise * (room.trial[i] + sides[i].cap);
  if (!raises) return;
  double q = 1;  // all forces scaled onto the surface
  for (std::size_t i = 0; i < n; ++i)
    if (room.trial[i] > 0) q = std::max(q, std::cbrt(cube(room.trial[i] / cap_now(sides[i])) + mode3));
  for (std::size_t i = 0; i < n; ++i) room.plastic[i] = room.trial[i] > 0 ? room.trial[i] * (1.0 - 1.0 / q) / sides[i].stiffness : 0.0;
}

void ConfinedParticle::restore(const PlasticBody& body, ConfinedRoom& room)
{
  fresh_ = false;
  if (!confined() || sides.empty() || !(sides.front().cap > 0)) return;  // not refreshed since it was confined
  cut(false, room);
  couple(body);
  fresh_ = true;
  bulk_ = state.closed ? cell_pressure(body, state.cell_volume) : 0.0;
}

double ConfinedParticle::stored(const PlasticBody& body) const
{
  double all = 0;
  for (const SideState& s : sides)
    if (s.force > 0) all += confined() ? spring_energy(s.force, s.stiffness) : body.pair(s.overlap, s.deepest).stored;
  if (!confined()) return all;
  all += strain_energy(body, state.strain);
  return state.closed ? all + cell_energy(body, state.cell_volume) : all;
}

}  // namespace granulaw
