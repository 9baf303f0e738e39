#pragma once

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "solver/shape/shape.hpp"

namespace granulaw {

/// Bounding boxes over runs of the pieces of a surface, a binary heap: the nearest of some thousand pieces in
/// a few hundred nanoseconds.
class BoxTree
{
 public:
  struct Box
  {
    Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    void add(const Box& other);
    /// Squared distance; infinite from an empty box.
    double distance2(const Vector3& x) const
    {
      return (low - x).cwiseMax(x - high).cwiseMax(0.0).squaredNorm();
    }
  };

  BoxTree() = default;  ///< no pieces
  /// The number of a piece is its place in the list. `sorted`: neighbours in the list lie beside each other,
  /// as along a curve.
  BoxTree(const std::vector<Box>& pieces, bool sorted);

  /// Calls visit(piece) for all that can lie nearer to x than sqrt(least); visit may lower `least`.
  template <class Visit>
  void search(const Vector3& x, const double& least, const Visit& visit) const;

 private:
  static constexpr std::size_t run_length = 8;
  void sort(const std::vector<Box>& pieces, std::size_t begin, std::size_t end, std::size_t span);

  std::vector<int> order_;  ///< of the pieces: the first 8 are the first run
  std::size_t leaves_ = 1;
  std::vector<Box> boxes_;  ///< [1]: all; [n]'s halves: [2n], [2n + 1]; from [leaves_] on: runs
};

/// Depth first, the nearer half first; a box that lies farther than the best so far is left out.
template <class Visit>
void BoxTree::search(const Vector3& x, const double& least, const Visit& visit) const
{
  struct Node
  {
    std::size_t number;
    double distance2;
  } stack[64];
  int top = 0;
  stack[top++] = {1, 0};
  while (top > 0) {
    const Node node = stack[--top];
    if (node.distance2 >= least) continue;
    if (node.number >= leaves_) {
      const std::size_t first = (node.number - leaves_) * run_length;
      for (std::size_t k = first; k < std::min(first + run_length, order_.size()); ++k) visit(order_[k]);
      continue;
    }
    Node near{2 * node.number, boxes_[2 * node.number].distance2(x)};
    Node far{near.number + 1, boxes_[near.number + 1].distance2(x)};
    if (far.distance2 < near.distance2) std::swap(near, far);
    stack[top++] = far;
    stack[top++] = near;
  }
}

}  // namespace granulaw
