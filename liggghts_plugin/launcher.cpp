// liggghts-mpm: LIGGGHTS with the models `mpm` and `thornton`. The stock main(), linked to the plug-in's
// library. With -plan FILE it reads the deck and runs nothing: see plan/planner.hpp.
#include <mpi.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "input.h"
#include "lammps.h"
#include "liggghts_plugin/plan/deck_files.hpp"
#include "signal_handling.h"

/// contact_history.hpp, of the plug-in's library
extern "C" void granulaw_provide_contact_histories(LAMMPS_NS::LAMMPS* lmp);

/// plan/entry.cpp, of the same
extern "C" void granulaw_plan(LAMMPS_NS::LAMMPS* lmp, const char* file);
extern "C" void granulaw_plan_line(const char* where, const char* text);
extern "C" bool granulaw_plan_end(int status);

namespace {

/// Takes `-plan FILE` out of the words; null: it is not among them.
const char* take_plan(std::vector<char*>& words)
{
  for (std::size_t k = 1; k + 1 < words.size(); ++k)
    if (std::strcmp(words[k], "-plan") == 0) {
      const char* file = words[k + 1];
      words.erase(words.begin() + static_cast<std::ptrdiff_t>(k),
                  words.begin() + static_cast<std::ptrdiff_t>(k) + 2);
      return file;
    }
  return nullptr;
}

void require_one_rank()
{
  int ranks = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (ranks == 1) return;
  std::fputs("ERROR: -plan needs one rank\n", stderr);
  MPI_Abort(MPI_COMM_WORLD, 2);
}

/// However the process ends: with the deck, `quit`, or an error.
void end_plan(int status, void*)
{
  granulaw::plan::open_files();
  const bool ended = granulaw_plan_end(status);
  int is_final = 0;
  MPI_Finalized(&is_final);
  if (!is_final) MPI_Finalize();
  std::fflush(nullptr);
  _exit(ended ? 0 : 1);
}

void plan(std::vector<char*> words, const char* file)
{
  require_one_rank();
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  static char log[] = "-log", none[] = "none";
  words.insert(words.end(), {log, none});
  granulaw::plan::close_files();
  static LAMMPS_NS::LAMMPS* lammps = nullptr;
  lammps = new LAMMPS_NS::LAMMPS(static_cast<int>(words.size()), words.data(), MPI_COMM_WORLD);
  granulaw_plan(lammps, file);
  on_exit(&end_plan, nullptr);
  granulaw::plan::follow_lines([](std::FILE* stream) { return stream == lammps->infile; },
                               &granulaw_plan_line);
  lammps->input->file();
  std::exit(0);
}

}  // namespace

int main(int argc, char** argv)
{
  struct sigaction on_interrupt, on_user;
  std::memset(&on_interrupt, 0, sizeof on_interrupt);
  std::memset(&on_user, 0, sizeof on_user);
  on_interrupt.sa_handler = LAMMPS_NS::SignalHandler::int_handler;
  on_user.sa_handler = LAMMPS_NS::SignalHandler::usr1_handler;
  sigaction(SIGINT, &on_interrupt, nullptr);
  sigaction(SIGTERM, &on_interrupt, nullptr);  // mpirun turns an interrupt into SIGTERM for its children
  sigaction(SIGUSR1, &on_user, nullptr);

  // Else Open MPI starts a daemon where there is no mpirun, which takes 0.4 s.
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  MPI_Init(&argc, &argv);
  std::vector<char*> words(argv, argv + argc);
  if (const char* file = take_plan(words)) plan(words, file);
  auto* lammps = new LAMMPS_NS::LAMMPS(argc, argv, MPI_COMM_WORLD);
  granulaw_provide_contact_histories(lammps);
  lammps->input->file();
  delete lammps;
  MPI_Finalize();
  return 0;
}
