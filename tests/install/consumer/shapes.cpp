// A shape and a particle without the solver.
#include "solver/shape/shapes.hpp"

#include "base/error.hpp"
#include "solver/shape/particle.hpp"

int main()
{
  granulaw::Particle grain;
  grain.materials = {{.density = 1500, .youngs_modulus = 1e9, .poisson_ratio = 0.3}};
  for (const granulaw::ShapeKind& kind : granulaw::shape_kinds())
    if (std::string(kind.name) == "box")
      grain.shape = kind.shape({.numbers = {{"sides", {2e-3, 2e-3, 3e-3}}, {"edge_radius", {0.2e-3}}}});
  grain.radius = 1e-3;
  validate(grain, "grain");
  return grain.material_at(granulaw::Vector3(0, 0, 1e-3), 0.5e-3) == 0 ? 0 : 1;
}
