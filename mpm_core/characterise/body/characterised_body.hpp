#pragma once

#include <string>

#include "atlas/body_numbers.hpp"
#include "base/scales.hpp"
#include "solver/shape/particle.hpp"

namespace granulaw {

/// One body whose law is wanted, and the units in which the law has no dimensions.
struct CharacterisedBody
{
  Particle particle;
  Scales scale;      ///< radius of curvature at the contact pole; E* and density of the material there
  double yield = 0;  ///< smallest yield stress in it over E*; infinity: elastic
  double poisson_ratio = 0;  ///< of the material at the pole
  /// Overlap/length at which it begins to yield: Hertz's at the pole, as if all of it had the smallest yield
  /// stress. Where that is not so an elastic press determines it (onset_of_yield.hpp).
  double onset = 0;
  int pole_material = 0;  ///< index into particle.materials of the one at the pole
  /// Distance from the pole, over the length, up to which there is that material only; infinity: everywhere.
  double skin = std::numeric_limits<double>::infinity();
  double mass = 0;          ///< over density length^3; 4/3 pi: a sphere
  std::string description;  ///< everything about it that determines a run, on one line

  bool yields() const { return yield < std::numeric_limits<double>::infinity(); }
  /// The sphere of a material that hardens linearly and has no rate is its own unit: R = rho = E* = 1.
  bool is_plain() const
  {
    return particle.is_homogeneous_sphere() && particle.materials[0].hardening.name.empty() &&
           particle.materials[0].rate.name.empty();
  }
  /// One material throughout, of any shape: Hertz's onset at the pole is the body's.
  bool is_uniform() const { return particle.layers.empty() && particle.inclusions.empty(); }
  /// Some material of it depends on the rate: its law holds for this size.
  bool rate_dependent() const;
  /// The same body, none of whose materials yields, or whose yield stresses are those without rate.
  CharacterisedBody elastic() const;
  CharacterisedBody rate_free() const;
};

BodyNumbers numbers_of(const CharacterisedBody& body);

/// Every number of a material, on one line.
std::string description_of(const Material& material);

/// Throws Error "WHERE: ..." if the material has another yield surface than von Mises'.
void check_von_mises(const Material& material, const std::string& where);

CharacterisedBody characterised_body_of(const Particle& particle);
/// A homogeneous sphere; of unit radius where the law depends on no size.
CharacterisedBody characterised_body_of(const Material& material);
/// Overlap/R at which a homogeneous sphere of the material at the pole would begin to yield.
double pole_onset(const CharacterisedBody& body);
/// The same of dimensionless numbers: E*/Y, nu, H/E.
CharacterisedBody characterised_body_of(double e_star_over_yield, double poisson_ratio,
                                        double hardening_over_e);

}  // namespace granulaw
