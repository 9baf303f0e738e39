#pragma once

#include <string>

#include "calibrate/calibrate.hpp"

namespace granulaw {

/// An impact device of the Leeb hardness test (ISO 16859-1): a ball at the end of a body, shot downwards at thick
/// metal. HL is 1000 times the rebound speed over the impact speed, both measured 1 mm above the surface.
struct LeebDevice
{
  const char* name;
  double mass;      ///< kg, of the impact body with its ball
  double velocity;  ///< m/s, at the surface
  double radius;    ///< m, of the ball
  LawMaterial ball;
};

/// Throws Error naming `where` for a device that is not known, or that no rigid mass describes (DL).
const LeebDevice& leeb_device(const std::string& name, const std::string& where);

/// Makes drops of the device's ball on thick metal of readings over 1000. `compliance`: m/N, of the impact body.
void make_drops(Measurement& readings, const LeebDevice& device, double compliance);

/// A value, and the ends of 95 %.
struct Estimate95
{
  double value, low, high;
};

/// Yield stress that a rebound shows, over the static flow stress at a plastic strain of about 4 %: of steels, by
/// conversion tables (docs/evidence/leeb.md). A body that is taken as rigid counts as rate.
Estimate95 usual_rate_factor(double compliance);
/// The same of one tester by its reference block: what the block's HL shows over what its Brinell hardness
/// (HBW 10/3000) does. `drops`: a measurement of the device, whose reading is replaced; `known`: of the block.
Estimate95 rate_factor_of(const Atlas& atlas, Measurement drops, double leeb_hardness, double brinell_hardness,
                          const CandidateMaterial& known);

/// Quotient of two estimates that do not depend on each other.
Estimate95 over(const Estimate95& a, const Estimate95& b);

}  // namespace granulaw
