#pragma once

#include <cmath>
#include <vector>

#include "law/contact_curve.hpp"
#include "law/thornton.hpp"

namespace granulaw::plugin {

/// Work that a contact has turned into plastic strain once its largest overlap is x_m:
/// D(x_m) = W_load(x_m) - W_unload(x_m), a function of x_m alone because unloading and reloading share a curve.
///
/// Stored as D/x^2.5 (near constant: F ~ x^1.5) at nodes uniform in s = x^(1/4), linear between them: the ledger
/// needs it in the contact loop, where ContactCurve's exact quadrature would be too slow. In units of
/// (Hertz force at x = 1) * length, as ContactCurve's works.
class DissipationTable
{
 public:
  DissipationTable() = default;
  explicit DissipationTable(const ContactCurve& curve, int intervals = 4096);

  double operator()(double x) const
  {
    const double root = std::sqrt(x), position = std::min(std::sqrt(root) * per_h_, last_);
    const auto k = static_cast<std::size_t>(position);
    const double t = position - static_cast<double>(k);
    return x * x * root * (ratio_[k] + t * (ratio_[k + 1] - ratio_[k]));
  }

 private:
  std::vector<double> ratio_;
  double per_h_ = 0, last_ = 0;
};

/// The same for Thornton's law in closed form, J.
double thornton_dissipation(const ThorntonPair& pair, double r_eff, double delta_max);

}  // namespace granulaw::plugin
