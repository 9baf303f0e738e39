#include "characterise/run_cache.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace granulaw {

namespace fs = std::filesystem;

namespace {

constexpr const char* extension = ".run";

/// FNV-1a, 64 bit: only names a file; equality is decided by the key inside.
std::uint64_t hash(const std::string& text)
{
  std::uint64_t h = 14695981039346656037ull;
  for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  return h;
}

/// The numbers of a summary in one fixed order, for reading and writing.
template <class Summary, class Visit>
void each_number(Summary& s, Visit visit)
{
  visit(s.restitution), visit(s.restitution_raw), visit(s.restitution_spread), visit(s.force_max);
  visit(s.delta_max), visit(s.delta_residual), visit(s.contact_time), visit(s.work_load),
      visit(s.work_unload);
  visit(s.cpu_s), visit(s.point_updates_per_s), visit(s.error_estimate), visit(s.energy_error),
      visit(s.ripple);
  visit(s.plastic_strain_max), visit(s.contact_loss), visit(s.hourglass);
}

}  // namespace

std::string RunCache::file_of(const std::string& key) const
{
  return fmt::format("{}/{:016x}{}", folder_, hash(key), extension);
}

bool RunCache::load(const std::string& key, RunResult& result) const
{
  if (folder_.empty()) return false;
  std::ifstream in(file_of(key));
  std::string line;
  if (!std::getline(in, line) || line != key) return false;
  RunResult read;
  std::size_t count = 0;
  in >> read.summary.points >> read.summary.steps >> read.summary.resolution >> read.summary.grids;
  each_number(read.summary, [&](double& value) { in >> value; });
  in >> count;
  if (!in || count > 10'000'000) return false;
  for (std::size_t k = 0; k < count && in; ++k) {
    TraceSample t{};
    int branch = 0;
    in >> t.time >> t.delta >> t.force >> t.contact_radius >> branch >> t.segment;
    t.branch = static_cast<Branch>(branch);
    read.trace.push_back(t);
  }
  std::string end;
  if (!(in >> end) || end != "end") return false;
  result = std::move(read);
  return true;
}

void RunCache::store(const std::string& key, const RunResult& result) const
{
  if (folder_.empty()) return;
  std::error_code ignored;
  fs::create_directories(folder_, ignored);
  const RunSummary& s = result.summary;
  std::string text = fmt::format("{}\n{} {} {} {}", key, s.points, s.steps, s.resolution, s.grids);
  each_number(result.summary, [&](const double& value) { text += fmt::format(" {:.17g}", value); });
  text += fmt::format("\n{}\n", result.trace.size());
  for (const TraceSample& t : result.trace)
    text += fmt::format("{:.17g} {:.17g} {:.17g} {:.17g} {} {}\n", t.time, t.delta, t.force, t.contact_radius,
                        static_cast<int>(t.branch), t.segment);
  text += "end\n";
  const std::string file = file_of(key), temporary = fmt::format("{}.tmp.{}", file, getpid());
  {
    std::ofstream out(temporary);
    out << text;
    if (!out.flush()) {  // a cache that cannot be written only costs time later
      fs::remove(temporary, ignored);
      return;
    }
  }
  fs::rename(temporary, file, ignored);
}

void RunCache::remove() const
{
  if (folder_.empty()) return;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, ignored))
    if (entry.path().filename().string().find(extension) != std::string::npos)
      fs::remove(entry.path(), ignored);
  fs::remove(folder_, ignored);  // fails, as it should, if something else lies there
}

}  // namespace granulaw
