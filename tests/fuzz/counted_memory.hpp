#pragma once

// Counts what one thread of the program has allocated: replaces malloc and its family, so include it in one
// source file only. Under a sanitizer, which replaces them itself, nothing is counted and peak() is 0.
#include <malloc.h>

#include <atomic>
#include <cstddef>

#if !defined(__SANITIZE_ADDRESS__) && defined(__GLIBC__)
#define GRANULAW_COUNTS_MEMORY 1
#endif

namespace granulaw::tests {

inline std::atomic<long> live_bytes{0}, peak_bytes{0};

/// From its making on: the most that was allocated at a time, bytes above what was there.
class CountedMemory
{
 public:
  CountedMemory() : start_(live_bytes) { peak_bytes = start_; }
  std::size_t peak() const { return static_cast<std::size_t>(peak_bytes - start_); }

 private:
  long start_;
};

#ifdef GRANULAW_COUNTS_MEMORY
inline void* counted(void* block, std::size_t asked)
{
  // a request that is refused counts as well: it was made
  const long now = live_bytes += block ? static_cast<long>(malloc_usable_size(block)) : 0;
  const long top = now + (block ? 0 : static_cast<long>(asked));
  if (top > peak_bytes) peak_bytes = top;
  return block;
}
inline void forget(void* block)
{
  if (block) live_bytes -= static_cast<long>(malloc_usable_size(block));
}
#endif

}  // namespace granulaw::tests

#ifdef GRANULAW_COUNTS_MEMORY
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void __libc_free(void*);

void* malloc(std::size_t size)
{
  return granulaw::tests::counted(__libc_malloc(size), size);
}
void* calloc(std::size_t count, std::size_t size)
{
  return granulaw::tests::counted(__libc_calloc(count, size), count * size);
}
void* realloc(void* block, std::size_t size)
{
  granulaw::tests::forget(block);
  return granulaw::tests::counted(__libc_realloc(block, size), size);
}
void free(void* block)
{
  granulaw::tests::forget(block);
  __libc_free(block);
}
}
#endif
