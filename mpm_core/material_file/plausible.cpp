#include "material_file/plausible.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <set>

#include "base/error.hpp"

namespace granulaw {

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();
bool is_silent = false;

struct Usual
{
  const char *quantity, *unit;
  double least;      ///< no solid is below
  double low, high;  ///< asked about outside
  const char *below, *above;
};
constexpr Usual usual[] = {
    // no solid is lighter than 0.16 kg/m^3 (graphene aerogel), none denser than 22600 (osmium): below 20 it
    // is
    // a foam, or g/cm^3
    {"density", "kg/m^3", 0.1, 20, 23000, "foams alone are as light", "no solid is as dense"},
    // diamond has 1.2e12 Pa: below 1e6 it is a gel, or MPa; below 1e3 a number of GPa
    {"youngs_modulus", "Pa", 1e3, 1e6, 1.3e12, "gels alone are as soft", "no solid is as stiff"},
    // the hardest solids yield at some 1e10 Pa: below 1e4 it is a paste, or MPa; below 1 a number of GPa
    {"yield_stress", "Pa", 1, 1e4, 1e11, "pastes alone yield as soon", "no solid is as strong"},
    {"hardness", "Pa", 1, 1e4, 3e11, "pastes alone are as soft", "no solid is as hard"},
    // a fall from 500 m in a vacuum: beyond it is a shot, or mm/s
    {"velocity", "m/s", 0, 0, 100, "", "no fall is as fast"},
    {"radius", "m", 0, 1e-8, 0.5, "no grain is as small", "few grains are as large"}};

}  // namespace

void ask_nothing_of_units()
{
  is_silent = true;
}

bool is_usual_quantity(const std::string& quantity)
{
  return std::any_of(std::begin(usual), std::end(usual),
                     [&](const Usual& u) { return quantity == u.quantity; });
}

void check_plausible(const std::string& where, const std::string& quantity, const std::string& key,
                     double value)
{
  const Usual& u = *std::find_if(std::begin(usual), std::end(usual),
                                 [&](const Usual& one) { return quantity == one.quantity; });
  const std::string found = fmt::format("{:g} {}", value, u.unit);
  if (value < u.least)
    fail(where, fmt::format("'{}' is that of no solid", key), found,
         fmt::format("{:g} {} or more: is it in another unit?", u.least, u.unit));
  if (value >= u.low && !(value > u.high && value < unlimited)) return;
  static std::set<std::string> said;
  const std::string line = printable(fmt::format("{}: '{}' is {}: {}; is it in {}?", where, key, found,
                                                 value < u.low ? u.below : u.above, u.unit));
  if (!is_silent && said.insert(line).second) fmt::print(stderr, "mpm: warning: {}\n", line);
}

}  // namespace granulaw
