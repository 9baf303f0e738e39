#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>

#include "characterise/characterised_body.hpp"

namespace granulaw {

/// FNV-1a: tells whether a law was made from these very materials.
inline std::string hash_of(const std::string& text)
{
  std::uint64_t h = 14695981039346656037ull;
  for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  return fmt::format("{:016x}", h);
}

/// Of a material that its five numbers determine.
inline std::string hash_of(const Material& m)
{
  return hash_of(fmt::format("{:.17g} {:.17g} {:.17g} {:.17g} {:.17g}", m.density, m.youngs_modulus,
                             m.poisson_ratio, m.yield_stress, m.hardening_modulus));
}

/// Of a characterised that they do not determine: its layers, shape, hardening law or rate.
inline std::string hash_of(const CharacterisedBody& characterised)
{
  return hash_of(characterised.description);
}

/// Of the body and its material `m`, at the pole: what the provenance of a law keeps.
inline std::string hash_of(const CharacterisedBody& characterised, const Material& m)
{
  return characterised.is_plain() ? hash_of(m) : hash_of(characterised);
}

}  // namespace granulaw
