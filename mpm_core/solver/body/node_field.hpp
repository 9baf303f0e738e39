#pragma once

#include <cstddef>
#include <new>
#include <vector>

#include "solver/material/parameter.hpp"

namespace granulaw {

/// Allocates whole cache lines, so that a vector register is loaded by one access.
template <class T>
struct CacheLineAllocator
{
  using value_type = T;
  static constexpr std::align_val_t line{64};

  CacheLineAllocator() = default;
  template <class Other>
  CacheLineAllocator(const CacheLineAllocator<Other>&)
  {
  }
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), line)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, line); }
  bool operator==(const CacheLineAllocator&) const { return true; }
};

template <class Real>
using AlignedVector = std::vector<Real, CacheLineAllocator<Real>>;

/// A vector at each node. Two dimensions: all r, then all z. Three: x, y, z and a zero of each node, so that
/// a node is one access.
struct NodeField
{
  AlignedVector<double> values;
  int nodes = 0;
  int components = 0;  ///< 2 or 3
  int per_node = 0, per_component = 0;

  void resize(int node_count, int component_count)
  {
    nodes = node_count, components = component_count;
    const bool flat = components == 2;
    per_node = flat ? 1 : 4, per_component = flat ? nodes : 1;
    values.assign(std::size_t(flat ? 2 : 4) * nodes, 0.0);
  }
  std::size_t at(int node, int c) const
  {
    return std::size_t(node) * per_node + std::size_t(c) * per_component;
  }
  double& operator()(int node, int c) { return values[at(node, c)]; }
  double operator()(int node, int c) const { return values[at(node, c)]; }
  /// Direction of a component in space: r is along x.
  int direction(int c) const { return components == 2 ? 2 * c : c; }
};

}  // namespace granulaw
