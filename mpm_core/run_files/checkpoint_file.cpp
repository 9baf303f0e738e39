#include "run_files/checkpoint_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "base/state_archive.hpp"
#include "base/version.hpp"
#include "solver/body/kernels.hpp"
#include "solver/shape/shape.hpp"

namespace granulaw {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr std::string_view title = "granulaw checkpoint ", format = "1\n";

struct Header
{
  std::uint64_t length, check;
};
constexpr std::size_t header_size = title.size() + format.size() + sizeof(Header);

json describe(const FlowLaw& law)
{
  return {{"name", law.name}, {"values", law.values}};
}

json describe(const Material& m)
{
  return {{"density", m.density},
          {"youngs_modulus", m.youngs_modulus},
          {"poisson_ratio", m.poisson_ratio},
          {"yield_stress", m.yields() ? json(m.yield_stress) : json(nullptr)},
          {"hardening_modulus", m.hardening_modulus},
          {"hardening", describe(m.hardening)},
          {"rate", describe(m.rate)},
          {"yield_surface", describe(m.yield_surface)}};
}

void add(RunIdentity& identity, const std::string& whose, const Particle& p)
{
  json materials = json::array(), layers = json::array(), inclusions = json::array(), profile = json::array();
  for (const Material& m : p.materials) materials.push_back(describe(m));
  for (const Particle::Layer& l : p.layers) layers.push_back({l.thickness, l.material});
  for (const Particle::Inclusion& i : p.inclusions)
    p.shape ? inclusions.push_back({i.x, i.y, i.z, i.radius, i.material})
            : inclusions.push_back({i.r, i.z, i.radius, i.material});
  for (const ProfilePoint& point : p.profile) profile.push_back({point.r, point.z});
  identity.emplace_back(whose + " radius", fmt::format("{} m", p.radius));
  identity.emplace_back(whose + " materials", materials.dump());
  identity.emplace_back(whose + " profile", profile.dump());
  identity.emplace_back(whose + " layers", layers.dump());
  identity.emplace_back(whose + " inclusions", inclusions.dump());
  if (p.shape) identity.emplace_back(whose + " shape", p.shape->definition());
}

/// Throws Error naming the first thing that differs.
void compare(const RunIdentity& found, const RunIdentity& own, const std::string& path)
{
  for (std::size_t k = 0; k < own.size(); ++k) {
    if (k < found.size() && found[k] == own[k]) continue;
    const bool same_name = k < found.size() && found[k].first == own[k].first;
    const std::string what = "is the checkpoint of another run (" + own[k].first + ")";
    if (!same_name || found[k].second.size() > 40 || own[k].second.size() > 40) fail(path, what);
    fail(path, what, found[k].second, own[k].second);
  }
  if (found.size() != own.size()) fail(path, "is the checkpoint of another run");
}

void visit(StateArchive& a, RunIdentity& identity)
{
  identity.resize(a.count(identity.size(), 2 * sizeof(std::uint64_t)));
  for (auto& [name, value] : identity) a.value(name), a.value(value);
}

}  // namespace

RunIdentity identity_of(RunIdentity asked, const Particle& particle, const Partner& partner,
                        const RunOptions& o)
{
  RunIdentity& identity = asked;
  identity.emplace_back("version", version());
  identity.emplace_back("commit", git_hash());
  identity.emplace_back("instruction set", name_of(instruction_set()));
  add(identity, "particle's", particle);
  identity.emplace_back("partner", partner.particle ? "particle" : partner.wall ? "wall" : "rigid plane");
  if (partner.particle) add(identity, "partner's", *partner.particle);
  if (partner.wall) identity.emplace_back("wall's material", describe(*partner.wall).dump());
  identity.emplace_back("courant", fmt::format("{}", o.courant));
  identity.emplace_back("slowness", fmt::format("{}", o.slowness));
  identity.emplace_back("shifted grids", fmt::format("{}", o.shifted_grids));
  identity.emplace_back("samples", fmt::format("{}", o.samples));
  return identity;
}

CheckpointFile::CheckpointFile(std::string path, double interval, RunIdentity identity,
                               std::function<bool()> at_once)
    : path_(std::move(path)), interval_(interval), identity_(std::move(identity)), at_once_(std::move(at_once))
{
  was_found_ = fs::exists(path_);
  if (was_found_) read();
}

void CheckpointFile::read()
{
  const auto damaged = [&] { fail(path_, "is cut off or damaged; without it the run starts anew"); };
  std::ifstream in(path_, std::ios::binary);
  if (!in) fail(path_, "is there, but cannot be read");
  std::string head(header_size, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (!head.starts_with(title)) fail(path_, "is no checkpoint, and is left as it is");
  if (!std::string_view(head).substr(title.size()).starts_with(format))
    fail(path_, "is a checkpoint of another version of the program");
  if (!in) damaged();
  Header header;
  std::memcpy(&header, head.data() + head.size() - sizeof header, sizeof header);
  if (fs::file_size(path_) != header_size + header.length) damaged();  // before so much is asked for
  std::string payload(header.length, '\0');
  in.read(payload.data(), static_cast<std::streamsize>(payload.size()));
  if (!in || checksum(payload) != header.check) damaged();

  StateArchive archive(std::move(payload), path_);
  RunIdentity found;
  visit(archive, found);
  compare(found, identity_, path_);
  const std::size_t states = archive.count(0, 2 * sizeof(std::uint64_t));
  for (std::size_t k = 0; k < states; ++k) {
    std::string key, state;
    archive.value(key), archive.value(state);
    states_[key] = std::move(state);
  }
  archive.finish();
}

void CheckpointFile::write() const
{
  StateArchive archive;
  RunIdentity identity = identity_;
  visit(archive, identity);
  archive.count(states_.size(), 0);
  for (const auto& item : states_) {
    std::string key = item.first, state = item.second;
    archive.value(key), archive.value(state);
  }
  const std::string payload = archive.take();
  const Header header{payload.size(), checksum(payload)};
  std::string bytes{title};
  bytes += format;
  bytes.append(reinterpret_cast<const char*>(&header), sizeof header);
  write_text_atomically(path_, bytes + payload);
}

bool CheckpointFile::due(const std::string& key)
{
  if (at_once_ && at_once_()) return true;
  const auto now = std::chrono::steady_clock::now();
  const std::lock_guard lock(mutex_);
  const auto [last, first_time] = saved_.try_emplace(key, now);
  return interval_.count() == 0 || (!first_time && now - last->second >= interval_);
}

CheckpointStore CheckpointFile::store()
{
  CheckpointStore store;
  store.name = path_;
  store.load = [this](const std::string& key) {
    const std::lock_guard lock(mutex_);
    const auto state = states_.find(key);
    return state == states_.end() ? std::string() : state->second;
  };
  store.save = [this](const std::string& key, std::string state) {
    const std::lock_guard lock(mutex_);
    states_[key] = std::move(state);
    write();
    saved_[key] = std::chrono::steady_clock::now();
  };
  store.due = [this](const std::string& key) { return due(key); };
  return store;
}

void CheckpointFile::remove() const
{
  std::error_code ignored;  // nothing is there if the run was shorter than the interval
  fs::remove(linked_file(path_), ignored);
}

}  // namespace granulaw
