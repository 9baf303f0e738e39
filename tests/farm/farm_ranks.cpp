// Small batches of runs on whatever it is started on: one process, or the ranks of mpirun. For test_farm.py.
//
//   farm_ranks CASE [--threads T] [--cache DIR] [--output FILE]
//
// Cases: batches    two batches of coarse solver runs, the second after the results of the first; FILE gets all
//                   outcomes, bit for bit, but for the times
//        failing    runs that fail once, always or not at all; prints what becomes of them on rank 0
//        broken     a run on the last rank ends in another exception than Error
//        stop-first, stop-last   the progress of the first or last rank throws
//        stop-late  the progress of the last rank throws when all runs have ended; then another batch
//        without    as a maker of laws that does without a failed pair: what the last rank throws ends all the same
//        alone      the last rank ends with an error of its own before the batch
//        differ     the last rank has other runs to make
//        endless    runs that do not end; prints the process id of each rank
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <thread>

#include "base/error.hpp"
#include "base/state_archive.hpp"
#include "farm_mpi/mpi_farm.hpp"
#include "solver/solver_id.hpp"

namespace {

using namespace granulaw;

struct UserStop
{
};

Particle cheap_sphere()
{
  return Particle::sphere(
      1,
      {.density = 1, .youngs_modulus = 0.91, .poisson_ratio = 0.3, .yield_stress = 1.0 / 30});  // E*/Y = 30
}

/// About 0.05 CPU s.
RunJob impact(double velocity, double cost)
{
  return {fmt::format("impact at {:.3g}", velocity),
          fmt::format("impact velocity={:.17g} solver={}", velocity, solver_id()), cost,
          [velocity](RunOptions options) {
            options.resolution = 8;
            options.shifted_grids = 1;
            return impact(cheap_sphere(), {velocity}, {}, options);
          }};
}

/// Ends by itself or when it is stopped.
RunJob idle(const std::string& key, double seconds, std::function<void(const RunOptions&)> at_end = {})
{
  return {"idle " + key, key, seconds, [seconds, at_end](const RunOptions& options) {
            for (double t = 0; t < seconds; t += 0.01) {
              options.progress(t / seconds);
              std::this_thread::sleep_for(std::chrono::milliseconds(10));
            }
            if (at_end) at_end(options);
            RunResult result;
            result.summary.resolution = static_cast<int>(20 * options.refine);
            return result;
          }};
}

void write_without_times(const std::string& path, const std::vector<std::vector<RunOutcome>>& batches)
{
  StateArchive archive;
  for (const auto& batch : batches)
    for (RunOutcome outcome : batch) {
      outcome.cpu_s = outcome.result.summary.cpu_s = outcome.result.summary.point_updates_per_s = 0;
      visit_state(archive, outcome);
    }
  std::ofstream(path, std::ios::binary) << archive.take();
}

void batches(Farm& farm, const std::string& output)
{
  std::vector<RunJob> first;
  for (int k = 0; k < 8; ++k) first.push_back(impact(0.006 * (1 + k), 1.0 + (3 * k) % 8));
  const auto impacts = farm.run(first);
  // what comes next depends on every bit of every result
  double seed = 0;
  for (const RunOutcome& outcome : impacts) seed = 0.5 * (seed + outcome.result.summary.restitution);
  std::vector<RunJob> second;
  for (int k = 0; k < 5; ++k) second.push_back(impact(0.02 * seed * (1 + 0.3 * k), 1.0));
  write_without_times(output, {impacts, farm.run(second)});
}

void failing(Farm& farm, bool talks)
{
  const auto fails_up_to = [](double refine) {
    return [=](const RunOptions& o) {
      if (o.refine <= refine) throw Error(fmt::format("unstable at {:g}", o.refine));
    };
  };
  const auto outcomes = farm.run({idle("good", 0.05), idle("once", 0.05, fails_up_to(1)),
                                  idle("always", 0.05, fails_up_to(9)), idle("good too", 0.05)});
  if (!talks) return;
  for (const RunOutcome& o : outcomes)
    fmt::print("[{}] [{}] {}\n", o.first_error, o.error, o.result.summary.resolution);
  fmt::print("made {} retried {} failed {}\n", farm.count().made, farm.count().retried, farm.count().failed);
}

int act(const std::string& what, const std::string& output, Farm& farm, int rank, int size)
{
  const bool last = rank == size - 1;
  const std::vector<RunJob> some{idle("a", 0.3), idle("b", 0.3), idle("c", 0.3), idle("d", 0.3)};
  if (what == "batches") {
    batches(farm, output + (rank ? fmt::format(".{}", rank) : ""));
  } else if (what == "failing") {
    failing(farm, rank == 0);
  } else if (what == "broken") {
    const auto break_last = [last](const RunOptions&) {
      if (last) throw std::bad_alloc();
    };
    farm.run({idle("a", 0.2, break_last), idle("b", 0.2, break_last), idle("c", 60), idle("d", 60)});
  } else if (what == "stop-first" || what == "stop-last") {
    const bool stops = what == "stop-first" ? rank == 0 : last;
    farm.run({idle("a", 60), idle("b", 60), idle("c", 60)}, [stops](double, const std::string&) {
      if (stops) throw UserStop{};
    });
  } else if (what == "stop-late") {
    std::atomic<bool> ending = false, ended = false;
    const auto end_late = [&, last](const RunOptions&) {
      if (!last) return;
      ending = true;
      std::this_thread::sleep_for(std::chrono::milliseconds(400));  // longer than from report to report
      ended = true;
    };
    farm.run({idle("a", 0.1, end_late), idle("b", 0.1, end_late), idle("c", 0.1, end_late)}, [&](double, const std::string&) {
      if (!ending) return;
      if (!ended) {  // the next report comes with the last outcome
        while (!ended) std::this_thread::sleep_for(std::chrono::milliseconds(10));
        return;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(200));  // rank 0 has that outcome
      throw UserStop{};
    });
    farm.run(some);
  } else if (what == "without") {
    const auto break_last = [last](const RunOptions&) {
      if (last) throw std::bad_alloc();
    };
    try {
      farm.run({idle("a", 0.2, break_last), idle("b", 0.2, break_last), idle("c", 0.2, break_last)});
    } catch (const Error&) {
    }
    farm.run(some);
  } else if (what == "alone") {
    if (last) fail("the last rank", "has lost its disk");
    farm.run(some);
  } else if (what == "differ") {
    farm.run({idle(last ? "x" : "a", 0.1), idle("b", 0.1)});
  } else if (what == "endless") {
    fmt::print("{}\n", getpid());
    std::fflush(stdout);
    farm.run({idle("a", 3600), idle("b", 3600), idle("c", 3600)});
  } else {
    return 2;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv)
{
  std::map<std::string, std::string> options{{"--threads", "1"}, {"--cache", ""}, {"--output", ""}};
  for (int k = 2; k + 1 < argc; k += 2) options.at(argv[k]) = argv[k + 1];
  const int threads = std::atoi(options["--threads"].c_str());
  std::optional<MpiSession> session;
  std::unique_ptr<Farm> farm;
  if (std::getenv("OMPI_COMM_WORLD_SIZE")) {
    session.emplace();
    farm = std::make_unique<MpiFarm>(*session, threads, RunCache(options["--cache"]));
  } else {
    farm = std::make_unique<ThreadFarm>(threads, RunCache(options["--cache"]));
  }
  const int rank = session ? session->rank() : 0, size = session ? session->size() : 1;
  int code = 1;
  std::string sentence;
  try {
    code = act(argc > 1 ? argv[1] : "", options["--output"], *farm, rank, size);
  } catch (const UserStop&) {
    code = 130, sentence = "stopped by the user";
  } catch (const std::exception& error) {
    sentence = error.what();
  }
  const auto complain = [&] { fmt::print(stderr, "farm_ranks: {}\n", sentence); };
  if (session) return session->finish(code, complain);
  if (code) complain();
  return code;
}
