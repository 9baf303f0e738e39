#include "solver/body/kernels.hpp"

#include <cstdlib>
#include <string_view>

#include "base/error.hpp"
#include "solver/body/updated_points.hpp"

namespace granulaw {

namespace {

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

struct Tables
{
  const Kernels *corners, *cells;
  const PointKernels* points;
};
const Tables& tables(InstructionSet set)
{
  static const Tables all[] = {
      {&isa_generic::corner_kernels, &isa_generic::cell_kernels, &isa_generic::point_kernels},
      {&isa_avx2::corner_kernels, &isa_avx2::cell_kernels, &isa_avx2::point_kernels},
      {&isa_avx512::corner_kernels, &isa_avx512::cell_kernels, &isa_avx512::point_kernels}};
  return all[static_cast<int>(set)];
}

/// The points come and go among the nodes of an `updated` grid, whose limit does not follow their
/// deformation.
Growth no_growth(const Body&)
{
  return {0, 1, 1, 1};
}

void move_with_points(Body& body, double dt)
{
  tables(instruction_set()).corners->grid_to_points(body, dt);
  updated_grid_to_points(body, dt);
}

Kernels updated_kernels()
{
  Kernels k = *tables(instruction_set()).corners;
  k.points_to_grid = updated_points_to_grid, k.grid_to_points = move_with_points, k.growth = no_growth;
  return k;
}

}  // namespace

InstructionSet instruction_set()
{
  static const InstructionSet chosen = choose();
  return chosen;
}

const char* name_of(InstructionSet set)
{
  constexpr const char* names[] = {"generic", "avx2", "avx512"};
  return names[static_cast<int>(set)];
}

const Kernels& kernels(const Body& body, InstructionSet set)
{
  static const Kernels updated = updated_kernels();
  if (body.moving) return updated;
  return body.reference().is_spatial() ? *tables(set).cells : *tables(set).corners;
}

const Kernels& kernels(const Body& body)
{
  return kernels(body, instruction_set());
}

const PointKernels& point_kernels()
{
  return *tables(instruction_set()).points;
}

}  // namespace granulaw
