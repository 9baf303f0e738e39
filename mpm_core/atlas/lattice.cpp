#include "atlas/lattice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "atlas/interpolation.hpp"
#include "base/error.hpp"

namespace granulaw {

namespace {

/// Weights of rows of hardenings, one row a stiffness, in order: calls `add(weight, stiffness, hardening)`.
template <class Add>
void along_rows(const std::vector<double>& stiffnesses, const MaterialRatios& m, const auto& hardenings_at,
                const Add& add)
{
  if (stiffnesses.empty()) return;
  const std::vector<double> along = interpolation_weights(logarithms(stiffnesses), std::log(m.stiffness));
  for (std::size_t i = 0; i < stiffnesses.size(); ++i) {
    const double k = stiffnesses[i];
    const std::vector<double> hardenings = hardenings_at(k);
    const std::vector<double> across =
        interpolation_weights(hardening_coordinates(k, hardenings), hardening_coordinate(k, m.hardening));
    for (std::size_t j = 0; j < hardenings.size(); ++j) add(along[i] * across[j], k, hardenings[j]);
  }
}

}  // namespace

std::vector<double> Lattice::hardenings_at(double stiffness) const
{
  std::vector<double> seen;
  for (const double h : hardenings)
    if (h == 0 || h * stiffness >= weakest_hardening) seen.push_back(h);
  return seen;
}

std::vector<double> Lattice::poisson_ratios() const
{
  std::vector<double> all = block_poisson_ratios;
  all.push_back(main_poisson_ratio);
  std::sort(all.begin(), all.end());
  return all;
}

std::vector<MaterialRatios> Lattice::materials() const
{
  std::vector<MaterialRatios> all;
  for (const double k : stiffnesses)
    for (const double h : hardenings_at(k)) all.push_back({k, main_poisson_ratio, h});
  for (const double k : block_stiffnesses)
    for (const double h : block_hardenings)
      for (const double nu : block_poisson_ratios) all.push_back({k, nu, h});
  return all;
}

std::size_t Lattice::reference_materials() const
{
  return materials().size() - block_stiffnesses.size() * block_hardenings.size() * block_poisson_ratios.size();
}

std::vector<double> Lattice::weights(const MaterialRatios& m, double block_end, Place place) const
{
  std::vector<double> weights;
  const auto add_reference = [&](const MaterialRatios& at, double factor) {
    std::size_t next = 0;
    along_rows(stiffnesses, place(*this, at), [&](double k) { return hardenings_at(k); },
               [&](double weight, double, double) { weights[next++] += factor * weight; });
  };
  const std::size_t reference = reference_materials();
  weights.assign(materials().size(), 0.0);
  add_reference(m, 1);
  const std::vector<double> ratios = poisson_ratios(), by_ratio = interpolation_weights(ratios, m.poisson_ratio);
  const std::vector<double> counted(block_stiffnesses.begin(), std::upper_bound(block_stiffnesses.begin(),
                                                                            block_stiffnesses.end(), block_end));
  std::size_t next = reference;
  along_rows(counted, m, [&](double) -> const std::vector<double>& { return block_hardenings; },
             [&](double weight, double k, double h) {
               for (std::size_t r = 0; r < ratios.size(); ++r) {
                 if (ratios[r] == main_poisson_ratio) continue;
                 const double factor = weight * by_ratio[r];
                 if (factor != 0) weights[next] += factor, add_reference({k, ratios[r], h}, -factor);
                 ++next;
               }
             });
  return weights;
}

void check_nodes(const Lattice& lattice, const std::vector<LatticeNode>& nodes, const char* what)
{
  const std::vector<MaterialRatios> expected = lattice.materials();
  if (nodes.size() != expected.size())
    fail("atlas", fmt::format("has the wrong number of {}s", what), std::to_string(nodes.size()),
         std::to_string(expected.size()));
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (!(nodes[k].material == expected[k])) fail("atlas", fmt::format("{} {} is not the grid's", what, k));
}

}  // namespace granulaw
