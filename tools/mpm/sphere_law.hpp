#pragma once

#include <string>

#include "law/law.hpp"
#include "material_file/materials_file.hpp"

namespace granulaw {

/// The law of a sphere of one material on the rigid wall.
struct SphereLaw
{
  Law law;
  std::string name;    ///< of the material, as the law has it
  std::string source;  ///< file that the law is of, for messages

  PairLaw wall() const { return resolve_pair(law, name, wall_name, source); }
};

/// Of the file `law`, else of the program's atlas. `instead`: what to say where neither has it, such as "--by solver". Throws
/// Error, also where the particle is no homogeneous sphere or has another size than the law.
SphereLaw sphere_law(const std::string& materials, const std::string& particle, const std::string& law, const std::string& command, const std::string& instead);

}  // namespace granulaw
