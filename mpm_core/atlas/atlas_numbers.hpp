#pragma once

#include <span>
#include <vector>

#include "atlas/atlas.hpp"

namespace granulaw {

/// All of an atlas as an array, from which atlas_of() makes the same again: for programs that have no file,
/// or no HDF5. Its first number is the version of this order, every list begins with its length.
std::vector<double> numbers_of(const Atlas& atlas);
/// Throws Error where these are not the numbers of an atlas.
Atlas atlas_of(std::span<const double> numbers);

}  // namespace granulaw
