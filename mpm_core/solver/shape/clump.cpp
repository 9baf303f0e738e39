#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>

#include "base/error.hpp"
#include "solver/shape/shapes.hpp"

namespace granulaw {

namespace {

constexpr double full_turn = 2 * std::numbers::pi, rounding_of_balls = 1e-12;

bool contains(const ClumpBall& outer, const ClumpBall& inner)
{
  return (outer.centre - inner.centre).norm() + inner.radius <= outer.radius * (1 + rounding_of_balls);
}

/// The parts of [0, 2 pi] that the intervals leave; their begins lie in it, their ends up to 2 pi above it.
std::vector<std::pair<double, double>> gaps_between(std::vector<std::pair<double, double>> covered)
{
  for (std::size_t k = covered.size(); k-- > 0;)
    if (covered[k].second > full_turn) {
      covered.emplace_back(0, covered[k].second - full_turn);
      covered[k].second = full_turn;
    }
  std::sort(covered.begin(), covered.end());
  std::vector<std::pair<double, double>> gaps;
  double reached = 0;
  for (const auto& [from, to] : covered) {
    if (from > reached + rounding_of_balls) gaps.emplace_back(reached, from);
    reached = std::max(reached, to);
  }
  if (reached < full_turn - rounding_of_balls) gaps.emplace_back(reached, full_turn);
  return gaps;
}

/// Integrals over a body of 1, x and x x^t.
struct CutMoments
{
  double volume = 0;
  Vector3 first = Vector3::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();

  /// The column of cross-section `area` about (x, y) from z = a to b.
  void add_column(double x, double y, double a, double b, double area)
  {
    const double length = area * (b - a), z = area * (b * b - a * a) / 2,
                 zz = area * (b * b * b - a * a * a) / 3;
    volume += length;
    first += Vector3(x * length, y * length, z);
    second(0, 0) += x * x * length;
    second(0, 1) += x * y * length;
    second(1, 1) += y * y * length;
    second(0, 2) += x * z;
    second(1, 2) += y * z;
    second(2, 2) += zz;
  }
  MassProperties mass() const
  {
    return mass_of_moments(volume, first, second.selfadjointView<Eigen::Upper>());
  }
};

/// Adds the union of the intervals, which it sorts.
void add_intervals(CutMoments& moments, double x, double y, std::vector<std::pair<double, double>>& spans,
                   double area)
{
  std::sort(spans.begin(), spans.end());
  double reached = -std::numeric_limits<double>::infinity();
  for (const auto& [from, to] : spans) {
    if (to > reached) moments.add_column(x, y, std::max(from, reached), to, area);
    reached = std::max(reached, to);
  }
}

/// The union of overlapping balls: LIGGGHTS's multisphere.
class Clump : public Shape
{
 public:
  /// Balls inside others are left out. `where` leads the Error if there is no ball or the union falls apart.
  Clump(const std::vector<ClumpBall>& balls, const std::string& where)
  {
    if (balls.empty()) fail(where, "the clump has no spheres");
    for (std::size_t i = 0; i < balls.size(); ++i) {
      bool hidden = false;
      for (std::size_t j = 0; j < balls.size() && !hidden; ++j)
        hidden = j != i && contains(balls[j], balls[i]) && (!contains(balls[i], balls[j]) || j < i);
      if (!hidden) balls_.push_back(balls[i]);
    }
    for (const ClumpBall& ball : balls_) size_ = std::max(size_, ball.radius);
    check_connected(where);
    std::vector<bool> meets(balls_.size()), shows(balls_.size());
    for (std::size_t i = 0; i < balls_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const std::size_t before = grooves_.size();
        const double distance = (balls_[i].centre - balls_[j].centre).norm();
        if (distance >= balls_[i].radius + balls_[j].radius) continue;
        meets[i] = meets[j] = true;
        add_groove(i, j);
        if (grooves_.size() > before) shows[i] = shows[j] = true;
      }
    finest_ = size_;
    for (std::size_t i = 0; i < balls_.size(); ++i)
      if (shows[i] || !meets[i]) finest_ = std::min(finest_, balls_[i].radius);
  }

  /// the distance itself, everywhere
  double depth(const Vector3& x) const override
  {
    const ClumpBall& ball = balls_[nearest_ball(x)];
    const double from_ball = ball.radius - (x - ball.centre).norm();
    return from_ball < 0 ? from_ball : nearest_from_inside(x).distance;
  }
  Vector3 outward_normal(const Vector3& x) const override
  {
    const Vector3 out = x - balls_[nearest_ball(x)].centre;
    return depth(x) > rounding_of_balls * size_ || out.isZero(0) ? nearest_from_inside(x).outward
                                                        : Vector3(out.normalized());
  }
  double support(const Vector3& direction, Vector3* where) const override
  {
    double reach = -std::numeric_limits<double>::infinity();
    for (const ClumpBall& ball : balls_) {
      const double candidate = direction.dot(ball.centre) + ball.radius;
      if (candidate <= reach) continue;
      reach = candidate;
      if (where) *where = ball.centre + ball.radius * direction;
    }
    return reach;
  }
  PrincipalRadii principal_radii(const Vector3& direction) const override
  {
    Vector3 where = Vector3::Zero();
    support(direction, &where);
    double radius = size_;
    for (const ClumpBall& ball : balls_)
      if ((where - ball.centre - ball.radius * direction).norm() <= rounding_of_balls * size_) radius = ball.radius;
    return {radius, radius, direction.unitOrthogonal()};
  }
  double finest_radius() const override { return finest_; }
  std::array<bool, 3> symmetric() const override
  {
    const auto has_mirror_image = [&](const ClumpBall& ball, int axis) {
      Vector3 image = ball.centre;
      image[axis] = -image[axis];
      return std::any_of(balls_.begin(), balls_.end(), [&](const ClumpBall& other) {
        return (other.centre - image).norm() <= 1e-9 * size_ &&
               std::abs(other.radius - ball.radius) <= 1e-9 * size_;
      });
    };
    std::array<bool, 3> planes;
    for (int axis = 0; axis < 3; ++axis)
      planes[axis] = std::all_of(balls_.begin(), balls_.end(),
                                 [&](const ClumpBall& ball) { return has_mirror_image(ball, axis); });
    return planes;
  }
  /// Columns along z, each exactly the union of its intervals; the cross-section by midpoints. The error
  /// falls with the columns' width to the power 3/2: about 1e-5 of the volume with these.
  MassProperties mass_properties() const override
  {
    constexpr int columns = 500;
    Vector3 low, high;
    bounds(low, high);
    const double dx = (high.x() - low.x()) / columns, dy = (high.y() - low.y()) / columns;
    CutMoments moments;
    std::vector<std::pair<double, double>> spans;
    for (int i = 0; i < columns; ++i)
      for (int j = 0; j < columns; ++j) {
        const double x = low.x() + (i + 0.5) * dx, y = low.y() + (j + 0.5) * dy;
        spans.clear();
        for (const ClumpBall& ball : balls_) {
          const double u = x - ball.centre.x(), v = y - ball.centre.y();
          const double half2 = ball.radius * ball.radius - u * u - v * v;
          if (half2 > 0)
            spans.emplace_back(ball.centre.z() - std::sqrt(half2), ball.centre.z() + std::sqrt(half2));
        }
        add_intervals(moments, x, y, spans, dx * dy);
      }
    return moments.mass();
  }
  const char* kind() const override { return "clump"; }
  const std::vector<ClumpBall>& balls() const { return balls_; }
  std::string definition() const override
  {
    std::string text = kind();
    for (const ClumpBall& ball : balls_)
      text += fmt::format(" {},{},{},{}", ball.centre.x(), ball.centre.y(), ball.centre.z(), ball.radius);
    return text;
  }

 private:
  /// Circle in which the surfaces of two balls meet: centre + radius (cos(angle) along + sin(angle) across),
  /// on the surface of the union for the angles of `exposed`, pairs (from, to).
  struct Groove
  {
    Vector3 centre, along, across;
    double radius;
    std::vector<std::pair<double, double>> exposed;
  };
  struct Nearest
  {
    double distance;
    Vector3 outward;  // from the place to the surface, length 1
  };

  void add_groove(std::size_t i, std::size_t j)
  {
    const ClumpBall &a = balls_[i], &b = balls_[j];
    const double distance = (b.centre - a.centre).norm();
    const Vector3 axis = (b.centre - a.centre) / distance;
    const double to_plane =
        (distance * distance + a.radius * a.radius - b.radius * b.radius) / (2 * distance);
    Groove groove;
    groove.centre = a.centre + to_plane * axis;
    groove.radius = std::sqrt(std::max(0.0, a.radius * a.radius - to_plane * to_plane));
    groove.along = axis.unitOrthogonal();
    groove.across = axis.cross(groove.along);
    std::vector<std::pair<double, double>> covered;
    for (std::size_t k = 0; k < balls_.size(); ++k) {
      if (k == i || k == j) continue;
      // Inside ball k: |q|^2 + R^2 - 2 R |q'| cos(angle - middle) < r_k^2, q from the circle's centre, q' in
      // its plane.
      const Vector3 q = balls_[k].centre - groove.centre;
      const double u = q.dot(groove.along), v = q.dot(groove.across);
      const double excess =
          q.squaredNorm() + groove.radius * groove.radius - balls_[k].radius * balls_[k].radius;
      const double cosine = excess / (2 * groove.radius * std::hypot(u, v));
      if (!(cosine < 1)) continue;
      if (cosine <= -1) return;
      const double half = std::acos(cosine), middle = std::atan2(v, u);
      const double from = std::fmod(middle - half + 2 * full_turn, full_turn);
      covered.emplace_back(from, from + 2 * half);
    }
    groove.exposed = gaps_between(std::move(covered));
    for (const auto& [from, to] : groove.exposed)
      for (const double angle : {from, to})
        corners_.push_back(groove.centre + groove.radius * (std::cos(angle) * groove.along +
                                                            std::sin(angle) * groove.across));
    if (!groove.exposed.empty()) grooves_.push_back(std::move(groove));
  }
  bool is_buried(const Vector3& point) const
  {
    return std::any_of(balls_.begin(), balls_.end(), [&](const ClumpBall& ball) {
      return (point - ball.centre).norm() < ball.radius - rounding_of_balls * size_;
    });
  }
  /// The surface point nearest to a place inside is the end of a radius of a ball that holds the place, or
  /// lies on a groove, or is a corner.
  Nearest nearest_from_inside(const Vector3& x) const
  {
    Nearest best{std::numeric_limits<double>::infinity(), Vector3::UnitZ()};
    for (const ClumpBall& ball : balls_) {
      const Vector3 out = x - ball.centre;
      const double from_centre = out.norm(), distance = ball.radius - from_centre;
      if (distance < 0 || distance >= best.distance) continue;
      const Vector3 outward = from_centre > 0 ? Vector3(out / from_centre) : Vector3::UnitZ();
      if (!is_buried(ball.centre + ball.radius * outward)) best = {distance, outward};
    }
    const auto improve = [&](const Vector3& point) {
      const double distance = (point - x).norm();
      if (distance < best.distance && distance > 0) best = {distance, (point - x) / distance};
    };
    for (const Groove& groove : grooves_) {
      const Vector3 q = x - groove.centre;
      const double u = q.dot(groove.along), v = q.dot(groove.across), in_plane = std::hypot(u, v);
      const double height2 = q.squaredNorm() - in_plane * in_plane, gap = in_plane - groove.radius;
      if (height2 + gap * gap >= best.distance * best.distance) continue;
      const double angle = std::fmod(std::atan2(v, u) + full_turn, full_turn);
      for (const auto& [from, to] : groove.exposed)
        if (angle >= from && angle <= to)
          improve(groove.centre +
                  groove.radius * (std::cos(angle) * groove.along + std::sin(angle) * groove.across));
    }
    for (const Vector3& corner : corners_) improve(corner);
    return best;
  }
  std::size_t nearest_ball(const Vector3& x) const
  {
    std::size_t best = 0;
    double deepest = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < balls_.size(); ++k) {
      const double d = balls_[k].radius - (x - balls_[k].centre).norm();
      if (d > deepest) deepest = d, best = k;
    }
    return best;
  }
  void check_connected(const std::string& where) const
  {
    std::vector<std::size_t> reached{0};
    std::vector<bool> is_reached(balls_.size());
    is_reached[0] = true;
    for (std::size_t k = 0; k < reached.size(); ++k)
      for (std::size_t j = 0; j < balls_.size(); ++j) {
        const ClumpBall &a = balls_[reached[k]], &b = balls_[j];
        if (is_reached[j] || (a.centre - b.centre).norm() >= a.radius + b.radius) continue;
        is_reached[j] = true;
        reached.push_back(j);
      }
    if (reached.size() == balls_.size()) return;
    const auto alone = std::find(is_reached.begin(), is_reached.end(), false) - is_reached.begin();
    const ClumpBall& ball = balls_[static_cast<std::size_t>(alone)];
    fail(where, "the spheres of the clump do not hang together",
         fmt::format("no overlap with the sphere at ({:g}, {:g}, {:g}) m, r = {:g} m", ball.centre.x(),
                     ball.centre.y(), ball.centre.z(), ball.radius),
         "one body of overlapping spheres");
  }

  std::vector<ClumpBall> balls_;
  std::vector<Groove> grooves_;
  std::vector<Vector3> corners_;  // ends of exposed arcs: where three balls meet
  double size_ = 0;               // m, largest radius
  double finest_ = 0;
};

/// The ball of one line without its comment.
ClumpBall read_ball(const std::string& line, const std::string& where)
{
  std::istringstream words(line);
  ClumpBall ball{};
  std::string rest;
  if (!(words >> ball.centre[0] >> ball.centre[1] >> ball.centre[2] >> ball.radius) || words >> rest)
    fail(where, "is no sphere of a clump", cut(line), "four numbers: x y z r");
  if (!(ball.radius > 0 && std::isfinite(ball.radius) && ball.centre.allFinite()))
    fail(where, "is no sphere of a clump", cut(line), "finite numbers, and r over 0");
  return ball;
}

}  // namespace

std::vector<ClumpBall> balls_of(const Shape& shape)
{
  const auto* clump = dynamic_cast<const Clump*>(&shape);
  return clump ? clump->balls() : std::vector<ClumpBall>{};
}

SharedShape clump_shape(const std::vector<ClumpBall>& balls, const std::string& where)
{
  return std::make_shared<Clump>(balls, where);
}

std::vector<ClumpBall> read_clump(const std::string& path, double scale)
{
  std::error_code ignored;
  std::ifstream in(path);
  if (!in || !std::filesystem::is_regular_file(path, ignored)) fail(path, "the clump's file cannot be read");
  std::vector<ClumpBall> balls;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    line.resize(std::min(line.size(), line.find('#')));
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    ClumpBall ball = read_ball(line, fmt::format("{}:{}", path, number));
    ball.centre *= scale;
    ball.radius *= scale;
    balls.push_back(ball);
    if (balls.size() > 10000) fail(path, "the clump has too many spheres", "over 10000");
  }
  return balls;
}

ShapeKind clump_kind()
{
  return {"clump", {ShapeKey::file(), ShapeKey::scale()}, [](const ShapeValues& v) {
            return clump_shape(read_clump(v.path, v.scale()), v.path);
          }};
}

}  // namespace granulaw
