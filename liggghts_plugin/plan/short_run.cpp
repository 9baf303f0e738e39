#include "liggghts_plugin/plan/short_run.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>

#include "liggghts_plugin/engine/liggghts.hpp"
#include "verlet.h"

namespace granulaw::plugin::plan {

namespace {

struct State
{
  LAMMPS_NS::LAMMPS* lmp = nullptr;
  std::string file;
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
  if (!state.lmp) state = {.lmp = lmp, .file = file, .left = steps};
  LAMMPS_NS::Update& update = *lmp->update;
  if (dynamic_cast<ShortRun*>(update.integrate) || !dynamic_cast<LAMMPS_NS::Verlet*>(update.integrate)) return;
  delete update.integrate;
  update.integrate = new ShortRun(lmp);
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
  const nlohmann::json root{{"steps", state.done}, {"time", state.time}, {"particles", sums[0]}, {"kinetic_energy", sums[1]}};
  if (std::FILE* out = std::fopen(state.file.c_str(), "w")) {
    std::fputs((root.dump(1) + "\n").c_str(), out);
    std::fclose(out);
  }
}

}  // namespace granulaw::plugin::plan
