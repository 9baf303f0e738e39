#include "solver/output/checkpoint.hpp"

#include "base/state_archive.hpp"

namespace granulaw {

void visit_planes(StateArchive& a, std::vector<PlaneTrace>& planes)
{
  planes.resize(a.count(planes.size(), sizeof(PlaneTrace::normal)));
  for (PlaneTrace& plane : planes) a.value(plane.normal), a.growing(plane.samples);
}

void visit_result(StateArchive& a, RunResult& r)
{
  a.growing(r.trace), a.value(r.summary), a.growing(r.yield_overlaps);
  visit_planes(a, r.planes);
  bool rebounds = r.rebound.has_value();
  a.value(rebounds);
  if (!rebounds) return;
  if (a.loading()) r.rebound.emplace();
  a.value(*r.rebound);
}

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
  visit_result(*archive, result);
  archive->finish();
  return result;
}

void CheckpointSlot::keep_finished(RunResult& result) const
{
  if (!store_) return;
  store(Kind::finished, [&](StateArchive& a) { visit_result(a, result); });
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
