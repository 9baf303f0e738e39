#pragma once

#include <fmt/format.h>

#if FMT_VERSION >= 90000 && FMT_VERSION < 100000
// Debian's LAMMPS headers call a function that its fmt no longer has. Nothing here instantiates the callers.
namespace fmt {
template <class... Args, class Text>
auto make_args_checked(const Text&, const std::remove_reference_t<Args>&... args)
{
  return make_format_args(args...);
}
}  // namespace fmt
#endif
