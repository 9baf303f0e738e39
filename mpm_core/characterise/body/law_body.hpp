#pragma once

#include <optional>
#include <string>

#include "characterise/body/characterised_body.hpp"
#include "characterise/body/materials.hpp"
#include "law/law.hpp"

namespace granulaw {

/// One body of a law file: what it is called there, and what its law is made from.
struct LawBody
{
  LawMaterial material;  ///< its name is the body's; of several materials the one at the pole, and the
                         ///< smallest yield stress in the body
  CharacterisedBody characterised;
  std::string body = sphere_name;  ///< BodyLaw::body
  std::string hash;                ///< material_hash() of all that determines the law
  /// A particle of any shape. Its law is that of its material's sphere, for the radius of curvature at the
  /// contact; a certificate over orientations says what that is wrong by.
  std::optional<Particle> shape{};

  /// True if the atlas and the pair rule may be used: a homogeneous sphere of five numbers.
  bool is_plain_sphere() const { return body == sphere_name && characterised.is_plain(); }
};

/// The body that `name` means: a material's homogeneous sphere, else a particle. Throws Error if there is
/// neither, or if the material depends on the rate: its law then needs a particle of a certain size, which
/// `hint` gives how to name.
LawBody law_body(const std::string& name, const Materials& materials,
                 const std::string& hint = "name a particle of it");

/// True if a law was made from this very body: FNV-1a, 16 hexadecimal digits, of the five numbers of
/// `material` (SI) for a plain body (CharacterisedBody::is_plain), of CharacterisedBody::description for any
/// other.
std::string material_hash(const CharacterisedBody& characterised, const Material& material);

}  // namespace granulaw
