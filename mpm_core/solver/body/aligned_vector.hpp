#pragma once

#include <cstddef>
#include <new>
#include <vector>

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

}  // namespace granulaw
