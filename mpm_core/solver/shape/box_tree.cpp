#include "solver/shape/box_tree.hpp"

#include <algorithm>
#include <numeric>

namespace granulaw {

void BoxTree::Box::add(const Box& other)
{
  low = low.cwiseMin(other.low);
  high = high.cwiseMax(other.high);
}

BoxTree::BoxTree(const std::vector<Box>& pieces, bool sorted) : order_(pieces.size())
{
  std::iota(order_.begin(), order_.end(), 0);
  while (leaves_ * run_length < pieces.size()) leaves_ *= 2;
  if (!sorted) sort(pieces, 0, pieces.size(), leaves_ * run_length);
  boxes_.resize(2 * leaves_);
  for (std::size_t k = 0; k < pieces.size(); ++k) boxes_[leaves_ + k / run_length].add(pieces[order_[k]]);
  for (std::size_t n = leaves_ - 1; n >= 1; --n) {
    boxes_[n] = boxes_[2 * n];
    boxes_[n].add(boxes_[2 * n + 1]);
  }
}

/// Halves those of one box, which has room for `span` pieces, along its longest side.
void BoxTree::sort(const std::vector<Box>& pieces, std::size_t begin, std::size_t end, std::size_t span)
{
  const std::size_t half = span / 2;
  if (half < run_length || end - begin <= run_length) return;
  if (end - begin <= half) return sort(pieces, begin, end, half);
  Box all;
  const auto middle_of = [&](int piece) { return Vector3(pieces[piece].low + pieces[piece].high); };
  for (std::size_t k = begin; k < end; ++k) all.add({middle_of(order_[k]), middle_of(order_[k])});
  int axis = 0;
  (all.high - all.low).maxCoeff(&axis);
  const auto first = order_.begin() + begin;
  std::nth_element(first, first + half, order_.begin() + end,
                   [&](int a, int b) { return middle_of(a)[axis] < middle_of(b)[axis]; });
  sort(pieces, begin, begin + half, half);
  sort(pieces, begin + half, end, half);
}

}  // namespace granulaw
