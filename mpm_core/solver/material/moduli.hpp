#pragma once

#include "solver/material/laws.hpp"

namespace granulaw {

/// Elastic-plastic constants in solver units (stress / E*).
struct Moduli
{
  double shear;      ///< G
  double bulk;       ///< K
  double yield;      ///< Y
  double hardening;  ///< H
  bool yields;       ///< false: elastic, Y and H unused
  /// hardening and rate laws; the default is Y + H ep, which reads `yield` and `hardening`
  flow::Flow flow{};
};

/// A material of a body that is built, in solver units.
struct Phase
{
  Moduli moduli;
  double density = 1;
};

}  // namespace granulaw
