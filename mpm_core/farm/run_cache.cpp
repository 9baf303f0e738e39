#include "farm/run_cache.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "base/state_archive.hpp"

namespace granulaw {

namespace fs = std::filesystem;

namespace {

constexpr const char* magic = "granulaw run 3";

/// The file's bytes before the outcome's, and what must follow.
std::string header_of(const std::string& key, double cost, double cpu_s, const std::string& body)
{
  return fmt::format("{}\nkey {}\ncost {:.6g}\ncpu_s {:.6g}\noutcome {} {:016x}\n", magic, key, cost, cpu_s,
                     body.size(), checksum(body));
}

/// True, and the rest of the line, if the next line begins with `word`.
bool next_line(std::istream& in, const std::string& word, std::string& rest)
{
  if (!std::getline(in, rest) || !rest.starts_with(word)) return false;
  rest.erase(0, word.size());
  return true;
}

}  // namespace

std::string RunCache::file_of(const std::string& key) const
{
  return fmt::format("{}/{:016x}.run", folder_, checksum(key));
}

bool RunCache::load(const std::string& key, RunOutcome& outcome) const
{
  if (folder_.empty()) return false;
  std::ifstream in(file_of(key), std::ios::binary);
  std::string found_key, line;
  if (!next_line(in, magic, line) || !next_line(in, "key ", found_key) || found_key != key) return false;
  if (!next_line(in, "cost ", line) || !next_line(in, "cpu_s ", line) || !next_line(in, "outcome ", line))
    return false;
  const std::string body{std::istreambuf_iterator<char>(in), {}};
  if (line != fmt::format("{} {:016x}", body.size(), checksum(body))) return false;
  try {
    RunOutcome read;
    StateArchive archive(body, "cache");
    visit_state(archive, read);
    archive.finish();
    outcome = std::move(read);
  } catch (const Error&) {  // whole, but of another program: the key lacks something
    return false;
  }
  outcome.from_cache = true;
  return true;
}

void RunCache::store(const std::string& key, double cost, const RunOutcome& outcome) const
{
  if (folder_.empty()) return;
  std::error_code ignored;
  fs::create_directories(folder_, ignored);
  RunOutcome copy = outcome;
  StateArchive archive;
  visit_state(archive, copy);
  const std::string body = archive.take();
  try {
    write_text_atomically(file_of(key), header_of(key, cost, outcome.cpu_s, body) + body);
  } catch (const Error&) {  // no room, no permission: the run is made again next time
  }
}

std::string default_cache_folder()
{
  const char* xdg = std::getenv("XDG_CACHE_HOME");
  if (xdg && *xdg) return std::string(xdg) + "/granulaw/runs";
  const char* home = std::getenv("HOME");
  if (home && *home) return std::string(home) + "/.cache/granulaw/runs";
  return {};
}

}  // namespace granulaw
