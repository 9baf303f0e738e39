#pragma once

#include "atlas/atlas.hpp"

namespace granulaw {

/// Errors of an atlas's laws (sd): rms of its checks, which are against runs, and of the error that those
/// runs state of themselves by two resolutions. Both grow with E*/Y, so each check counts by its distance in
/// ln(E*/Y), with a Gaussian of a factor of two.
struct AtlasErrors
{
  double restitution = 0;     ///< of e, absolute, against runs
  double force = 0;           ///< relative, the runs' own included
  double midplane_force = 0;  ///< relative, the runs' own included
  /// Error of an unloading, relative to the largest overlap less the residual, by midplane presses. It goes
  /// as e^2: the runs' own error counts twice.
  double recovery = 0;
  double solver = 0;  ///< of the runs, relative, of F and of e
};

AtlasErrors errors_of(const Atlas& atlas, double stiffness);

}  // namespace granulaw
