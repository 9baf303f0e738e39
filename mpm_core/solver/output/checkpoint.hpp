#pragma once

#include <functional>
#include <optional>
#include <string>

#include "solver/output/trace.hpp"

namespace granulaw {

class StateArchive;

/// Store of the state of runs, from which they go on after they were killed; the solver contains no file
/// handling. One request makes several runs (shifted grids, two resolutions), each under a key. They may call
/// at the same time from several threads. A state belongs to one request: the same particles, partner, drive
/// and RunOptions (except threads), the same program and instruction set. The continued run then has the
/// identical trace, bit for bit.
struct CheckpointStore
{
  std::string name;  ///< leads the sentences about a state that cannot be used
  /// Text saved last under `key`, empty if nothing was.
  std::function<std::string(const std::string& key)> load;
  /// Keeps `state` under `key`, in place of what it held. May throw to stop the run.
  std::function<void(const std::string& key, std::string state)> save;
  /// Asked at every sample of a trace: save now?
  std::function<bool(const std::string& key)> due;

  explicit operator bool() const { return static_cast<bool>(save); }
};

void visit_planes(StateArchive& archive, std::vector<PlaneTrace>& planes);
/// All that a run found.
void visit_result(StateArchive& archive, RunResult& result);

/// The place of one run in a store. Without a store every call is a single test.
class CheckpointSlot
{
 public:
  CheckpointSlot() = default;
  CheckpointSlot(const CheckpointStore& store, std::string key) : store_(store), key_(std::move(key)) {}

  /// The result, if this run had been finished.
  std::optional<RunResult> finished() const;
  void keep_finished(RunResult& result) const;

  using Visit = std::function<void(StateArchive&)>;
  /// Loads the state of a run that had been stopped; false: there is none, it starts from the beginning.
  bool resume(const Visit& visit) const;
  bool due() const { return store_ && store_.due(key_); }
  void save(const Visit& visit) const;

 private:
  enum class Kind : char { running = 'r', finished = 'f' };
  /// An archive to load from, if there is a state of that kind.
  std::optional<StateArchive> open(Kind kind) const;
  void store(Kind kind, const Visit& visit) const;

  CheckpointStore store_;
  std::string key_;
};

}  // namespace granulaw
