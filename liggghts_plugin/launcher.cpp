// liggghts-mpm: LIGGGHTS with the models `mpm` and `thornton`. The stock main(), linked to the plug-in's
// library. With -plan FILE it reads the deck and runs nothing: see plan/planner.hpp. With -steps N FILE it runs N
// steps of it and writes none of its files: see plan/short_run.hpp.
#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstdio>
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
extern "C" void granulaw_plan_file(const char* path, bool is_written);
extern "C" bool granulaw_plan_end(int status);
extern "C" void granulaw_plan_crash();
extern "C" void granulaw_limit_steps(LAMMPS_NS::LAMMPS* lmp, long long steps, const char* file);
extern "C" void granulaw_short_run_file(const char* path, bool is_written);
extern "C" void granulaw_end_short_run();

namespace {

/// Takes `OPTION VALUE...` out of the words, where it is the first of them: elsewhere it is a value of LIGGGHTS's own
/// options. The values; empty: it is not there.
std::vector<char*> take_option(std::vector<char*>& words, const char* option, std::size_t values)
{
  if (words.size() < values + 2 || std::strcmp(words[1], option) != 0) return {};
  const auto first = words.begin() + 2, end = first + static_cast<std::ptrdiff_t>(values);
  const std::vector<char*> found(first, end);
  words.erase(first - 1, end);
  return found;
}

/// Number of steps; ends the process where the word is none.
long long steps_of(const char* word)
{
  long long steps = 0;
  const char* end = word + std::strlen(word);
  const auto [at, error] = std::from_chars(word, end, steps);
  if (error == std::errc() && at == end && steps >= 0) return steps;
  std::fprintf(stderr, "ERROR: -steps: found %s, allowed is a whole number\n", word);
  MPI_Abort(MPI_COMM_WORLD, 2);
  return 0;
}

/// LIGGGHTS's meshes and others write to a screen that `-screen none` makes a null pointer.
void keep_screen(std::vector<char*>& words)
{
  static char nowhere[] = "/dev/null";
  const auto is = [](const char* word, std::initializer_list<const char*> names) {
    return std::any_of(names.begin(), names.end(), [&](const char* name) { return std::strcmp(word, name) == 0; });
  };
  if (std::any_of(words.begin(), words.end(), [&](const char* word) { return is(word, {"-partition", "-p"}); })) return;
  for (std::size_t k = 1; k + 1 < words.size(); ++k)
    if (is(words[k], {"-screen", "-sc"}) && is(words[k + 1], {"none"})) words[k + 1] = nowhere;
}

void require_one_rank(const char* option)
{
  int ranks = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (ranks == 1) return;
  std::fprintf(stderr, "ERROR: %s needs one rank\n", option);
  MPI_Abort(MPI_COMM_WORLD, 2);
}

/// Open MPI takes its own files away.
void end_mpi()
{
  granulaw::plan::open_files();
  int is_final = 0;
  MPI_Finalized(&is_final);
  if (!is_final) MPI_Finalize();
}

/// However the process ends: with the deck, `quit`, or an error.
void end_plan(int status, void*)
{
  granulaw::plan::open_files();
  const bool ended = granulaw_plan_end(status);
  end_mpi();
  std::fflush(nullptr);
  _exit(ended ? 0 : 1);
}

void end_by_signal(int)
{
  granulaw_plan_crash();
}

/// A crash leaves the command that was executed. The signal comes again, and ends the process.
void follow_crashes()
{
  static char stack[65536];  // that of the process may be full
  stack_t own{};
  own.ss_sp = stack;
  own.ss_size = sizeof stack;
  sigaltstack(&own, nullptr);
  struct sigaction crash{};
  crash.sa_handler = &end_by_signal;
  crash.sa_flags = static_cast<int>(SA_ONSTACK | SA_RESETHAND);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) sigaction(signal, &crash, nullptr);
}

void plan(std::vector<char*> words, const char* file)
{
  require_one_rank("-plan");
  static char log[] = "-log", none[] = "none";
  words.insert(words.end(), {log, none});
  granulaw::plan::close_files();
  static LAMMPS_NS::LAMMPS* lammps = nullptr;
  lammps = new LAMMPS_NS::LAMMPS(static_cast<int>(words.size()), words.data(), MPI_COMM_WORLD);
  granulaw_plan(lammps, file);
  on_exit(&end_plan, nullptr);
  follow_crashes();
  const auto is_deck = [](std::FILE* stream) { return stream == lammps->infile; };
  granulaw::plan::follow_lines(is_deck, &granulaw_plan_line);
  granulaw::plan::read_on_one_rank(is_deck);
  granulaw::plan::follow_files(&granulaw_plan_file);
  lammps->input->file();
  std::exit(0);
}

/// Settings of Open MPI where no launcher of ranks is at work. Its search for a network takes 0.3 s, its daemon 0.4 s; and
/// processes that begin and end at one moment take the folder from each other that they share and do not need.
void settle_for_one_process()
{
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  for (const char* rank : {"PMIX_RANK", "PMI_RANK", "OMPI_COMM_WORLD_RANK", "SLURM_PROCID", "ALPS_APP_PE"})
    if (std::getenv(rank)) return;
  setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
  setenv("OMPI_MCA_pml", "ob1", 0);
  setenv("OMPI_MCA_btl", "self", 0);
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

  settle_for_one_process();
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // a file has all lines, however the process ends
  MPI_Init(&argc, &argv);
  std::vector<char*> words(argv, argv + argc);
  keep_screen(words);
  if (const auto file = take_option(words, "-plan", 1); !file.empty()) plan(words, file[0]);
  const auto limit = take_option(words, "-steps", 2);
  if (!limit.empty()) require_one_rank("-steps"), granulaw::plan::close_files();
  auto* lammps = new LAMMPS_NS::LAMMPS(static_cast<int>(words.size()), words.data(), MPI_COMM_WORLD);
  granulaw_provide_contact_histories(lammps);
  if (!limit.empty()) {
    std::atexit(&end_mpi);
    const auto is_deck = [=](std::FILE* stream) { return stream == lammps->infile; };
    granulaw::plan::read_on_one_rank(is_deck);
    granulaw::plan::follow_files(&granulaw_short_run_file);
    granulaw::plan::follow_reads([=, steps = steps_of(limit[0])](std::FILE* stream) {
      if (is_deck(stream)) granulaw_limit_steps(lammps, steps, limit[1]);
    });
  }
  lammps->input->file();
  granulaw_end_short_run();
  delete lammps;
  MPI_Finalize();
  return 0;
}
