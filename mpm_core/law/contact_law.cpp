#include "law/contact_law.hpp"

#include <algorithm>
#include <cmath>

#include "base/gauss.hpp"
#include "law/rising_root.hpp"

namespace granulaw {

namespace {

/// Intervals of the work: those of the shape, in which its functions are smooth.
constexpr int intervals = LawShape::nodes - 1;

}  // namespace

double admissible_hertz_share(double wanted, const Curve::Top& top, double x, double stiffness)
{
  const double mean = top.kept * top.work / (top.force * x * top.span);
  const double least_exponent =
      std::max(UnloadingShape::least_exponent, top.span * x * stiffness / top.force);
  const double least = UnloadingShape::hertz_share_of(mean, least_exponent),
               most = UnloadingShape::largest_hertz_share_of(mean);
  return std::clamp(std::max(wanted, least), 0.0, std::clamp(most, 0.0, UnloadingShape::largest_hertz_share));
}

ContactLaw::ContactLaw(const LawShape& shape, double end)
    : onset_(shape.onset),
      end_(end),
      elastic_(shape.elastic),
      reduction_(shape.by_q(&LawShape::force_reduction)),
      widening_(shape.by_q(&LawShape::widening)),
      residual_(shape.by_q(&LawShape::residual)),
      dissipation_(shape.by_q(&LawShape::dissipation)),
      share_(shape.by_q(&LawShape::hertz_share))
{
  for (std::size_t j = 0; j < radii_.size(); ++j) radii_[j] = shape.by_q(LawShape::functions[LawShape::first_radius + j]);
  tabulate_work();
}

ContactLaw::ContactLaw(const ElasticCorrection& elastic, double end) : end_(end), elastic_(elastic)
{
  tabulate_work();
}

double ContactLaw::q(double x) const
{
  return 0.25 * std::log(x / onset_);
}

ContactLaw::Loading ContactLaw::loading(double x) const
{
  if (x > end_) return {last_.force + last_.stiffness * (x - end_), last_.stiffness, last_.radius, 0.0};
  return continued_loading(x);
}

ContactLaw::Loading ContactLaw::continued_loading(double x) const
{
  const double s = std::pow(x, 0.25), ratio = elastic_.force_ratio(s),
               radius_ratio = elastic_.radius_ratio(s);
  double force = x * s * s * ratio, radius = s * s * radius_ratio;
  // by ln s
  double force_slope = 6 + s * elastic_.force_ratio_slope(s) / ratio,
         radius_slope = 2 + s * elastic_.radius_ratio_slope(s) / radius_ratio;
  if (x > onset_) {
    const double at = q(x);
    force *= std::exp(-reduction_.value(at)), radius *= std::exp(widening_.value(at));
    force_slope -= reduction_.slope(at), radius_slope += widening_.slope(at);
  }
  const double per_x = x > 0 ? 0.25 / x : 0.0;
  return {force, force * force_slope * per_x, radius, radius * radius_slope * per_x};
}

ContactLaw::Losses ContactLaw::continued_losses(double x) const
{
  const double s = std::pow(x, 0.25), at = q(x), per_q = 0.25 / x;
  const double kept = std::exp(-dissipation_.value(at)), span = std::exp(-residual_.value(at)),
               share = elastic_.unloading(s).hertz_share;
  return {kept,
          -kept * dissipation_.slope(at) * per_q,
          span,
          -span * residual_.slope(at) * per_q,
          share + share_.value(at),
          per_q * (share_.slope(at) - share * share * s * elastic_.force_ratio_slope(s)),
          unloading_radius(x)};
}

std::array<double, 3> ContactLaw::unloading_radius(double x) const
{
  const double s = std::pow(x, 0.25), at = x > onset_ ? q(x) : 0.0;
  std::array<double, 3> k;
  for (std::size_t j = 0; j < k.size(); ++j)
    k[j] = std::clamp(elastic_.unloading_radius(s, static_cast<double>(j) / 3) + radii_[j].value(at),
                      UnloadingRadius::least, UnloadingRadius::most);
  return k;
}

Curve::Top ContactLaw::top(double x) const
{
  const Loading now = loading(x);
  if (!(x > onset_))  // it unloads as it loads
    return {now.force, work(x), 1.0, 1.0, elastic_.unloading(std::pow(x, 0.25)).hertz_share};
  const Losses lost = continued_losses(std::min(x, end_));
  Curve::Top top{now.force, work(x), lost.kept, lost.span, lost.share};
  top.share = admissible_hertz_share(lost.share, top, x, now.stiffness);
  return top;
}

/// By 4 x^(3/4) dx^(1/4), in which the integrand is a polynomial where the correction is one.
double ContactLaw::work_within(double x) const
{
  const double s_end = std::pow(x, 0.25);
  const int parts = elastic_.measured ? 24 : 1;  // as many as the measured part has intervals
  double sum = 0;
  for (int k = 0; k < parts; ++k)
    sum += gauss<7>(s_end * k / parts, s_end * (k + 1) / parts, [&](double s) {
      const double s3 = s * s * s;
      return 4 * s3 * s3 * s3 * elastic_.force_ratio(s);
    });
  return sum;
}

void ContactLaw::tabulate_work()
{
  const double first = std::min(onset_, end_);
  double work = work_within(first);
  if (onset_ < end_) {
    const double spacing = q(end_) / intervals;
    const auto x_at = [&](double at) { return onset_ * std::exp(4 * at); };
    for (int k = 0; k <= intervals; ++k) {
      const double at = spacing * k, x = x_at(at);
      if (k > 0)
        work += gauss<4>(at - spacing, at, [&](double to) {
          const double here = x_at(to);
          return 4 * here * continued_loading(here).force;
        });
      log_work_.add(std::log(work), 4 * x * continued_loading(x).force / work);
    }
  }
  last_work_ = work;
  last_ = continued_loading(end_);
}

double ContactLaw::work(double x) const
{
  if (x > end_) return last_work_ + (x - end_) * (last_.force + 0.5 * (x - end_) * last_.stiffness);
  if (!(x > onset_)) return work_within(x);
  const double spacing = q(end_) / intervals, place = q(x) / spacing;
  const auto k = std::min(static_cast<std::size_t>(place), log_work_.size() - 2);
  double c[4];
  hermite(c, log_work_.value[k], log_work_.value[k + 1], spacing * log_work_.slope[k],
          spacing * log_work_.slope[k + 1]);
  return std::exp(cubic(c, place - static_cast<double>(k)));
}

double ContactLaw::overlap_at_work(double wanted) const
{
  constexpr double beyond = 4;  // the law goes on past its end
  return rising_root([&](double x) { return work(x) - wanted; }, 0.0, beyond, 48);
}

}  // namespace granulaw
