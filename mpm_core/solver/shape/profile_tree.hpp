#pragma once

#include <limits>
#include <vector>

#include "solver/shape/profile.hpp"

namespace granulaw {

/// Bounding boxes over runs of consecutive segments of a polyline, a binary heap: the distance to a polyline
/// of some thousand points in a few hundred nanoseconds.
class ProfileTree
{
 public:
  explicit ProfileTree(const std::vector<ProfilePoint>& points);

  /// Signed distance of (r >= 0, z), positive on the left of the curve: inside. Minus infinity if there is no
  /// segment.
  double depth(double r, double z) const;

 private:
  static constexpr std::size_t run_length = 8;
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  struct Segment
  {
    double r, z, dr, dz, inverse_length2;
  };
  struct Box
  {
    double r0 = infinity, r1 = -infinity, z0 = infinity, z1 = -infinity;
    void add(const ProfilePoint& p);
    void add(const Box& b);
    /// Squared distance; infinite from an empty box.
    double distance2(double r, double z) const;
  };
  /// The point of the polyline that is nearest to a place.
  struct Nearest
  {
    std::size_t segment;
    double t;          ///< along it, 0 to 1
    double distance2;  ///< squared
  };

  Nearest nearest(double r, double z) const;
  /// Improves `best` by the segments of one run.
  void search_run(std::size_t run, double r, double z, Nearest& best) const;
  /// Normal into the body at the nearest point; its length is of no meaning.
  ProfilePoint normal_at(const Nearest& point) const;
  ProfilePoint corner_normal(std::size_t k) const;

  std::vector<Segment> segments_;
  std::size_t leaves_ = 1;
  std::vector<Box> boxes_;  ///< [1]: all; [n]'s halves: [2n], [2n + 1]; from [leaves_] on: runs
};

}  // namespace granulaw
