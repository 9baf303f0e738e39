#include "law/orientation_check.hpp"

#include <algorithm>
#include <cmath>

namespace granulaw {

namespace {

template <class Error>
ErrorQuantiles quantiles(const std::vector<OrientationCheck>& checks, Error error)
{
  std::vector<double> errors;
  for (const OrientationCheck& check : checks)
    if (check.local == OrientationCheck::Local::curved) errors.push_back(std::abs(error(check)));
  if (errors.empty()) return {};
  std::sort(errors.begin(), errors.end());
  const auto at = [&](double share) {
    return errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1) + 0.5)];
  };
  return {at(0.5), at(0.95)};
}

}  // namespace

double OrientationCheck::local_radius() const
{
  return std::sqrt(sharper_radius * flatter_radius);
}

const char* name_of(OrientationCheck::Local local)
{
  switch (local) {
    case OrientationCheck::Local::edge:
      return "edge";
    case OrientationCheck::Local::flat:
      return "flat";
    case OrientationCheck::Local::beyond_law:
      return "beyond the law";
    default:
      return "curved";
  }
}

ErrorQuantiles ShapeCertificate::force(ContactAnswer OrientationCheck::* by) const
{
  return quantiles(checks, [&](const OrientationCheck& c) { return c.force_error(c.*by); });
}

ErrorQuantiles ShapeCertificate::restitution(ContactAnswer OrientationCheck::* by) const
{
  return quantiles(checks, [&](const OrientationCheck& c) { return c.restitution_error(c.*by); });
}

bool ShapeCertificate::has_body() const
{
  return std::all_of(checks.begin(), checks.end(), [](const OrientationCheck& c) { return c.height > 0; });
}

double ShapeCertificate::covered() const
{
  const auto answered = std::count_if(checks.begin(), checks.end(), [](const OrientationCheck& c) {
    return c.local == OrientationCheck::Local::curved;
  });
  return static_cast<double>(answered) / static_cast<double>(checks.size());
}

}  // namespace granulaw
