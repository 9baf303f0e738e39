#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "linear/linear.hpp"
#include "solver/shape/curvature.hpp"
#include "solver/shape/shapes.hpp"

namespace granulaw {

namespace {

/// x^n. Whole exponents, as most decks have, by squaring: a tenth of pow()'s time.
double raised(double x, double n)
{
  int left = static_cast<int>(n);
  if (n < 0 || left != n) return std::pow(x, n);
  double result = 1;
  for (; left > 0; left >>= 1, x *= x)
    if (left & 1) result *= x;
  return result;
}

/// x^(1/n)
double root(double x, double n)
{
  return n == 2 ? std::sqrt(x) : n == 4 ? std::sqrt(std::sqrt(x)) : std::pow(x, 1 / n);
}

/// (x^n + y^n)^(1/n) of numbers that are not negative, without overflow.
double norm(double x, double y, double n)
{
  const double most = std::max(x, y);
  return most == 0 ? 0 : most * root(raised(x / most, n) + raised(y / most, n), n);
}

/// The fraction that x has of the norm, to the power n - 1: derivative of the norm.
double slope(double x, double whole, double n)
{
  return whole == 0 ? 0 : raised(x / whole, n - 1);
}

/// LIGGGHTS's superquadric about the origin (superquadric.cpp, shape_function_local): half axes a, b, c and
/// `blockiness` n1, n2, both 2 or more, so that it is convex:
///
///     (|x/a|^n2 + |y/b|^n2)^(n1/n2) + |z/c|^n1 = 1
///
/// The depth is the distance to the surface point found by Newton's method from the nearest of the surface
/// points along the axes and the radius: the distance itself but for places deep inside, where it may be too
/// large.
class Superquadric : public Shape
{
 public:
  Superquadric(const Vector3& half_axes, double n1, double n2) : axes_(half_axes), n1_(n1), n2_(n2) {}

  double depth(const Vector3& x) const override
  {
    const Vector3 y = x.cwiseAbs();
    const double distance = (y - nearest_surface_point(y)).norm();
    return gauge(x) <= 1 ? distance : -distance;
  }
  Vector3 outward_normal(const Vector3& x) const override
  {
    Vector3 gradient;
    Eigen::Matrix3d hessian;
    derivatives(nearest_surface_point(x.cwiseAbs()), gradient, hessian);
    for (int k = 0; k < 3; ++k) gradient[k] = std::copysign(gradient[k], x[k]);
    return gradient.normalized();
  }
  /// The support function is the dual norm, of the exponents n/(n - 1); its gradient is the support point.
  double support(const Vector3& direction, Vector3* where) const override
  {
    const double m1 = n1_ / (n1_ - 1), m2 = n2_ / (n2_ - 1);
    const Vector3 d = direction.cwiseAbs().cwiseProduct(axes_);
    const double in_plane = norm(d.x(), d.y(), m2), reach = norm(in_plane, d.z(), m1);
    if (where) {
      const double rho = slope(in_plane, reach, m1);
      const Vector3 u(rho * slope(d.x(), in_plane, m2), rho * slope(d.y(), in_plane, m2),
                      slope(d.z(), reach, m1));
      for (int k = 0; k < 3; ++k) (*where)[k] = std::copysign(u[k] * axes_[k], direction[k]);
    }
    return reach;
  }
  PrincipalRadii principal_radii(const Vector3& direction) const override
  {
    Vector3 where, gradient;
    Eigen::Matrix3d hessian;
    support(direction, &where);
    derivatives(where.cwiseAbs(), gradient, hessian);
    for (int k = 0; k < 3; ++k) {
      const double side = std::copysign(1.0, where[k]);
      gradient[k] *= side;
      hessian.row(k) *= side;
      hessian.col(k) *= side;
    }
    return radii_of_level_set(gradient, hessian);
  }
  double finest_radius() const override
  {
    // By directions of the normal, of which an edge takes most; ever nearer to the best one.
    constexpr int steps = 32;
    constexpr double quarter = std::numbers::pi / 2;
    double best = std::numeric_limits<double>::infinity(), theta = quarter / 2, phi = quarter / 2;
    for (double width = quarter; width > 1e-3; width *= 0.2) {
      const double theta_0 = theta - width / 2, phi_0 = phi - width / 2;
      for (int i = 0; i <= steps; ++i)
        for (int j = 0; j <= steps; ++j) {
          const double t = std::clamp(theta_0 + width * i / steps, 0.0, quarter);
          const double f = std::clamp(phi_0 + width * j / steps, 0.0, quarter);
          const Vector3 n(std::sin(t) * std::cos(f), std::sin(t) * std::sin(f), std::cos(t));
          const double radius = principal_radii(n.cwiseMax(0.0)).sharper;
          if (radius < best) best = radius, theta = t, phi = f;
        }
    }
    return best;
  }
  std::array<bool, 3> symmetric() const override { return {true, true, true}; }
  /// LIGGGHTS's formulas (math_extra_liggghts_superquadric.cpp), after Jaklic, Leonardis and Solina (2000).
  MassProperties mass_properties() const override
  {
    const double e1 = 2 / n1_, e2 = 2 / n2_;
    const double volume =
        2 * axes_.prod() * e1 * e2 * std::beta(0.5 * e1, e1 + 1) * std::beta(0.5 * e2, 0.5 * e2 + 1);
    const double half = 0.5 * axes_.prod() * e1 * e2;
    const double in_plane = half * std::beta(1.5 * e2, 0.5 * e2) * std::beta(0.5 * e1, 2 * e1 + 1);
    const double along = half * 4 * std::beta(0.5 * e2, 0.5 * e2 + 1) * std::beta(1.5 * e1, e1 + 1);
    const Vector3 squares = axes_.cwiseAbs2();
    const double xx = in_plane * squares.x(), yy = in_plane * squares.y(), zz = along * squares.z();
    return {volume, Vector3::Zero(), Vector3(yy + zz, xx + zz, xx + yy).asDiagonal()};
  }
  const char* kind() const override { return "superquadric"; }
  std::string definition() const override
  {
    return fmt::format("superquadric {} {} {}, {} {}", axes_.x(), axes_.y(), axes_.z(), n1_, n2_);
  }

 private:
  /// The shape function to the power 1/n1, a norm: 1 on the surface, t at t times a surface point.
  double gauge(const Vector3& x) const
  {
    const Vector3 u = x.cwiseAbs().cwiseQuotient(axes_);
    return norm(norm(u.x(), u.y(), n2_), u.z(), n1_);
  }
  /// Gradient and Hessian of the shape function; x in the positive octant.
  void derivatives(const Vector3& x, Vector3& gradient, Eigen::Matrix3d& hessian) const
  {
    const Vector3 u = x.cwiseQuotient(axes_);
    const double rho = norm(u.x(), u.y(), n2_);
    // On the z axis, where n1 = 2 < n2 makes the curvature depend on the direction: that of the diagonal.
    const double even = root(0.5, n2_);
    const double share[2] = {rho > 0 ? u.x() / rho : even, rho > 0 ? u.y() / rho : even};
    const double first = n1_ * raised(rho, n1_ - 1), second = n1_ * raised(rho, n1_ - 2);
    hessian.setZero();
    double power[2];  // share^(n2 - 1)
    for (int k = 0; k < 2; ++k) {
      const double low = raised(share[k], n2_ - 2);
      power[k] = low * share[k];
      gradient[k] = first * power[k];
      hessian(k, k) = second * ((n1_ - n2_) * power[k] * power[k] + (n2_ - 1) * low);
    }
    hessian(0, 1) = hessian(1, 0) = second * (n1_ - n2_) * power[0] * power[1];
    const double low = raised(u.z(), n1_ - 2);
    gradient[2] = n1_ * low * u.z();
    hessian(2, 2) = n1_ * (n1_ - 1) * low;
    gradient = gradient.cwiseQuotient(axes_);
    const Vector3 inverse = axes_.cwiseInverse();
    hessian = inverse.asDiagonal() * hessian * inverse.asDiagonal();
  }
  /// The nearest of the surface points on the ray through x and on the lines through x along the axes.
  Vector3 nearest_of_starts(const Vector3& x) const
  {
    const double level = gauge(x);
    Vector3 best = level > 0 ? Vector3(x / level) : Vector3(0, 0, axes_.z());
    if (!(level < 1)) return best;
    const Vector3 u = x.cwiseQuotient(axes_);
    const double in_plane = raised(std::max(0.0, 1 - raised(u.z(), n1_)), n2_ / n1_);
    for (int k = 0; k < 3; ++k) {
      Vector3 candidate = x;
      candidate[k] = axes_[k] * (k == 2 ? root(std::max(0.0, 1 - raised(norm(u.x(), u.y(), n2_), n1_)), n1_)
                                        : root(std::max(0.0, in_plane - raised(u[1 - k], n2_)), n2_));
      if ((candidate - x).norm() < (best - x).norm()) best = candidate;
    }
    return best;
  }
  /// x in the positive octant
  /// Newton's method for the least distance along the surface. At the surface point p with normal N and
  /// curvature C (1/m) in the tangent frame T, the squared distance of x to the surface about p is to second
  /// order |w|^2 - 2 b.s + s.(I + (w.N) C) s, where w = x - p, b = T^t w and s are tangential coordinates.
  Vector3 nearest_surface_point(const Vector3& x) const
  {
    Vector3 p = nearest_of_starts(x), gradient;
    Eigen::Matrix3d hessian;
    double distance = (x - p).norm();
    for (int iteration = 0; iteration < 50; ++iteration) {
      derivatives(p, gradient, hessian);
      const double slope = gradient.norm();
      const Vector3 normal = gradient / slope, w = x - p;
      const Eigen::Matrix<double, 3, 2> frame = tangents(normal);
      const Eigen::Vector2d b = frame.transpose() * w;
      // The distance's error is b^2 over the distance: rounding.
      if (b.norm() < 1e-8 * distance + 1e-15 * axes_.maxCoeff()) break;
      const Eigen::Matrix2d second =
          Eigen::Matrix2d::Identity() + w.dot(normal) / slope * (frame.transpose() * hessian * frame).eval();
      const PlaneModes modes = symmetric_modes(second);
      const Eigen::Vector2d stiffness = modes.values.cwiseAbs().cwiseMax(0.05);  // downhill always
      Eigen::Vector2d step = modes.vectors * (modes.vectors.transpose() * b).cwiseQuotient(stiffness).eval();
      bool better = false;
      for (int halving = 0; halving < 30 && !better; ++halving, step *= 0.5) {
        const Vector3 trial = (p + frame * step).cwiseMax(0.0);
        const Vector3 on_surface = trial / gauge(trial);
        const double at_trial = (x - on_surface).norm();
        better = at_trial < distance;
        if (better) p = on_surface, distance = at_trial;
      }
      if (!better) break;
    }
    return p;
  }

  Vector3 axes_;    // m
  double n1_, n2_;  // along z; in x and y
};

}  // namespace

SharedShape superquadric_shape(const Vector3& half_axes, double n1, double n2)
{
  return std::make_shared<Superquadric>(half_axes, n1, n2);
}

ShapeKind superquadric_kind()
{
  const ShapeKey exponents{"exponents", "",
                           2,           20,
                           true,        ShapeKey::Form::numbers,
                           2,           "two numbers, LIGGGHTS's blockiness n1 and n2"};
  return {"superquadric", {ShapeKey::lengths("axes"), exponents}, [](const ShapeValues& v) {
            const std::vector<double>& n = v.numbers.at("exponents");
            return superquadric_shape(v.lengths("axes"), n[0], n[1]);
          }};
}

}  // namespace granulaw
