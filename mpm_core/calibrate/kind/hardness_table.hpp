#pragma once

#include <array>
#include <cstddef>

namespace granulaw {

// Made from indentations by the solver (docs/evidence/hardness.md).

/// Over the logarithmic slope of the flow curve and the logarithm of the stiffness, E* over the flow stress.
template <std::size_t Exponents, std::size_t Stiffnesses, std::size_t Places = 1>
struct HardnessTable
{
  std::array<double, Exponents> exponents;
  std::array<double, Stiffnesses> log_stiffnesses;
  std::array<double, Places> places;  ///< a/R of a ball
  std::array<std::array<std::array<double, Stiffnesses>, Exponents>, Places> values;
};

/// Vickers hardness over the flow stress at 8 %; friction 0.15.
inline constexpr HardnessTable<3, 8> vickers_table{
    {0.1, 0.25, 0.5},
    {2.7081, 3.2189, 3.8067, 4.3820, 5.0106, 5.7038, 6.5511, 7.6009},  // ln of 15, 25, 45, 80, 150, 300, 700, 2000
    {0},
    {{{{{1.542, 1.865, 2.213, 2.506, 2.757, 2.945, 3.070, 3.137},
      {1.514, 1.802, 2.103, 2.351, 2.556, 2.704, 2.800, 2.858},
      {1.495, 1.731, 1.967, 2.150, 2.292, 2.387, 2.443, 2.489}}}}}};

/// Mean pressure under a ball over the flow stress at 0.2 a/R; no friction.
inline constexpr HardnessTable<3, 5, 3> brinell_table{
    {0.1, 0.25, 0.5},
    {3.2189, 4.0943, 5.0106, 5.9915, 7.3132},  // ln of 25, 60, 150, 400, 1500
    {0.25, 0.4, 0.55},
    {{{{{2.002, 2.472, 2.829, 2.966, 3.010},
      {1.998, 2.429, 2.780, 2.945, 3.011},
      {1.966, 2.323, 2.670, 2.852, 2.946}}},
     {{{2.200, 2.568, 2.821, 2.924, 2.954},
      {2.142, 2.528, 2.767, 2.884, 2.935},
      {2.073, 2.448, 2.657, 2.780, 2.841}}},
     {{{2.322, 2.636, 2.794, 2.839, 2.835},
      {2.310, 2.615, 2.789, 2.881, 2.922},
      {2.330, 2.576, 2.745, 2.823, 2.867}}}}}};

}  // namespace granulaw
