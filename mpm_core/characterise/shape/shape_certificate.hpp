#pragma once

#include <vector>

#include "characterise/run/request.hpp"
#include "law/law.hpp"
#include "solver/shape/particle.hpp"
#include "solver/shape/shape.hpp"

namespace granulaw {

/// ShapeCertificate::shape: the solid's definition, or what it begins with and a checksum of a long one.
std::string shape_text(const Shape& solid);

/// Runs of the solver that certify_shape makes.
std::size_t certificate_runs(const Particle& particle, const ShapeQuestion& question);

/// Throws the body in each direction and replays the law of a sphere of its material. The law's contact has
/// the radius sqrt(R' R'') (a plastic contact of overlap delta has the area 2 pi delta sqrt(R' R''), whatever
/// their ratio) and the mass that resists at the point (effective_mass_share). The first contact counts, as
/// the law is of one contact: a body that turns over it may hit again. Of a clump all balls that touch count
/// (clump_on_wall), as in a particle code. Frictionless. `particle`: of one
/// material; `law`: of that material's sphere. Throws Error where a run fails twice.
ShapeCertificate certify_shape(const Particle& particle, const BodyLaw& law, const ShapeQuestion& question,
                               Farm& farm, const Progress& progress = {});

/// Speed, m/s, of a certificate whose velocity nobody gave: rho V^2/Y = 0.0025 (100 V_y at E*/Y = 100), or
/// `largest_damage_number` if that is less and over 0; of a body that never yields half a percent of
/// sqrt(E*/rho).
double usual_velocity(const LawMaterial& material, double largest_damage_number);

}  // namespace granulaw
