#include "characterise/body/materials.hpp"

#include <fmt/format.h>

#include "base/error.hpp"

namespace granulaw {

const Material& Materials::material(const std::string& name) const
{
  const auto found = materials.find(name);
  if (found != materials.end()) return found->second;
  fail_unknown(source, "no material", name, names_of(materials));
}

const Particle& Materials::particle(const std::string& name) const
{
  if (const auto fault = faults.find(name); fault != faults.end()) throw Error(fault->second);
  const auto found = particles.find(name);
  if (found != particles.end()) return found->second;
  if (particles.empty())
    fail(source, fmt::format("no particle '{}': the file defines none, as [particle.NAME]", cut(name)));
  fail_unknown(source, "no particle", name, names_of(particles));
}

bool Materials::means_particle(const std::string& name) const
{
  return !materials.contains(name) && particles.contains(name);
}

void Materials::require(const std::string& name) const
{
  if (materials.contains(name) || particles.contains(name)) return;
  std::vector<std::string> names = names_of(materials);
  for (const auto& [known, particle] : particles) names.push_back(known);
  fail_unknown(source, "no material or particle", name, names);
}

}  // namespace granulaw
