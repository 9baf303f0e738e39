#include "solver/body/kernels.hpp"

#include <cstdlib>
#include <string_view>

#include "base/error.hpp"
#include "solver/contact/rows.hpp"
#include "solver/body/spatial_kernels.hpp"

namespace granulaw {

namespace {

enum class InstructionSet { generic, avx2, avx512 };

InstructionSet choose()
{
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512vl");
  const char* wish = std::getenv("GRANULAW_ISA");
  if (wish) {
    const std::string_view name(wish);
    if (name == "generic") return InstructionSet::generic;
    if (name == "avx2" && avx2) return InstructionSet::avx2;
    if (name == "avx512" && avx512) return InstructionSet::avx512;
    fail("environment GRANULAW_ISA", "this processor cannot run these kernels", name,
         avx512 ? "generic, avx2, avx512" : (avx2 ? "generic, avx2" : "generic"));
  }
  if (avx512) return InstructionSet::avx512;
  if (avx2) return InstructionSet::avx2;
  return InstructionSet::generic;
}

InstructionSet instruction_set()
{
  static const InstructionSet chosen = choose();
  return chosen;
}

}  // namespace

const Kernels& kernels()
{
  const Kernels* sets[] = {&isa_generic::kernels, &isa_avx2::kernels, &isa_avx512::kernels};
  return *sets[static_cast<int>(instruction_set())];
}

const SpatialKernels& spatial_kernels()
{
  const SpatialKernels* sets[] = {&isa_generic::spatial_kernels, &isa_avx2::spatial_kernels,
                                  &isa_avx512::spatial_kernels};
  return *sets[static_cast<int>(instruction_set())];
}

const RowKernels& row_kernels()
{
  const RowKernels* sets[] = {&isa_generic::row_kernels, &isa_avx2::row_kernels, &isa_avx512::row_kernels};
  return *sets[static_cast<int>(instruction_set())];
}

}  // namespace granulaw
