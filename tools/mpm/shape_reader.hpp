#pragma once

#include <memory>
#include <string>

#include "solver/shape/solid.hpp"
#include "toml_section.hpp"

namespace granulaw {

/// {kind = "NAME", key = value, ...}: a three-dimensional body. Paths of files are relative to `folder`.
/// `radius`, m, is the particle's own, which a sphere may go by; 0: none.
std::shared_ptr<const Solid> read_solid(const Section& shape, const std::string& folder, double radius);

}  // namespace granulaw
