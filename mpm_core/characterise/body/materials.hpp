#pragma once

#include <map>
#include <string>
#include <vector>

#include "solver/shape/particle.hpp"

namespace granulaw {

/// Input of contact laws: materials, and particles of them, by name. SI.
///
/// A material stands for the homogeneous sphere of it. A particle is needed where the law depends on more
/// than the material: layers, inclusions, a profile, or a rate, which makes the law depend on the size.
struct Materials
{
  std::string source;  ///< leads every message about them: the path of a file, or what the caller likes
  std::map<std::string, Material> materials;  ///< validate(Material) holds for each
  std::map<std::string, Particle> particles;  ///< validate(Particle) holds for each without a fault
  std::map<std::string, std::string> faults{};  ///< by particle: the sentence about the file of its shape, which it lacks

  /// Throw Error naming the nearest name where there is no such material or particle, or the particle's fault.
  const Material& material(const std::string& name) const;
  const Particle& particle(const std::string& name) const;

  /// True if `name` means a particle. A material goes before a particle of its name.
  bool means_particle(const std::string& name) const;
  /// Throws Error if `name` is neither a material nor a particle.
  void require(const std::string& name) const;
};

/// The keys of a map, in their order.
template <class Map>
std::vector<std::string> names_of(const Map& map)
{
  std::vector<std::string> names;
  for (const auto& entry : map) names.push_back(entry.first);
  return names;
}

}  // namespace granulaw
