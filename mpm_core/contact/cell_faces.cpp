#include "contact/cell_faces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace granulaw {

namespace {

constexpr double parallel = 1e-9;  // sine of planes that have no common edge
constexpr double unknown = std::numeric_limits<double>::infinity();

}  // namespace

void CellFaces::set_directions(std::span<const Vector> normals)
{
  size_ = normals.size();
  normals_.assign(normals.begin(), normals.end());
  first_.resize(size_), second_.resize(size_), of_.resize(size_ * size_);
  for (std::size_t j = 0; j < size_; ++j) {
    const Vector& n = normals[j];
    Vector off{};
    off[std::abs(n[0]) < 0.6 ? 0 : std::abs(n[1]) < 0.6 ? 1 : 2] = 1.0;
    first_[j] = unit(sum(off, n, -dot(off, n)));
    second_[j] = cross(n, first_[j]);
    for (std::size_t i = 0; i < size_; ++i) {
      const double cosine = std::clamp(dot(n, normals[i]), -1.0, 1.0);
      of_[j * size_ + i] = {cosine, std::sqrt(std::max(0.0, 1.0 - cosine * cosine)), unknown};
    }
  }
}

double CellFaces::azimuth(std::size_t i, std::size_t j)
{
  double& azimuth = of_[j * size_ + i].azimuth;
  if (azimuth == unknown) azimuth = std::atan2(dot(normals_[i], second_[j]), dot(normals_[i], first_[j]));
  return azimuth;
}

/// The lines that cut the disc of plane j, radius `radius`; false: nothing is left of it.
bool CellFaces::cut_face(std::size_t j, std::span<const double> heights, double radius)
{
  edges_.clear(), intervals_.clear();
  for (std::size_t i = 0; i < size_; ++i) {
    const Other& other = of_[j * size_ + i];
    if (i == j || other.sine < parallel) continue;
    const double way = heights[i] - heights[j] * other.cosine, most = radius * other.sine;
    if (way >= most) continue;
    if (way <= -most) return false;
    const double distance = way / other.sine, half = std::acos(std::clamp(distance / radius, -1.0, 1.0)), at = azimuth(i, j);
    edges_.push_back({distance, std::sqrt(std::max(radius * radius - distance * distance, 0.0)), at - half, at + half, at});
  }
  return true;
}

/// Angle about the face's centre that the lines take from the circle.
double CellFaces::covered()
{
  for (const Edge& e : edges_) {
    Interval main{e.begin, e.end};
    if (main.begin < -M_PI) intervals_.push_back({main.begin + 2 * M_PI, M_PI}), main.begin = -M_PI;
    if (main.end > M_PI) intervals_.push_back({-M_PI, main.end - 2 * M_PI}), main.end = M_PI;
    intervals_.push_back(main);
  }
  std::sort(intervals_.begin(), intervals_.end(), [](const Interval& a, const Interval& b) { return a.begin < b.begin; });
  double all = 0, end = -M_PI;
  for (const Interval& one : intervals_) {
    const double begin = std::max(one.begin, end);
    if (one.end > begin) all += one.end - begin, end = one.end;
  }
  return all;
}

/// Of the face that edges_ cut: its solid angle about the ball's centre; adds its triangles to `area`.
double CellFaces::solid_angle_and_area(double height, double& area)
{
  double angle = 0;
  for (const Edge& e : edges_) {
    double from = -e.half_length, to = e.half_length;  // along the line, what the other lines leave of it
    for (const Edge& other : edges_) {
      if (&other == &e) continue;
      const double turn = other.azimuth - e.azimuth, sine = std::sin(turn), left = other.distance - e.distance * std::cos(turn);
      if (std::abs(sine) < 1e-12) {
        if (left < 0) to = from;
      } else if (sine > 0) {
        to = std::min(to, left / sine);
      } else {
        from = std::max(from, left / sine);
      }
      if (from >= to) break;
    }
    if (from >= to) continue;
    area += 0.5 * e.distance * (to - from);
    if (std::abs(e.distance) < 1e-12) continue;
    const auto of_triangle = [&](double t) {
      return std::atan(t / e.distance) - std::atan(height * t / (e.distance * std::sqrt(height * height + e.distance * e.distance + t * t)));
    };
    angle += of_triangle(to) - of_triangle(from);
  }
  return angle;
}

CellFaces::Sums CellFaces::cut(std::span<const double> heights, double radius, std::span<double> areas)
{
  double taken = 0, cones = 0;
  for (std::size_t j = 0; j < size_; ++j) {
    areas[j] = 0;
    const double d = heights[j], disc2 = radius * radius - d * d;
    if (!(disc2 > 0)) continue;
    const double disc = std::sqrt(disc2), cap = 1.0 - d / radius;
    if (!cut_face(j, heights, disc)) continue;
    const double arc = 2 * M_PI - covered();
    double area = 0.5 * disc2 * arc;
    const double angle = arc * cap + solid_angle_and_area(d, area);
    areas[j] = std::max(area, 0.0);
    taken += std::max(angle, 0.0), cones += areas[j] * d;
  }
  const double free = std::max(1.0 - taken / (4 * M_PI), 0.0);
  return {free, (cones + 4 * M_PI * free * radius * radius * radius) / 3.0};
}

}  // namespace granulaw
