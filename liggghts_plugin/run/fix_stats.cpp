#include "liggghts_plugin/run/fix_stats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "base/version.hpp"
#include "law/law_file.hpp"
#include "liggghts_plugin/books/rank_sums.hpp"
#include "liggghts_plugin/books/restart_record.hpp"
#include "liggghts_plugin/books/stats_json.hpp"
#include "liggghts_plugin/books/stats_text.hpp"
#include "liggghts_plugin/engine/fix_style.hpp"

namespace granulaw::plugin {

namespace {

constexpr const char* style_name = "granulaw/stats";

}  // namespace

void provide_stats_fix(LAMMPS_NS::LAMMPS* lmp)
{
  if (lmp->domain->box_exist) {
    const std::shared_ptr<Session> session = Session::of(lmp);
    EnergyTally::provide(lmp, session->energy != nullptr, session->dissipated_energy);
    if (session->crushes) ParticleColumns::provide(lmp, crushed_particles);
  }
  provide_fix<FixStats>(lmp, "granulaw", style_name);
}

FixStats::FixStats(LAMMPS_NS::LAMMPS* lmp_, int narg, char** arg)
    : Fix(lmp_, narg, arg), session_(Session::of(lmp_))
{
  scalar_flag = vector_flag = array_flag = 1;
  size_vector = vector_length;
  size_array_rows = rows_of_types(atom->ntypes);
  size_array_cols = array_columns;
  global_freq = 1;
  extscalar = extvector = extarray = 0;  // totals, never to be divided by the number of particles
  restart_global = 1;
  if (session_->energy) {
    peratom_flag = 1;
    size_peratom_cols = EnergyTally::columns;
    peratom_freq = 1;
    atom->add_callback(0);
    grow_arrays(atom->nmax);
  }
  read_keywords(narg, arg);
}

FixStats::~FixStats()
{
  if (!peratom_flag) return;
  atom->delete_callback(id, 0);
  memory->destroy(kept_energies_);
}

void FixStats::grow_arrays(int nmax)
{
  memory->grow(kept_energies_, nmax, EnergyTally::columns, "granulaw/stats:energies");
  in_run_ ? find_energies() : keep_energies();
}

void FixStats::copy_arrays(int from, int to, int)
{
  std::copy_n(kept_energies_[from], EnergyTally::columns, kept_energies_[to]);
}

void FixStats::find_energies()
{
  EnergyTally& tally = session_->tally;
  tally.find(lmp, session_->dissipated_energy);
  array_atom = tally.per_atom ? tally.per_atom.rows() : kept_energies_;
}

void FixStats::keep_energies()
{
  const ParticleColumns now = ParticleColumns::find(lmp, EnergyTally::energies);
  for (int a = 0; a < atom->nlocal; ++a)
    for (int column = 0; column < EnergyTally::columns; ++column)
      kept_energies_[a][column] = now ? now.rows()[a][column] : 0.0;
  array_atom = kept_energies_;
}

void FixStats::read_keywords(int narg, char** arg)
{
  nevery = 1;
  for (int i = 3; i < narg; i += 2) {
    const std::string key = arg[i], value = i + 1 < narg ? arg[i + 1] : "";
    if ((key != "file" && key != "every") || value.empty())
      stop_all(lmp,
               fmt::format("fix {} granulaw/stats: found '{}', allowed is: file FILE, every N", id, key));
    if (key == "file") path_ = value;
    if (key == "every") {
      char* end = nullptr;
      const long steps = std::strtol(value.c_str(), &end, 10);
      if (*end != '\0' || steps < 1 || steps > std::numeric_limits<int>::max())
        stop_all(lmp,
                 fmt::format("fix {} granulaw/stats: 'every' needs a number of steps, 1 or more, found '{}'",
                             id, value));
      every_ = static_cast<int>(steps);
    }
  }
  if (every_ && path_.empty())
    stop_all(lmp, fmt::format("fix {} granulaw/stats: 'every N' needs 'file FILE' to write to", id));
}

int FixStats::setmask()
{
  using namespace LAMMPS_NS::FixConst;
  return PRE_EXCHANGE | PRE_FORCE | END_OF_STEP;
}

bool FixStats::speaks() const
{
  return modify->find_fix_style_strict(style_name, 0) == this;
}

DeckUnits FixStats::deck_units() const
{
  return DeckUnits::of(update->unit_style, style_name);
}

void FixStats::print(const std::string& text) const
{
  if (comm->me != 0) return;
  for (FILE* out : {screen, logfile})
    if (out) std::fprintf(out, "%s", text.c_str());
}

void FixStats::warn(const std::string& what, const std::string& text) const
{
  if (session_->first_time(what) && comm->me == 0) error->warning(FLERR, text.c_str());
}

void FixStats::warn_of_clumps() const
{
  int overlap = Bodies::overlap_themselves(lmp) ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &overlap, 1, MPI_INT, MPI_MAX, world);
  if (overlap)
    warn("overlapping clumps",
         "granulaw: spheres of a clump overlap each other; where a partner touches two of them both answer, "
         "and the "
         "contact is up to twice as stiff as the law's");
}

void FixStats::warn_of_lost_contacts() const
{
  for (const auto& [name, meaning] : session_->restarted) {
    const bool is_pair = name == pairs_record;
    const std::string command = is_pair ? "pair_style gran" : fmt::format("{} wall/gran", name.starts_with("fix ") ? name : "fix " + name);
    warn("restarted " + name,
         fmt::format(
             "granulaw: the restart file holds contacts of {} ({}), which this deck has not: their dents are "
             "lost{}",
             command, describe(meaning), is_pair ? "" : "; give the walls their old ids"));
  }
}

void FixStats::warn_of_long_steps() const
{
  const double dt = update->dt;
  if (!speaks()) return;
  double frequency2 = 0;
  const PairKey* stiffest = nullptr;
  for (const auto& [key, counts] : session_->statistics.pairs)
    if (counts.run_frequency2 > frequency2) frequency2 = counts.run_frequency2, stiffest = &key;
  struct
  {
    double value;
    int rank;
  } largest{frequency2, comm->me};
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE_INT, MPI_MAXLOC, world);
  const double allowed = largest_step(1.0, largest.value);
  if (dt <= allowed || !session_->first_time(fmt::format("time step {:g}", dt))) return;
  int types[3] = {};
  if (stiffest && comm->me == largest.rank)
    types[0] = stiffest->kind, types[1] = stiffest->i, types[2] = stiffest->j;
  MPI_Bcast(types, 3, MPI_INT, largest.rank, world);
  if (comm->me != 0) return;
  error->warning(FLERR,
                 fmt::format("granulaw: by step {} a contact of type {} with {} {} was so deep that its time step "
                             "is {:.4g} s, 1/{:.0f} of its period: the deck's {:.4g} s is longer",
                             update->ntimestep, types[1],
                             types[0] == PairKey::particles ? "type" : "a wall of type", types[2], allowed,
                             1.0 / step_fraction, dt)
                     .c_str());
}

void FixStats::warn_of_step_check() const
{
  for (int f = 0; f < modify->nfix; ++f)
    if (std::strcmp(modify->fix[f]->style, "check/timestep/gran") == 0)
      warn("step check",
           fmt::format("granulaw: fix {} check/timestep/gran takes Hertz's contact time of the deck's moduli, not that of "
                       "the law{}; the law's largest time step is in the table below and, after a run, in f_granulaw[13]",
                       modify->fix[f]->id,
                       session_->pair_options && session_->pair_options->stretch.value_or(1.0) > 1.0
                           ? " and its stretch"
                           : ""));
}

void FixStats::warn_of_sizes() const
{
  if (comm->me != 0) return;
  for (const auto& [key, counts] : session_->statistics.pairs) {
    const PairStatement& stated = counts.info.stated;
    if (!counts.info.needed || stated.covers_size()) continue;
    error->warning(
        FLERR,
        fmt::format(
            "granulaw: R_i/(R_i + R_j) of types {} and {}{} is up to {:.3g} off the nearest law of the "
            "pair: the error bound is larger by that ({}); mpm table --radius-ratio makes laws for "
            "more ratios",
            key.i, key.kind == PairKey::particles ? "" : "a wall of type ", key.j, stated.size_off,
            stated.bound.text())
            .c_str());
  }
}

void FixStats::warn_of_laws_without_checksum() const
{
  const LoadedLaw* law = session_->pair_law.get();
  if (law && !law->law.provenance.contains(checksum_note))
    warn("no checksum " + law->path,
         fmt::format(
             "granulaw: {} has no checksum, so damage to it may pass unseen; a newer `mpm table` writes one",
             law->path));
}

void FixStats::warn_of_laws_without_radii() const
{
  const LoadedLaw* law = session_->pair_law.get();
  const std::optional<Options>& options = session_->pair_options;
  const bool used = options && (options->heat_by_law.value_or(false) || options->tangential_computed.value_or(false));
  if (law && used && !law->law.states_unloading_radius())
    warn("no radii " + law->path,
         fmt::format("granulaw: {} is older than contact radii of unloading: below the largest overlap a = a_m sqrt(u) stands "
                     "in for them, up to a third too small; a newer `mpm table` writes them",
                     law->path));
}

void FixStats::check_files() const
{
  std::string message;
  if (comm->me == 0) try {
      const std::string where = fmt::format("fix {} granulaw/stats", id);
      if (is_planning) return;
      if (!path_.empty()) require_writable(path_, where + ": file");
      if (speaks() && session_->pair_options && !session_->pair_options->stats_path.empty())
        require_writable(session_->pair_options->stats_path, "pair_style gran: stats");
    } catch (const std::exception& error) {
      message = error.what();
    }
  int length = static_cast<int>(message.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, world);
  if (length == 0) return;
  message.resize(static_cast<std::size_t>(length));
  MPI_Bcast(message.data(), length, MPI_CHAR, 0, world);
  stop_all(lmp, message);
}

double FixStats::crowded_particles() const
{
  std::vector<int> deep(static_cast<std::size_t>(atom->nlocal), 0);
  for (const auto& [wall, style] : session_->styles)
    style->each_open([&, inquiry = style->contacts()](const OpenContact& open) {
      const auto counts = session_->statistics.pairs.find(open.key);
      if (counts == session_->statistics.pairs.end() || !std::isfinite(counts->second.info.deep_overlap))
        return;
      const double limit = counts->second.info.deep_overlap * open.place.r_eff();
      if (!(inquiry->state(open.place).largest_overlap > limit)) return;
      for (const int k : {open.i, open.j})
        if (k >= 0 && k < atom->nlocal) ++deep[static_cast<std::size_t>(k)];
    });
  double several = static_cast<double>(std::count_if(deep.begin(), deep.end(), [](int n) { return n > 1; }));
  MPI_Allreduce(MPI_IN_PLACE, &several, 1, MPI_DOUBLE, MPI_SUM, world);
  return several;
}

DeepContacts FixStats::deep_contacts(const ContactStatistics& sum) const
{
  DeepContacts found;
  found.particles = crowded_;
  for (const auto& [key, counts] : sum.pairs) {
    found.contacts += counts.deep();
    if (counts.overlap_max > counts.info.deep_overlap) found.contacts = std::max(found.contacts, 1.0);
  }
  return found;
}

void FixStats::setup(int)
{
  largest_dt_ = std::max(largest_dt_, update->dt);
  check_files();
  if (writes_stats()) add_energies();
  if (!speaks()) return;
  warn_of_clumps();
  warn_of_lost_contacts();
  warn_of_step_check();
  std::string table = start_table(session_->statistics, deck_units());
  if (table == last_table_) return;  // the laws and the smallest particles are those of the run before
  last_table_ = table;
  print(table);
  warn_of_sizes();
  warn_of_laws_without_checksum();
  warn_of_laws_without_radii();
}

void FixStats::setup_pre_force(int)
{
  if (speaks())
    for (auto& [key, counts] : session_->statistics.pairs) counts.hardest = counts.run_frequency2 = 0;
  pre_force(0);
}

void FixStats::pre_force(int)
{
  step_of_rows_ = -1;
  settled_ = false;
  in_run_ = true;
  if (session_->energy) find_energies();
}

void FixStats::settle()
{
  if (std::exchange(settled_, true)) return;
  for (const auto& [wall, style] : session_->styles) style->settle_open();
}

ContactStatistics FixStats::sum_of_ranks(bool with_open)
{
  settle();
  ContactStatistics sum = session_->statistics;
  if (!with_open)
    for (const auto& [wall, style] : session_->styles) style->take_out_open(sum);
  for (auto& [key, counts] : sum.pairs) reduce(counts, world);
  if (!with_open) sum.count_ended();
  return sum;
}

ContactStatistics FixStats::total()
{
  return sum_of_ranks(false);
}

double FixStats::stored_energy() const
{
  if (!session_->energy) return 0.0;
  const ParticleColumns now = ParticleColumns::find(lmp, EnergyTally::energies);
  double sum = 0.0;
  for (int a = 0; now && a < atom->nlocal; ++a) sum += now.rows()[a][EnergyTally::stored];
  return sum;
}

bool FixStats::writes_stats() const
{
  return !path_.empty() ||
         (speaks() && session_->pair_options && !session_->pair_options->stats_path.empty());
}

void FixStats::add_energies()
{
  settle();
  EnergySeries::Row row{};
  double fastest2 = 0;
  for (int a = 0; a < atom->nlocal; ++a) {
    const double *v = atom->v[a], *omega = atom->omega ? atom->omega[a] : nullptr;
    const double v2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    row[EnergySeries::particles] += 1;
    row[EnergySeries::kinetic] += 0.5 * atom->rmass[a] * v2;
    if (omega && atom->radius)
      row[EnergySeries::rotational] += 0.2 * atom->rmass[a] * atom->radius[a] * atom->radius[a] *
                                       (omega[0] * omega[0] + omega[1] * omega[1] + omega[2] * omega[2]);
    fastest2 = std::max(fastest2, v2);
  }
  const ContactStatistics::Pair counts = session_->statistics.total();
  std::ranges::copy(counts.taken.taken, row.begin() + EnergySeries::taken);
  row[EnergySeries::elastic] = stored_energy();
  row[EnergySeries::other_work] = counts.other_work;
  MPI_Allreduce(MPI_IN_PLACE, row.data(), EnergySeries::columns, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(MPI_IN_PLACE, &fastest2, 1, MPI_DOUBLE, MPI_MAX, world);
  row[EnergySeries::time] = update->get_cur_time();
  row[EnergySeries::fastest] = std::sqrt(fastest2);
  energies_.add(update->ntimestep, row);
}

double FixStats::compute_scalar()
{
  settle();
  const double own = session_->statistics.total().taken[Mechanism::plastic];
  double sum = 0;
  MPI_Allreduce(&own, &sum, 1, MPI_DOUBLE, MPI_SUM, world);
  return sum;
}

double FixStats::compute_vector(int n)
{
  settle();
  const auto found = std::find_if(quantities.begin(), quantities.end(), [n](const Quantity& q) {
    return q.vector >= 0 && n >= q.vector && n <= q.vector + static_cast<int>(q.split);
  });
  const bool is_count = found != quantities.end();  // else the energy held
  double own = 0, result = 0;
  if (!is_count)
    own = stored_energy();
  else {
    const ContactStatistics& all = session_->statistics;
    const ContactStatistics::Pair counts = found->split ? all.total(n > found->vector) : all.total();
    own = found->value.of(counts);
  }
  MPI_Allreduce(&own, &result, 1, MPI_DOUBLE, is_count ? operation(found->combine) : MPI_SUM, world);
  if (n == time_step_place) return result > 0 ? largest_step(1.0, result) : 0.0;
  return result;
}

double FixStats::compute_array(int row, int column)
{
  if (step_of_rows_ != update->ntimestep) {
    rows_ = total();
    step_of_rows_ = update->ntimestep;
  }
  ContactStatistics::Pair counts;  // walls of both kinds together
  for (const auto& [key, counted] : rows_.pairs)
    if (row_of_types(key, atom->ntypes) == row) counts.merge(counted);
  for (const Quantity& q : quantities)
    if (q.column == column) return q.value.of(counts);
  return 0.0;
}

void FixStats::end_of_step()
{
  largest_dt_ = std::max(largest_dt_, update->dt);
  if (energies_.due(update->ntimestep) && writes_stats()) add_energies();
  if (!every_ || update->ntimestep % every_ != 0) return;
  crowded_ = std::max(crowded_, crowded_particles());
  const DeepContacts deep = deep_contacts(sum_of_ranks(true));
  const ContactStatistics sum = total();
  if (comm->me == 0) write_files(sum, deep);
}

void FixStats::post_run()
{
  in_run_ = false;
  if (peratom_flag) keep_energies();
  largest_dt_ = std::max(largest_dt_, update->dt);
  warn_of_long_steps();
  if (writes_stats()) add_energies();
  crowded_ = std::max(crowded_, crowded_particles());
  const DeepContacts deep = deep_contacts(sum_of_ranks(true));
  const ContactStatistics sum = total();
  if (comm->me != 0) return;
  write_files(sum, deep);
  if (!speaks()) return;
  print(end_table(sum, deck_units(), deep, largest_dt_));
  if (deep.contacts > 0)
    warn("deep contacts",
         "granulaw: contacts left what a law of one contact covers (a tenth of the radius): read the table "
         "above");
}

void FixStats::write_files(const ContactStatistics& sum, const DeepContacts& deep) const
{
  if (!path_.empty()) write_json(sum, deep, path_);
  if (speaks() && session_->pair_options && !session_->pair_options->stats_path.empty())
    write_json(sum, deep, session_->pair_options->stats_path);
}

void FixStats::write_at_stop(const std::string& message)
{
  if (is_planning || !writes_stats()) return;
  stopped_ = message;
  settled_ = false;  // the step has begun again
  settle();
  ContactStatistics own = session_->statistics;
  const DeepContacts deep = deep_contacts(own);
  for (const auto& [wall, style] : session_->styles) style->take_out_open(own);
  own.count_ended();
  write_files(own, deep);
}

void write_stats_at_stop(LAMMPS_NS::LAMMPS* lmp, const std::string& message)
{
  for (int f = 0; f < lmp->modify->nfix; ++f)
    if (auto* stats = dynamic_cast<FixStats*>(lmp->modify->fix[f])) stats->write_at_stop(message);
}

// Restart files keep the sums of all ranks: rank 0 takes them up again, the others start at zero.
void FixStats::write_restart(FILE* file)
{
  // with the open contacts, which go on after the restart
  const std::vector<double> values = RestartRecord{sum_of_ranks(true).pack(), session_->meanings}.numbers();
  if (comm->me != 0) return;
  const int size = static_cast<int>(values.size() * sizeof(double));
  std::fwrite(&size, sizeof(int), 1, file);
  std::fwrite(values.data(), sizeof(double), values.size(), file);
}

void FixStats::restart(char* buffer)
{
  const std::optional<RestartRecord> record = RestartRecord::from(buffer);
  if (!record)
    stop_all(lmp, fmt::format("fix {} granulaw/stats: its record in the restart file is damaged, or of another version "
                              "of the plug-in",
                              id));
  for (const auto& [command, meaning] : record->meanings) session_->restarted[command] = meaning;
  if (!session_->statistics.unpack(record->counts.data(), record->counts.size(), comm->me == 0) &&
      comm->me == 0)
    error->warning(FLERR, fmt::format("fix {} granulaw/stats: the restart file holds the counts of another "
                                      "version of the plug-in: they begin at zero",
                                      id)
                              .c_str());
}

void FixStats::write_json(const ContactStatistics& sum, const DeepContacts& deep,
                          const std::string& path) const
{
  const nlohmann::ordered_json limit = json_number(sum.damage_number_limit(), 6);
  nlohmann::ordered_json file{{"granulaw_version", version()},
                              {"git_hash", git_hash()},
                              {"step", update->ntimestep},
                              {"time_s", json_number(update->get_cur_time())},
                              {"ranks", comm->nprocs},
                              {"time_step_used_s", json_number(largest_dt_)},
                              {"damage_number_limit_of_law", limit},
                              {"inertia_number_limit_of_law", limit},
                              {"contacts_over_a_tenth_of_radius", json_number(deep.contacts)},
                              {"particles_with_several_of_them", json_number(deep.particles)}};
  if (!stopped_.empty()) file.update({{"stopped", stopped_}, {"ranks_in_this_file", 1}});
  file["series"] = energies_.json(deck_units(), session_->energy != nullptr);
  file.update(to_json(sum, deck_units()));
  try {
    write_text_atomically(path, text_of(file));
  } catch (const Error&) {
    error->warning(FLERR, fmt::format("fix {} granulaw/stats: cannot write '{}'", id, path).c_str());
  }
}

}  // namespace granulaw::plugin
