#include "atlas/atlas_numbers.hpp"

#include <fmt/format.h>

#include <cmath>

#include "atlas/atlas_layout.hpp"
#include "base/error.hpp"

namespace granulaw {

namespace {

constexpr double version = 3;

}  // namespace

std::vector<double> numbers_of(const Atlas& atlas)
{
  AtlasParts parts = parts_of(atlas);
  std::vector<double> all{version};
  for (const AtlasDataset& dataset : atlas_datasets()) {
    const std::vector<double*> numbers = dataset.numbers(parts);
    all.push_back(static_cast<double>(numbers.size()));
    for (const double* number : numbers) all.push_back(*number);
  }
  return all;
}

Atlas atlas_of(std::span<const double> numbers)
{
  if (numbers.empty() || numbers.front() != version)
    fail("atlas", "its array is of another version",
         numbers.empty() ? std::string("no number") : fmt::format("{:g}", numbers.front()),
         fmt::format("{:g}", version));
  AtlasParts parts;
  std::span<const double> rest = numbers.subspan(1);
  for (const AtlasDataset& dataset : atlas_datasets()) {
    if (rest.empty()) fail("atlas", "its array ends early");
    const double count = rest.front();
    rest = rest.subspan(1);
    if (!(count >= 0 && count <= static_cast<double>(rest.size()) && count == std::floor(count)))
      fail("atlas", fmt::format("its array has an unusable length of '{}'", dataset.field.name),
           fmt::format("{:g}", count), fmt::format("0 to {}", rest.size()));
    const auto values = rest.first(static_cast<std::size_t>(count));
    fill(parts, dataset, {values.begin(), values.end()}, "atlas");
    rest = rest.subspan(values.size());
  }
  if (!rest.empty()) fail("atlas", "its array is longer than an atlas");
  return atlas_of(std::move(parts));
}

}  // namespace granulaw
