#include "farm_mpi/mpi_farm.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <optional>
#include <thread>

#include "base/error.hpp"
#include "farm/worker_pool.hpp"
#include "base/state_archive.hpp"

namespace granulaw {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto look_every = std::chrono::milliseconds(2);
constexpr auto report_every = std::chrono::milliseconds(100);
/// Time for the runs under way to notice that they shall stop, before the rest goes on without them.
constexpr auto stop_patience = std::chrono::seconds(30);

/// Kind of a message, its MPI tag.
enum Kind : int {
  // from rank 0
  job,   ///< index: make this run
  end,   ///< the batch is done: outcomes follow (broadcast)
  stop,  ///< sentence: give up
  // to rank 0
  ended,    ///< index, outcome
  running,  ///< index, share done
  trouble,  ///< sentence: this rank has to stop
  stopped   ///< nothing more will come of this batch
};

struct Message
{
  int from;
  Kind kind;
  StateArchive content;
};

void send(int to, Kind kind, StateArchive content = {})
{
  const std::string bytes = content.take();
  MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, to, kind, MPI_COMM_WORLD);
}

/// The next message that has arrived, if any.
std::optional<Message> receive()
{
  int arrived = 0, size = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &arrived, &status);
  if (!arrived) return {};
  MPI_Get_count(&status, MPI_BYTE, &size);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  MPI_Recv(bytes.data(), size, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD,
           MPI_STATUS_IGNORE);
  return Message{status.MPI_SOURCE, static_cast<Kind>(status.MPI_TAG), StateArchive(std::move(bytes), "MPI")};
}

template <class... T>
StateArchive pack(T... values)
{
  StateArchive archive;
  (archive.value(values), ...);
  return archive;
}

template <class T>
T unpack(StateArchive& archive)
{
  T value{};
  archive.value(value);
  return value;
}

std::string sentence_of(const std::exception_ptr& error)
{
  try {
    std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    return "not enough memory";
  } catch (const Error& e) {
    return e.what();
  } catch (const FarmBroken& e) {
    return e.what();
  } catch (const std::exception&) {
    return "a defect of this program has ended the runs on one rank: please report the command with its "
           "files";
  } catch (...) {
    return "stopped";
  }
}

std::string trouble_of(Message& m)
{
  return fmt::format("rank {}: {}", m.from, printable(unpack<std::string>(m.content)));
}

void broadcast(std::string& bytes)
{
  std::uint64_t size = bytes.size();
  MPI_Bcast(&size, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
  bytes.resize(size);
  constexpr std::uint64_t most = std::uint64_t{1} << 28;  // MPI counts are ints
  for (std::uint64_t at = 0; at < size; at += most)
    MPI_Bcast(bytes.data() + at, static_cast<int>(std::min(most, size - at)), MPI_BYTE, 0, MPI_COMM_WORLD);
}

/// Rank 0's outcomes to everyone.
void share(std::vector<RunOutcome>& outcomes, bool mine)
{
  const auto visit = [&](StateArchive& archive) {
    for (RunOutcome& outcome : outcomes) visit_state(archive, outcome), archive.value(outcome.from_cache);
  };
  std::string bytes;
  if (mine) {
    StateArchive archive;
    visit(archive);
    bytes = archive.take();
  }
  broadcast(bytes);
  if (mine) return;
  StateArchive archive(std::move(bytes), "MPI");
  visit(archive);
  archive.finish();
}

}  // namespace

std::vector<int> MpiFarm::agree(const std::vector<RunJob>& jobs) const
{
  std::uint64_t list = jobs.size();
  for (const RunJob& j : jobs) list = checksum(j.key, checksum("\n", list));
  struct Rank
  {
    std::uint64_t list;
    std::int64_t threads;
  };
  const Rank own{list, threads_};
  std::vector<Rank> all(static_cast<std::size_t>(size_));
  MPI_Allgather(&own, sizeof own, MPI_BYTE, all.data(), sizeof own, MPI_BYTE, MPI_COMM_WORLD);
  std::vector<int> threads;
  for (std::size_t r = 0; r < all.size(); ++r) {
    if (all[r].list != all[0].list)
      fail("MPI",
           fmt::format("rank {} asks for other runs than rank 0: the program, the input and the "
                       "processor's instruction set (environment GRANULAW_ISA) must be the same on all",
                       r));
    threads.push_back(static_cast<int>(all[r].threads));
  }
  return threads;
}

std::string MpiFarm::direct(RunQueue& queue, const std::vector<RunJob>& jobs, std::vector<int> room,
                     const Progress& progress) const
{
  const auto others = [&](Kind kind, const std::string& sentence) {
    for (int rank = 1; rank < size_; ++rank) send(rank, kind, pack(sentence));
  };
  const auto take = [&](Message& m) {
    const auto index = unpack<std::size_t>(m.content);
    RunOutcome outcome;
    visit_state(m.content, outcome);
    ++room[static_cast<std::size_t>(m.from)];
    queue.finish(index, std::move(outcome));
  };
  try {
    WorkerPool pool(threads_);
    Clock::time_point last_report{};
    while (!queue.finished()) {
      // one run for each rank in turn, so that the most expensive are not all on one
      for (bool any = true; any && queue.has_next();) {
        any = false;
        for (int rank = 0; rank < size_ && queue.has_next(); ++rank) {
          if (room[static_cast<std::size_t>(rank)] <= 0) continue;
          any = true;
          --room[static_cast<std::size_t>(rank)];
          const std::size_t index = queue.next();
          if (rank == 0)
            pool.start(index, jobs[index]);
          else
            send(rank, job, pack(index));
        }
      }
      if (pool.idle()) std::this_thread::sleep_for(look_every);
      std::exception_ptr broken;
      for (WorkerPool::Finished& run : pool.wait(look_every)) {
        ++room[0];
        if (run.broken)
          broken = run.broken;
        else
          queue.finish(run.index, std::move(run.outcome));
      }
      if (broken) std::rethrow_exception(broken);
      while (std::optional<Message> m = receive()) {
        if (m->kind == ended) {
          take(*m);
        } else if (m->kind == running) {
          const auto index = unpack<std::size_t>(m->content);
          queue.report(index, unpack<double>(m->content));
        } else if (m->kind == trouble) {
          throw FarmBroken(trouble_of(*m));
        }
      }
      if (Clock::now() - last_report < report_every && !queue.finished()) continue;
      last_report = Clock::now();
      for (const auto& [index, fraction] : pool.running()) queue.report(index, fraction);
      if (progress) progress(queue.done(), queue.label());
    }
  } catch (...) {
    others(stop, sentence_of(std::current_exception()));
    const Clock::time_point start = Clock::now();
    for (int left = size_ - 1; left > 0 && Clock::now() - start < stop_patience;) {
      std::optional<Message> m = receive();
      if (!m) std::this_thread::sleep_for(look_every);
      if (m && m->kind == ended) take(*m);  // what is finished is kept
      if (m && m->kind == stopped) --left;
    }
    throw;
  }
  others(end, "");
  std::string sentence;
  for (int left = size_ - 1; left > 0;) {
    std::optional<Message> m = receive();
    if (!m) std::this_thread::sleep_for(look_every);
    if (m && m->kind == trouble) sentence = trouble_of(*m);
    if (m && m->kind == stopped) --left;
  }
  return sentence;
}

std::exception_ptr MpiFarm::work(const std::vector<RunJob>& jobs, const Progress& progress) const
{
  std::optional<WorkerPool> pool(threads_);
  std::exception_ptr own_trouble;
  Clock::time_point last_report{};
  for (;;) {
    if (!own_trouble) try {
        if (pool->idle()) std::this_thread::sleep_for(look_every);
        for (WorkerPool::Finished& run : pool->wait(look_every)) {
          if (run.broken) std::rethrow_exception(run.broken);
          StateArchive content = pack(run.index);
          visit_state(content, run.outcome);
          send(0, ended, std::move(content));
        }
        if (Clock::now() - last_report > report_every) {
          last_report = Clock::now();
          std::string label;
          for (const auto& [index, fraction] : pool->running()) {
            send(0, running, pack(index, fraction));
            label = jobs[index].label;
          }
          if (progress) progress(0.0, label);
        }
      } catch (...) {
        own_trouble = std::current_exception();
        pool.reset();
        send(0, trouble, pack(sentence_of(own_trouble)));
      }
    else
      std::this_thread::sleep_for(look_every);
    while (std::optional<Message> m = receive()) {
      if (m->kind == job && !own_trouble) {
        const auto index = unpack<std::size_t>(m->content);
        pool->start(index, jobs[index]);
      } else if (m->kind == end) {
        send(0, stopped);
        return own_trouble;
      } else if (m->kind == stop) {
        pool.reset();
        send(0, stopped);
        if (own_trouble) std::rethrow_exception(own_trouble);
        throw FarmBroken(unpack<std::string>(m->content));
      }
    }
  }
}

std::vector<RunOutcome> MpiFarm::make(const std::vector<RunJob>& jobs, const Progress& progress)
{
  const std::vector<int> threads = agree(jobs);
  std::vector<RunOutcome> outcomes(jobs.size());
  std::string sentence;
  std::exception_ptr own_trouble;
  if (rank_ == 0) {
    RunQueue queue(jobs, cache_);
    sentence = direct(queue, jobs, threads, progress);
    outcomes = queue.take();
  } else {
    own_trouble = work(jobs, progress);
  }
  broadcast(sentence);
  if (own_trouble) std::rethrow_exception(own_trouble);
  if (!sentence.empty()) throw FarmBroken(sentence);
  share(outcomes, rank_ == 0);
  return outcomes;
}

}  // namespace granulaw
