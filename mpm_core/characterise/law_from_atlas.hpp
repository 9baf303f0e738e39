#pragma once

#include "characterise/build_options.hpp"
#include "law/law.hpp"

namespace granulaw {

/// The law of a homogeneous, rate-independent, linearly hardening or elastic sphere out of the atlas;
/// options: depth and fastest. Needs atlas.why_not() empty for a material that yields.
BodyLaw law_from(const Atlas& atlas, const LawMaterial& material, const BuildOptions& options);

}  // namespace granulaw
