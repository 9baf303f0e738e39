#include "solver/output/checkpoint.hpp"

#include "solver/output/state_archive.hpp"

namespace granulaw {

std::optional<StateArchive> CheckpointSlot::open(Kind kind) const
{
  if (!store_) return {};
  std::string bytes = store_.load(key_);
  if (bytes.empty()) return {};
  StateArchive archive(std::move(bytes), store_.name);
  Kind found{};
  archive.value(found);
  if (found != kind) return {};
  return archive;
}

void CheckpointSlot::store(Kind kind, const Visit& visit) const
{
  StateArchive archive;
  archive.value(kind);
  visit(archive);
  store_.save(key_, archive.take());
}

std::optional<RunResult> CheckpointSlot::finished() const
{
  std::optional<StateArchive> archive = open(Kind::finished);
  if (!archive) return {};
  RunResult result;
  archive->growing(result.trace);
  archive->value(result.summary);
  archive->growing(result.yield_overlaps);
  archive->finish();
  return result;
}

void CheckpointSlot::keep_finished(RunResult& result) const
{
  if (!store_) return;
  store(Kind::finished, [&](StateArchive& a) {
    a.growing(result.trace), a.value(result.summary), a.growing(result.yield_overlaps);
  });
}

bool CheckpointSlot::resume(const Visit& visit) const
{
  std::optional<StateArchive> archive = open(Kind::running);
  if (!archive) return false;
  visit(*archive);
  archive->finish();
  return true;
}

void CheckpointSlot::save(const Visit& visit) const
{
  store(Kind::running, visit);
}

}  // namespace granulaw
