#pragma once

#include "atlas/atlas.hpp"
#include "atlas/law_range.hpp"
#include "law/law.hpp"

namespace granulaw {

/// The law of a homogeneous, rate-independent, linearly hardening or elastic sphere out of the atlas;
/// range: depth and fastest. Needs atlas.why_not() empty for a material that yields.
BodyLaw law_from(const Atlas& atlas, const LawMaterial& material, const LawRange& range);

}  // namespace granulaw
