#include "solver/shape/profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "solver/shape/profile_tree.hpp"

namespace granulaw {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool nearer_to_axis(const ProfilePoint& a, const ProfilePoint& b)
{
  return a.r < b.r;
}

}  // namespace

Profile::Profile(std::vector<ProfilePoint> points)
{
  if (points.empty()) return;
  const auto widest = std::max_element(points.begin(), points.end(), nearer_to_axis);
  widest_ = static_cast<std::size_t>(widest - points.begin());
  rising_ = std::is_sorted(points.begin(), widest + 1, nearer_to_axis);
  tree_ = std::make_shared<const ProfileTree>(points);
  points_ = std::make_shared<const std::vector<ProfilePoint>>(std::move(points));
}

double Profile::depth(double r, double z) const
{
  return tree_->depth(r, z);
}

double Profile::surface_z(double r) const
{
  const ProfilePoint *first = begin(), *widest = first + widest_;
  if (r >= widest->r) return widest->z;
  const ProfilePoint* b = first + 1;
  if (rising_)
    b = std::max(b,
                 std::lower_bound(first, widest, r, [](const ProfilePoint& p, double x) { return p.r < x; }));
  double lowest = infinity;
  for (; b <= widest; ++b) {
    const ProfilePoint p = b[-1], q = *b;
    if (std::min(p.r, q.r) > r) {
      if (rising_) break;
      continue;
    }
    if (std::max(p.r, q.r) < r) continue;
    lowest = std::min(lowest, p.r == q.r ? std::min(p.z, q.z) : p.z + (q.z - p.z) * (r - p.r) / (q.r - p.r));
  }
  return lowest;
}

/// Frusta of cones.
double Profile::volume() const
{
  double sum = 0;
  for (std::size_t k = 0; k + 1 < size(); ++k) {
    const ProfilePoint a = (*this)[k], b = (*this)[k + 1];
    sum += (b.z - a.z) * (a.r * a.r + a.r * b.r + b.r * b.r);
  }
  return std::numbers::pi / 3 * sum;
}

namespace {

/// z = r^2/(2 R) + c r^4 by least squares through the points after the pole with r up to `reach`.
struct PoleFit
{
  int points;
  double radius;  ///< R
  double misfit;  ///< largest error of z over the highest z
};

PoleFit fit_pole(const Profile& profile, double reach)
{
  double s4 = 0, s6 = 0, s8 = 0, t2 = 0, t4 = 0;  // sums of powers of x = r/reach, without and with z
  const auto x2 = [&](std::size_t k) { return profile[k].r * profile[k].r / (reach * reach); };
  std::size_t end = 1;
  for (; end < profile.size() && profile[end].r <= reach && profile[end].r > profile[end - 1].r; ++end) {
    const double x = x2(end), z = profile[end].z;
    s4 += x * x, s6 += x * x * x, s8 += x * x * x * x;
    t2 += x * z, t4 += x * x * z;
  }
  const double determinant = s4 * s8 - s6 * s6;
  const double a = (t2 * s8 - t4 * s6) / determinant, b = (t4 * s4 - t2 * s6) / determinant;
  double worst = 0, highest = 0;
  for (std::size_t k = 1; k < end; ++k) {
    worst = std::max(worst, std::abs(a * x2(k) + b * x2(k) * x2(k) - profile[k].z));
    highest = std::max(highest, profile[k].z);
  }
  return {static_cast<int>(end) - 1, reach * reach / (2 * a), worst / highest};
}

}  // namespace

double Profile::pole_curvature_radius(double reach) const
{
  const ProfilePoint first = (*this)[1];
  if (first.z == 0) return infinity;
  // Clean curves meet the first limit on misfit; measured outlines may need a later one.
  for (const double misfit : {1e-4, 1e-3, 1e-2, 1e-1})
    for (double end = reach;; end *= 0.8) {
      const PoleFit fit = fit_pole(*this, end);
      if (fit.points < 3) break;
      if (fit.misfit <= misfit && fit.radius > 0) return fit.radius;
    }
  return (first.r * first.r + first.z * first.z) / (2 * first.z);
}

Profile Profile::scaled(double factor) const
{
  std::vector<ProfilePoint> points(begin(), end());
  for (ProfilePoint& p : points) p.r *= factor, p.z *= factor;
  return points;
}

}  // namespace granulaw
