#include "atlas/tabulate_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "law/contact_law.hpp"

namespace granulaw {

namespace {

/// Shares of the table, whose other columns stand.
void make_shares_admissible(CurveTable& table, const std::vector<double>& x)
{
  const Curve wanted(table);
  HermiteColumn& share = table.hertz_share;
  std::vector<bool> changed(x.size(), false);
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double at = std::min(x[k], table.end);
    const double admissible =
        admissible_hertz_share(share.value[k], wanted.top(at), at, wanted.loading(at).stiffness);
    changed[k] = admissible != share.value[k];
    share.value[k] = admissible;
  }
  for (std::size_t k = 0; k < x.size(); ++k)
    if (changed[k]) {
      const std::size_t low = k ? k - 1 : 0, high = std::min(k + 1, x.size() - 1);
      share.slope[k] = (share.value[high] - share.value[low]) / (x[high] - x[low]);
    }
}

}  // namespace

Curve fitted_curve(CurveTable table, std::optional<AxisTable> axis)
{
  if (const Fault fault = Curve::fault(table, axis ? &*axis : nullptr))
    fail("fit", fmt::format("{}: the runs are too coarse", fault.what), fault.found, fault.allowed);
  return Curve(std::move(table), std::move(axis));
}

Curve tabulate(const ContactLaw& law)
{
  CurveTable table(law.onset(), law.end());
  const auto nodes = table.nodes(),
             yielding = table.yields() ? table.yielding_nodes() : std::vector<double>{};
  for (const double x : nodes) {
    const ContactLaw::Loading now = law.continued_loading(x);
    table.force.add(now.force, now.stiffness), table.radius.add(now.radius, now.radius_slope);
  }
  for (const double x : yielding) {
    const ContactLaw::Losses now = law.continued_losses(x);
    table.kept.add(now.kept, now.kept_slope), table.span.add(now.span, now.span_slope);
    table.hertz_share.add(now.share, now.share_slope), table.unloading_radius.push_back(now.unloading_radius);
  }
  make_rise(table.force, nodes), make_rise(table.radius, nodes);
  make_fall(table.kept, yielding), make_fall(table.span, yielding);
  if (table.yields()) make_shares_admissible(table, yielding);
  return fitted_curve(std::move(table));
}

double change_of_restitution(const LawShape& shape, const Curve& curve)
{
  const Spline fitted = shape.by_q(&LawShape::dissipation);
  double most = 0;
  for (int k = 1; k < 1000; ++k) {
    const double q = shape.q(shape.end) * k / 1000, x = shape.onset * std::exp(4 * q);
    if (x >= curve.end()) break;
    most = std::max(most, std::abs(std::sqrt(curve.kept(x)) * std::exp(0.5 * fitted.value(q)) - 1));
  }
  return most;
}

double table_error(const LawShape& shape, const Curve& curve)
{
  const double s_end = std::pow(std::min(curve.end(), shape.end), 0.25);
  const Spline force_reduction = shape.by_q(&LawShape::force_reduction);
  double worst = 0;
  for (int k = 1; k < 2000; ++k) {
    const double s = s_end * k / 2000, x = s * s * s * s;
    const double exact =
        std::pow(x, 1.5) * shape.elastic.force_ratio(s) * std::exp(-force_reduction.value(shape.q(x)));
    worst = std::max(worst, std::abs(curve.force(x) / exact - 1));
  }
  return worst;
}

}  // namespace granulaw
