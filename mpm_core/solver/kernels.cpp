#include "solver/kernels.hpp"

#include <cstdlib>
#include <string_view>

#include "base/error.hpp"

namespace granulaw {

namespace {

const Kernels& choose()
{
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512vl");
  const char* wish = std::getenv("GRANULAW_ISA");
  if (wish) {
    const std::string_view name(wish);
    if (name == "generic") return isa_generic::kernels;
    if (name == "avx2" && avx2) return isa_avx2::kernels;
    if (name == "avx512" && avx512) return isa_avx512::kernels;
    fail("environment GRANULAW_ISA", "this processor cannot run these kernels", name,
         avx512 ? "generic, avx2, avx512" : (avx2 ? "generic, avx2" : "generic"));
  }
  if (avx512) return isa_avx512::kernels;
  if (avx2) return isa_avx2::kernels;
  return isa_generic::kernels;
}

}  // namespace

const Kernels& kernels()
{
  static const Kernels& chosen = choose();
  return chosen;
}

}  // namespace granulaw
