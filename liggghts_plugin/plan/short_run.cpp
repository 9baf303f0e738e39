#include "liggghts_plugin/plan/short_run.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>

#include "liggghts_plugin/engine/liggghts.hpp"
#include "liggghts_plugin/plan/result_file.hpp"
#include "verlet.h"

namespace granulaw::plugin::plan {

namespace {

struct State
{
  LAMMPS_NS::LAMMPS* lmp = nullptr;
  std::string file;
  std::set<std::string> files_written;
  long long left = 0, done = 0;
  double time = 0;  ///< s, of all runs
  bool is_written = false;
};
State state;

/// LIGGGHTS's own integrator, until the steps are used up.
class ShortRun final : public LAMMPS_NS::Verlet
{
 public:
  explicit ShortRun(LAMMPS_NS::LAMMPS* lmp) : Verlet(lmp, 0, nullptr) {}
  void run(int steps) override
  {
    const int now = static_cast<int>(std::min<long long>(steps, state.left));
    if (now < steps) update->endstep = update->laststep = update->ntimestep + now;
    Verlet::run(now);
    state.left -= now;
    state.done += now;
    state.time += now * update->dt;
    if (now < steps || state.left == 0) {
      write_short_run();
      std::exit(0);
    }
  }
};

}  // namespace

void limit_steps(LAMMPS_NS::LAMMPS* lmp, long long steps, const std::string& file)
{
  if (!state.lmp) state.lmp = lmp, state.file = file, state.left = steps;
  LAMMPS_NS::Update& update = *lmp->update;
  if (dynamic_cast<ShortRun*>(update.integrate) || !dynamic_cast<LAMMPS_NS::Verlet*>(update.integrate)) return;
  delete update.integrate;
  update.integrate = new ShortRun(lmp);
}

void note_file_of_short_run(const char* path, bool is_written)
{
  if (is_written) state.files_written.insert(path);
}

void write_short_run()
{
  if (!state.lmp || state.is_written) return;
  state.is_written = true;
  const LAMMPS_NS::Atom& atom = *state.lmp->atom;
  double sums[2] = {0, 0};  // particles, kinetic energy
  const int count = state.lmp->domain->box_exist && atom.rmass ? atom.nlocal : 0;
  for (int a = 0; a < count; ++a) {
    const double* v = atom.v[a];
    sums[0] += 1;
    sums[1] += 0.5 * atom.rmass[a] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  }
  MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, state.lmp->world);
  if (state.lmp->comm->me != 0) return;
  const nlohmann::json root{
      {"steps", state.done}, {"time", state.time}, {"particles", sums[0]}, {"kinetic_energy", sums[1]}, {"files_written", state.files_written}};
  if (!write_result(state.file, root.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n"))
    std::fprintf(stderr, "ERROR: %s: cannot be written\n", state.file.c_str());
}

}  // namespace granulaw::plugin::plan
