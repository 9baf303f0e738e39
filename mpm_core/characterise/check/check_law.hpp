#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "characterise/body/materials.hpp"
#include "law/error_bound.hpp"
#include "law/law.hpp"

namespace granulaw {

/// A fresh impact by the solver, beside the law's replay of it.
struct FreshImpact
{
  std::string name;           ///< of the body, or a:b of a pair with its own law
  double velocity;            ///< m/s, of approach
  double force, restitution;  ///< relative errors of the law
  double restitution_bound;   ///< relative
  ErrorBound bound;           ///< of the law's certificate: 95 % of impacts lie within

  /// Within twice the bound.
  bool agrees() const { return force <= 2 * bound.force && restitution <= 2 * restitution_bound; }
};

struct LawCheckRequest
{
  std::string source;                    ///< of the law, leads sentences
  const Materials* materials = nullptr;  ///< that it was made from; null: the five numbers in the law
  int impacts = 2;                       ///< of each yielding body, and of each pair that has its own law
  unsigned seed = 1;                     ///< of their velocities
};

struct LawCheck
{
  std::vector<FreshImpact> impacts;
  std::vector<std::string> skipped;  ///< yielding bodies whose law depends on more than five numbers

  bool agrees() const;
};

/// Resolves every pair of the law; then throws each yielding body at a wall, and the two bodies of each pair
/// with its own law at each other. Speeds lie evenly in the logarithm, from twice that of first yield to the
/// end of the law's range. `made` gets each impact once it ends. Throws Error where `materials` are not those
/// that the law was made from.
LawCheck check_law(const Law& law, const LawCheckRequest& request, const Progress& progress = {},
                   const std::function<void(const FreshImpact&)>& made = {});

}  // namespace granulaw
