#include "solver/shape/revolved.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/gauss.hpp"
#include "solver/shape/box_tree.hpp"
#include "solver/shape/shapes.hpp"

namespace granulaw {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool nearer_to_axis(const ProfilePoint& a, const ProfilePoint& b)
{
  return a.r < b.r;
}

}  // namespace

/// Signed distance to the segments of a polyline.
class Profile::Segments
{
 public:
  explicit Segments(const std::vector<ProfilePoint>& points)
  {
    std::vector<BoxTree::Box> boxes;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      const ProfilePoint a = points[k], b = points[k + 1];
      const double dr = b.r - a.r, dz = b.z - a.z;
      segments_.push_back({a.r, a.z, dr, dz, 1 / (dr * dr + dz * dz)});
      const Vector3 p(a.r, a.z, 0), q(b.r, b.z, 0);
      boxes.push_back({p.cwiseMin(q), p.cwiseMax(q)});
    }
    tree_ = BoxTree(boxes, true);
  }

  /// Depth of (r >= 0, z), positive on the left of the curve: inside. Minus infinity if there is no segment.
  double depth(double r, double z) const
  {
    if (segments_.empty()) return -infinity;
    std::size_t nearest = 0;
    double along = 0, least = infinity;  // along the nearest, 0 to 1
    tree_.search({r, z, 0}, least, [&](int k) {
      const Segment& s = segments_[k];
      const double t = std::clamp(((r - s.r) * s.dr + (z - s.z) * s.dz) * s.inverse_length2, 0.0, 1.0);
      const double er = r - s.r - t * s.dr, ez = z - s.z - t * s.dz;
      const double distance2 = er * er + ez * ez;
      if (distance2 < least) nearest = k, along = t, least = distance2;
    });
    const Segment& s = segments_[nearest];
    const double er = r - s.r - along * s.dr, ez = z - s.z - along * s.dz;
    const ProfilePoint inward = along == 0   ? corner_normal(nearest)
                                : along == 1 ? corner_normal(nearest + 1)
                                             : ProfilePoint{-s.dz, s.dr};
    return std::copysign(std::sqrt(least), inward.r * er + inward.z * ez);
  }

 private:
  struct Segment
  {
    double r, z, dr, dz, inverse_length2;
  };

  /// Normal into the body at point k; its length is of no meaning. There neither neighbour alone gives the
  /// side; the sum of their unit normals does. On the axis the neighbour is the mirror image.
  ProfilePoint corner_normal(std::size_t k) const
  {
    if (k == 0) return {0, 1};
    if (k == segments_.size()) return {0, -1};
    ProfilePoint normal{0, 0};
    for (const Segment& s : {segments_[k - 1], segments_[k]}) {
      const double scale = std::sqrt(s.inverse_length2);
      normal.r -= scale * s.dz;
      normal.z += scale * s.dr;
    }
    return normal;
  }

  std::vector<Segment> segments_;
  BoxTree tree_;
};

Profile::Profile(std::vector<ProfilePoint> points)
{
  if (points.empty()) return;
  const auto widest = std::max_element(points.begin(), points.end(), nearer_to_axis);
  widest_ = static_cast<std::size_t>(widest - points.begin());
  rising_ = std::is_sorted(points.begin(), widest + 1, nearer_to_axis);
  segments_ = std::make_shared<const Segments>(points);
  points_ = std::make_shared<const std::vector<ProfilePoint>>(std::move(points));
}

double Profile::depth(double r, double z) const
{
  return segments_->depth(r, z);
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

namespace {

bool is_mirrored(const Profile& profile)
{
  const double rounding = 1e-9 * profile.height();
  return std::all_of(profile.begin(), profile.end(), [&](const ProfilePoint& p) {
    return std::abs(profile.depth(p.r, profile.height() - p.z)) <= rounding;
  });
}

double radius_of(double curvature)
{
  return curvature == 0 ? infinity : 1 / curvature;
}

/// The body of revolution of a meridian curve about the z axis, with the middle of its height in the origin:
/// its contact pole is (0, 0, -height/2). Polyline as it is: smooth shapes are sampled finely (shapes.hpp).
class Revolved : public Shape
{
 public:
  Revolved(Profile profile) : profile_(std::move(profile)), mirrored_(is_mirrored(profile_)) {}

  /// the distance itself, everywhere
  double depth(const Vector3& x) const override
  {
    return profile_.depth(std::hypot(x.x(), x.y()), x.z() + 0.5 * profile_.height());
  }
  Vector3 outward_normal(const Vector3& x) const override
  {
    const double r = std::hypot(x.x(), x.y()), z = x.z() + 0.5 * profile_.height();
    const double step = 1e-6 * profile_.height();
    // The depth is even in r.
    const double along_r = profile_.depth(std::abs(r - step), z) - profile_.depth(r + step, z);
    const double along_z = profile_.depth(r, z - step) - profile_.depth(r, z + step);
    const Vector3 outward = r > 0 ? Vector3(x.x() / r, x.y() / r, 0) : Vector3(1, 0, 0);
    const Vector3 normal = along_r * outward + along_z * Vector3::UnitZ();
    return normal.norm() > 0 ? Vector3(normal.normalized()) : Vector3::UnitZ();
  }
  double support(const Vector3& direction, Vector3* where) const override
  {
    const double n_r = std::hypot(direction.x(), direction.y());
    const ProfilePoint p = profile_[farthest(n_r, direction.z())];
    const double z = p.z - 0.5 * profile_.height();
    if (where) {
      const Vector3 outward =
          n_r > 0 ? Vector3(direction.x() / n_r, direction.y() / n_r, 0) : Vector3(1, 0, 0);
      *where = p.r * outward + z * Vector3::UnitZ();
    }
    return n_r * p.r + direction.z() * z;
  }
  /// Along the meridian: of the circle through a point of the profile and its neighbours, so that an edge has
  /// about the length of its segments. Around the axis: the distance to the axis along the normal (Meusnier).
  PrincipalRadii principal_radii(const Vector3& direction) const override
  {
    const double n_r = std::hypot(direction.x(), direction.y());
    const std::size_t k = farthest(n_r, direction.z());
    const double meridian = radius_of(meridian_curvature(k)), r = profile_[k].r;
    if (r == 0) return {meridian, meridian, direction.unitOrthogonal()};
    const Vector3 around = n_r > 0 ? Vector3(-direction.y() / n_r, direction.x() / n_r, 0) : Vector3(0, 1, 0);
    const double hoop = n_r > 0 ? r / n_r : infinity;
    if (hoop < meridian) return {hoop, meridian, around};
    return {meridian, hoop, around.cross(direction)};
  }
  double finest_radius() const override
  {
    double least = infinity;
    for (std::size_t k = 0; k < profile_.size(); ++k) {
      const double curvature = meridian_curvature(k);
      if (curvature > 0) least = std::min(least, 1 / curvature);
    }
    return least;
  }
  std::array<bool, 3> symmetric() const override { return {true, true, mirrored_}; }
  MassProperties mass_properties() const override
  {
    // Discs of radius r(z), linear over a segment: the integrands are polynomials of degree 4 at most.
    double volume = 0, first = 0, axial = 0, across = 0;
    for (std::size_t k = 0; k + 1 < profile_.size(); ++k) {
      const ProfilePoint a = profile_[k], b = profile_[k + 1];
      const auto integrate = [&](const auto& f) {
        return std::numbers::pi * (b.z - a.z) * gauss<4>(0, 1, [&](double t) {
                 return f(a.r + t * (b.r - a.r), a.z + t * (b.z - a.z) - 0.5 * profile_.height());
               });
      };
      volume += integrate([](double r, double) { return r * r; });
      first += integrate([](double r, double z) { return r * r * z; });
      axial += integrate([](double r, double) { return r * r * r * r / 2; });
      across += integrate([](double r, double z) { return r * r * (r * r / 4 + z * z); });
    }
    const double middle = first / volume;
    across -= volume * middle * middle;
    return {volume, {0, 0, middle}, Vector3(across, across, axial).asDiagonal()};
  }
  const char* kind() const override { return "profile"; }
  std::string definition() const override
  {
    std::string text = kind();
    for (const ProfilePoint& p : profile_) text += fmt::format(" {},{}", p.r, p.z);
    return text;
  }

 private:
  /// The point of the profile that reaches farthest along (n_r, n_z).
  std::size_t farthest(double n_r, double n_z) const
  {
    const auto reach = [&](const ProfilePoint& p) { return n_r * p.r + n_z * p.z; };
    const auto best =
        std::max_element(profile_.begin(), profile_.end(),
                         [&](const ProfilePoint& a, const ProfilePoint& b) { return reach(a) < reach(b); });
    return static_cast<std::size_t>(best - profile_.begin());
  }
  /// 1/m, positive: convex
  double meridian_curvature(std::size_t k) const
  {
    const std::size_t last = profile_.size() - 1;
    const ProfilePoint b = profile_[k];
    const ProfilePoint a = k > 0 ? profile_[k - 1] : ProfilePoint{-profile_[1].r, profile_[1].z};
    const ProfilePoint c =
        k < last ? profile_[k + 1] : ProfilePoint{-profile_[last - 1].r, profile_[last - 1].z};
    const double turn = (b.r - a.r) * (c.z - b.z) - (b.z - a.z) * (c.r - b.r);
    return 2 * turn /
           (std::hypot(b.r - a.r, b.z - a.z) * std::hypot(c.r - b.r, c.z - b.z) *
            std::hypot(c.r - a.r, c.z - a.z));
  }

  Profile profile_;
  bool mirrored_;  // about z = 0
};

}  // namespace

SharedShape revolved_shape(Profile profile)
{
  return std::make_shared<Revolved>(std::move(profile));
}

}  // namespace granulaw
