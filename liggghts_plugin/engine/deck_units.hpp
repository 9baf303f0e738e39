#pragma once

#include <string>
#include <string_view>

#include "base/error.hpp"

namespace granulaw::plugin {

/// SI values of the deck's units. Time is the second in both systems that are accepted.
struct DeckUnits
{
  double length = 1;  ///< m
  double mass = 1;    ///< kg

  double pressure() const { return mass / length; }                     ///< Pa
  double density() const { return mass / (length * length * length); }  ///< kg/m^3
  double energy() const { return mass * length * length; }              ///< J

  /// Units of LIGGGHTS's `units STYLE`. Throws Error, starting with `where`, unless it is si or cgs.
  static DeckUnits of(std::string_view style, const std::string& where)
  {
    if (style == "si") return {};
    if (style == "cgs") return {0.01, 0.001};
    fail(where, "the deck's units cannot be converted", std::string("units ") + std::string(style),
         "units si, units cgs");
  }
};

}  // namespace granulaw::plugin
