// libFuzzer target of read_materials: whatever the text, one sentence or particles the solver can take.
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "finding.hpp"
#include "material_file/materials_file.hpp"

using namespace granulaw;

namespace {

/// Fault of accepted materials; "" if none.
std::string unusable(const MaterialsFile& file)
{
  const auto positive = [](double x) { return std::isfinite(x) && x > 0; };
  for (const auto& [name, m] : file.materials)
    if (!positive(m.density) || !positive(m.youngs_modulus) ||
        !(m.poisson_ratio >= 0 && m.poisson_ratio < 0.5) || !(m.yield_stress > 0))
      return "a material is impossible";
  for (const auto& [name, particle] : file.particles)
    if (!positive(particle.radius)) return "a particle has no size";
  return "";
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const std::string path =
      (tests::scratch() / ("granulaw_fuzz_" + std::to_string(getpid()) + ".toml")).string();
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  std::string what;
  try {
    if (what = unusable(read_materials(path)); !what.empty()) what = "accepted, but " + what;
  } catch (const Error& error) {
    if (what = tests::unclear(error.what(), path); !what.empty()) what.append(": ").append(error.what());
  }
  std::filesystem::remove(path);
  if (!what.empty()) tests::finding(what);
  return 0;
}
