#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace granulaw {

/// FNV-1a, 64 bit.
std::uint64_t checksum(std::string_view bytes, std::uint64_t start = 14695981039346656037ull);

/// Carries the state of a run into bytes and back. Whatever changes from step to step has one function
///     void visit_state(StateArchive& a) { a.value(time_), a.values(vr_i); }
/// that names it once for both ways, so that saving and loading cannot drift apart. What follows from the
/// request (grid, weights, materials) is built anew and not stored. Numbers keep every bit; the bytes are in
/// the order of the machine. The solver contains no file handling (checkpoint.hpp).
class StateArchive
{
 public:
  /// For saving.
  StateArchive() = default;
  /// For loading; `where` leads the sentences of Error if the bytes do not hold what is asked for.
  StateArchive(std::string bytes, std::string where)
      : loading_(true), bytes_(std::move(bytes)), where_(std::move(where))
  {
  }
  bool loading() const { return loading_; }

  /// A number, or a struct of numbers without padding.
  template <class T>
  void value(T& x)
  {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_same_v<T, bool> && !std::is_pointer_v<T>);
    raw(&x, sizeof(T));
  }
  void value(bool& x);
  void value(std::string& x);

  /// A field whose size follows from the request: another size is refused.
  template <class T, class Allocator>
  void values(std::vector<T, Allocator>& x)
  {
    expect(x.size(), "size of a field");
    raw(x.data(), x.size() * sizeof(T));
  }
  /// A list that grows while the run goes on.
  template <class T>
  void growing(std::vector<T>& x)
  {
    static_assert(std::is_trivially_copyable_v<T>);
    x.resize(count(x.size(), sizeof(T)));
    raw(x.data(), x.size() * sizeof(T));
  }
  /// Something that both sides must agree upon: stored, and compared on loading.
  void expect(std::uint64_t own, const char* what);
  /// A number of items that take at least `bytes_each`: one that cannot follow is refused.
  std::size_t count(std::size_t own, std::size_t bytes_each);

  /// Loading: nothing may be left over.
  void finish() const;
  std::string take() { return std::move(bytes_); }

 private:
  void raw(void* x, std::size_t size);

  bool loading_ = false;
  std::string bytes_, where_;
  std::size_t at_ = 0;
};

}  // namespace granulaw
