#include "liggghts_plugin/fix_stats.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>

#include "base/error.hpp"
#include "base/version.hpp"

namespace granulaw::plugin {

namespace {

constexpr const char* style_name = "granulaw/stats";

// Modify::fix_map is private, and LIGGGHTS has no call that adds a fix style. An explicit instantiation may
// name private members ([temp.spec]), so it can hand out the pointer to member.
template <class Tag, auto member>
struct Expose
{
  friend auto exposed(Tag) { return member; }
};
struct FixMapTag
{
  friend auto exposed(FixMapTag);
};
template struct Expose<FixMapTag, &LAMMPS_NS::Modify::fix_map>;

LAMMPS_NS::Fix* make_fix(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg)
{
  return new FixStats(lmp, narg, arg);
}

void reduce(ContactLedger::Side& side, MPI_Comm world)
{
  double sums[] = {side.dissipated, side.touches, side.ended, side.beyond, side.too_fast};
  double largest[] = {side.speed_max, side.overlap_max, side.inertia_max};
  MPI_Allreduce(MPI_IN_PLACE, sums, 5, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(MPI_IN_PLACE, largest, 3, MPI_DOUBLE, MPI_MAX, world);
  MPI_Allreduce(MPI_IN_PLACE, side.speed.count.data(), LogHistogram::bins, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(MPI_IN_PLACE, side.overlap.count.data(), LogHistogram::bins, MPI_DOUBLE, MPI_SUM, world);
  side.dissipated = sums[0], side.touches = sums[1], side.ended = sums[2], side.beyond = sums[3];
  side.too_fast = sums[4];
  side.speed_max = largest[0], side.overlap_max = largest[1], side.inertia_max = largest[2];
}

}  // namespace

void provide_stats_fix(LAMMPS_NS::LAMMPS* lmp, bool add)
{
  auto& styles = *(lmp->modify->*exposed(FixMapTag{}));
  styles.emplace(style_name, &make_fix);
  if (!add || !lmp->domain->box_exist || lmp->modify->find_fix_style_strict(style_name, 0)) return;
  const char* arg[] = {"granulaw", "all", style_name};
  lmp->modify->add_fix(3, const_cast<char**>(arg));
}

FixStats::FixStats(LAMMPS_NS::LAMMPS* lmp_, int narg, char** arg)
    : Fix(lmp_, narg, arg), session_(Session::of(lmp_))
{
  scalar_flag = vector_flag = 1;
  size_vector = vector_length;
  global_freq = 1;
  extscalar = extvector = 0;  // totals, never to be divided by the number of particles
  for (int i = 3; i < narg; i += 2) {
    if (std::strcmp(arg[i], "file") != 0 || i + 1 >= narg)
      stop_all(lmp, fmt::format("fix {} granulaw/stats: found '{}', allowed is: file FILE", id, arg[i]));
    path_ = arg[i + 1];
  }
}

ContactLedger FixStats::total() const
{
  ContactLedger sum = session_->ledger;
  reduce(sum.pair, world);
  reduce(sum.wall, world);
  return sum;
}

double FixStats::compute_scalar()
{
  const double own = session_->ledger.pair.dissipated + session_->ledger.wall.dissipated;
  double sum = 0;
  MPI_Allreduce(&own, &sum, 1, MPI_DOUBLE, MPI_SUM, world);
  return sum;
}

double FixStats::compute_vector(int n)
{
  const ContactLedger::Side &p = session_->ledger.pair, &w = session_->ledger.wall;
  const double own[vector_length] = {p.dissipated,
                                     w.dissipated,
                                     p.touches,
                                     w.touches,
                                     p.speed_max,
                                     w.speed_max,
                                     p.overlap_max,
                                     w.overlap_max,
                                     p.beyond + w.beyond,
                                     std::max(p.inertia_max, w.inertia_max),
                                     p.too_fast + w.too_fast};
  const bool is_sum = n < 4 || n == 8 || n == 10;
  double result = 0;
  MPI_Allreduce(&own[n], &result, 1, MPI_DOUBLE, is_sum ? MPI_SUM : MPI_MAX, world);
  return result;
}

void FixStats::post_run()
{
  const ContactLedger sum = total();
  if (comm->me != 0) return;
  std::string line = fmt::format(
      "granulaw: {:.0f} contacts between particles, {:.0f} with walls; impacts up to {:.4g} and {:.4g} m/s; "
      "overlap/R* "
      "up to {:.4g} and {:.4g}; normal contacts dissipated {:.6g} J",
      sum.pair.touches, sum.wall.touches, sum.pair.speed_max, sum.wall.speed_max, sum.pair.overlap_max,
      sum.wall.overlap_max, sum.pair.dissipated + sum.wall.dissipated);
  if (const double beyond = sum.pair.beyond + sum.wall.beyond; beyond > 0)
    line += fmt::format("; {:.0f} contact-steps beyond the law's table", beyond);
  if (const double too_fast = sum.pair.too_fast + sum.wall.too_fast; too_fast > 0)
    line += fmt::format("; {:.0f} contacts began faster than the law's inertia axis goes", too_fast);
  const double inertia = std::max(sum.pair.inertia_max, sum.wall.inertia_max);
  if (session_->inertia_limit > 0 && inertia > session_->inertia_limit)
    line += fmt::format(
        "; impacts up to I = rho V^2/Y = {:.3g}, the law holds to {:.3g}: above that it overstates "
        "restitution",
        inertia, session_->inertia_limit);
  for (FILE* out : {screen, logfile})
    if (out) std::fprintf(out, "%s\n", line.c_str());
  if (!path_.empty()) write_json(sum, path_);
  if (session_->pair_options && !session_->pair_options->stats_path.empty())
    write_json(sum, session_->pair_options->stats_path);
}

void FixStats::write_json(const ContactLedger& sum, const std::string& path) const
{
  const std::string header = fmt::format(
      "  \"granulaw_version\": \"{}\",\n  \"git_hash\": \"{}\",\n  \"step\": {},\n  \"time_s\": {:.10g},\n"
      "  \"ranks\": {},\n  \"inertia_number_limit_of_law\": {:.6g},\n",
      version(), git_hash(), update->ntimestep, update->get_cur_time(), comm->nprocs,
      session_->inertia_limit);
  const std::string text = to_json(sum, header), temporary = fmt::format("{}.tmp.{}", path, getpid());
  FILE* file = std::fopen(temporary.c_str(), "w");
  const bool written = file && std::fwrite(text.data(), 1, text.size(), file) == text.size();
  const bool closed = file && std::fclose(file) == 0;
  if (!written || !closed || std::rename(temporary.c_str(), path.c_str()) != 0) {
    std::remove(temporary.c_str());
    error->warning(FLERR, fmt::format("fix {} granulaw/stats: cannot write '{}'", id, path).c_str());
  }
}

}  // namespace granulaw::plugin
