#pragma once

#include <Eigen/Core>
#include <array>
#include <compare>
#include <span>
#include <vector>

#include "solver/body/motion.hpp"

namespace granulaw {

/// A box from 0 to `length` along each axis, with periodic sides or six walls; `rate`: of the lengths.
struct PackingBox
{
  Vector3 length, rate = Vector3::Zero();
  bool periodic = true;

  double volume() const { return length.prod(); }
  Vector3 shift(const std::array<int, 3>& image) const { return length.cwiseProduct(whole(image)); }
  Vector3 drift(const std::array<int, 3>& image) const { return rate.cwiseProduct(whole(image)); }

 private:
  static Vector3 whole(const std::array<int, 3>& image) { return Vector3(image[0], image[1], image[2]); }
};

/// Bodies a and b, a moved by `image` boxes, that are near each other. a < b, or an image of the body itself.
struct Neighbours
{
  int a, b;
  std::array<int, 3> image;
  auto operator<=>(const Neighbours&) const = default;
};

/// All pairs with centres nearer than the sum of their reaches and `margin`, in order. Centres may lie
/// outside of a periodic box.
std::vector<Neighbours> find_neighbours(std::span<const Vector3> centres, std::span<const double> reach,
                                        double margin, const PackingBox& box);

}  // namespace granulaw
