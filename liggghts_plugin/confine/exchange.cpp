// What of a particle moves: between ranks, to ghosts, into restart files.
#include <fmt/format.h>

#include <algorithm>

#include "liggghts_plugin/confine/fix_confined.hpp"
#include "liggghts_plugin/particles/number_changes.hpp"

namespace granulaw::plugin {

namespace {

constexpr int head_numbers = 4 + confined_numbers;  // number of sides, reach, the particle's number, whether it is pressed
/// Smallest stiffness in a plane's move, over Y R: of a face without an area.
constexpr double least_stiffness = 1e-6;

}  // namespace

void FixConfined::grow_arrays(int nmax)
{
  particles_.resize(static_cast<std::size_t>(nmax));
  memory->grow(rows_, nmax, size_peratom_cols, style_name);
  array_atom = rows_;
}

void FixConfined::copy_arrays(int from, int to, int)
{
  std::swap(particle(to), particle(from));  // nobody reads the one that was copied
  std::copy_n(rows_[from], size_peratom_cols, rows_[to]);
}

void FixConfined::set_arrays(int i)
{
  particle(i) = Particle{};
  std::fill_n(rows_[i], size_peratom_cols, 0.0);
}

int FixConfined::record_size(const Particle& particle)
{
  return head_numbers + side_numbers * static_cast<int>(particle.links.size());
}

int FixConfined::largest_record() const
{
  int largest = head_numbers;
  for (int i = 0; i < atom->nlocal; ++i) largest = std::max(largest, record_size(particle(i)));
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_INT, MPI_MAX, world);
  return largest;
}

void FixConfined::reserve_exchange() const
{
  constexpr int more_sides = 12;  // than now, until the next set-up
  comm->maxexchange_fix = std::max(comm->maxexchange_fix, largest_record() + more_sides * side_numbers);
}

int FixConfined::pack(Particle& particle, double* buffer) const
{
  double* out = buffer;
  const auto write = [&](double x) { *out++ = x; };
  write(static_cast<double>(particle.links.size())), write(particle.reach), write(particle.number), write(particle.pressed);
  visit_numbers(particle.law.state, write);
  for (SideState& side : particle.law.sides) visit_numbers(side, write);
  return static_cast<int>(out - buffer);
}

int FixConfined::unpack(int i, const double* buffer)
{
  Particle& p = particle(i) = Particle{};
  const double* in = buffer;
  const auto read = [&](double& x) { x = *in++; };
  double sides = 0.0, number = 0.0, pressed = 0.0;
  read(sides), read(p.reach), read(number), read(pressed);
  p.number = static_cast<int>(number), p.pressed = pressed != 0.0;
  visit_numbers(p.law.state, read);
  p.law.sides.resize(static_cast<std::size_t>(sides)), p.links.resize(p.law.sides.size());
  for (SideState& side : p.law.sides) visit_numbers(side, read);
  p.walls.resize(static_cast<std::size_t>(std::ranges::count_if(p.law.sides, [](const SideState& side) { return side.key < 0; })));
  p.halves.resize(p.links.size());
  p.restored = false;
  return static_cast<int>(in - buffer);
}

int FixConfined::pack_restart(int i, double* buffer)
{
  buffer[0] = size_restart(i);
  return 1 + pack(particle(i), buffer + 1);
}

void FixConfined::unpack_restart(int i, int nth)
{
  const double* record = atom->extra[i];
  for (int k = 0; k < nth; ++k) record += static_cast<int>(*record);
  if (record[0] != 1 + head_numbers + side_numbers * record[1])
    stop_one(lmp, fmt::format("read_restart: a particle under 'confinement' has {:.0f} numbers, and this plug-in keeps {:.0f} of one with {:.0f} contacts: another version wrote the file",
                                  record[0], 1 + head_numbers + side_numbers * record[1], record[1]));
  unpack(i, record + 1);
}

void FixConfined::follow_numbers()
{
  const NumberChanges changes(atom->tag, atom->nlocal, [this](int i) -> int& { return particle(i).number; }, world);
  if (changes.none()) return;
  for (int i = 0; i < atom->nlocal; ++i) {
    Particle& p = particle(i);
    for (int q = 0; q < static_cast<int>(p.links.size());) {
      SideState& side = p.law.sides[static_cast<std::size_t>(q)];
      const int now = side.key > 0 ? changes.now(static_cast<int>(side.key)) : 1;
      if (now == 0)
        remove_side(p, q, false);
      else {
        if (side.key > 0) side.key = now;
        ++q;
      }
    }
    if (std::ranges::is_sorted(p.law.sides, {}, &SideState::key)) continue;
    std::ranges::stable_sort(p.law.sides, {}, &SideState::key);
    for (Link& link : p.links) link = Link{};
    p.restored = false;
  }
}

void FixConfined::send(Sent what)
{
  const int count = atom->nlocal + atom->nghost;
  sending_ = what, part_ = 0;
  if (what == Sent::reach) return comm->forward_comm_fix(this);
  columns_ = name_columns + (what == Sent::planes ? 2 : 7);
  int most = 0;
  for (int i = 0; i < atom->nlocal; ++i) most = std::max(most, static_cast<int>(particle(i).links.size()));
  MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_INT, MPI_MAX, world);
  row_ = 1 + most * columns_;
  sent_.assign(static_cast<std::size_t>(row_ * count), 0.0);
  for (int i = 0; i < atom->nlocal; ++i) write_sides(i);
  for (; part_ * sides_a_part < most; ++part_) comm->forward_comm_fix(this);
}

void FixConfined::write_sides(int i)
{
  Particle& p = particle(i);
  double *const row = sent_.data() + static_cast<std::size_t>(row_) * static_cast<std::size_t>(i), *out = row + 1;
  const auto write = [&](const auto&... numbers) { ((*out++ = numbers), ...); };
  std::span<const SideAnswer> answers;
  if (sending_ == Sent::planes && !p.links.empty()) answers = p.law.answers(room_);
  const double unit = force_unit(i), stiffness_unit = unit / atom->radius[i];
  int written = 0;
  for (std::size_t q = 0; q < p.links.size(); ++q) {
    const SideState& side = p.law.sides[q];
    if (side.key < 0 || !(side.touched || side.force > 0)) continue;
    ++written;
    const Vector& n = side.cached_normal;  // the link of a particle that has just come in has none yet
    write(static_cast<double>(side.key), n[0], n[1], n[2]);
    if (sending_ == Sent::planes)
      write(answers[q].force * unit, std::max(answers[q].stiffness, least_stiffness) * stiffness_unit);
    else {
      const Half& half = p.halves[q];
      write(half.force[0], half.force[1], half.force[2], half.turn[0], half.turn[1], half.turn[2], half.arm);
    }
  }
  row[0] = written;
}

const double* FixConfined::sent_side(int i, std::int64_t key, const Vector& normal) const
{
  const double* const row = sent_.data() + static_cast<std::size_t>(row_) * static_cast<std::size_t>(i);
  for (const double* side = row + 1; side < row + 1 + static_cast<int>(row[0]) * columns_; side += columns_)
    if (side[0] == static_cast<double>(key) && side[1] * normal[0] + side[2] * normal[1] + side[3] * normal[2] > 0.3) return side + name_columns;
  return nullptr;
}

int FixConfined::pack_comm(int n, int* list, double* buffer, int, int*)
{
  if (sending_ == Sent::reach) {
    for (int k = 0; k < n; ++k) buffer[2 * k] = grown(list[k]), buffer[2 * k + 1] = pressed_[static_cast<std::size_t>(list[k])];
    return 2;
  }
  const int begin = part_ * sides_a_part * columns_, width = std::min(sides_a_part * columns_, row_ - 1 - begin);
  for (int k = 0; k < n; ++k) {
    const double* const row = sent_.data() + static_cast<std::size_t>(row_) * static_cast<std::size_t>(list[k]);
    *buffer++ = row[0];
    buffer = std::copy_n(row + 1 + begin, width, buffer);
  }
  return 1 + width;
}

void FixConfined::unpack_comm(int n, int first, double* buffer)
{
  if (sending_ == Sent::reach) {
    for (int k = 0; k < n; ++k)
      reach_[static_cast<std::size_t>(first + k)] = buffer[2 * k], pressed_[static_cast<std::size_t>(first + k)] = buffer[2 * k + 1] != 0.0;
    return;
  }
  const int begin = part_ * sides_a_part * columns_, width = std::min(sides_a_part * columns_, row_ - 1 - begin);
  for (int k = first; k < first + n; ++k) {
    double* const row = sent_.data() + static_cast<std::size_t>(row_) * static_cast<std::size_t>(k);
    row[0] = *buffer++;
    std::copy_n(buffer, width, row + 1 + begin);
    buffer += width;
  }
}

int FixConfined::pack_reverse_comm(int n, int first, double* buffer)
{
  std::copy_n(ghost_halves_.data() + comm_reverse * (first - atom->nlocal), comm_reverse * n, buffer);
  return comm_reverse;
}

void FixConfined::unpack_reverse_comm(int n, int* list, double* buffer)
{
  for (int k = 0; k < n; ++k, buffer += comm_reverse) {
    const int i = list[k];
    double *f = atom->f[i], *torque = atom->torque[i];
    if (i >= atom->nlocal) f = ghost_halves_.data() + comm_reverse * (i - atom->nlocal), torque = f + 3;
    for (int c = 0; c < 3; ++c) f[c] += buffer[c], torque[c] += buffer[3 + c];
  }
}

}  // namespace granulaw::plugin
