#pragma once

#include <vector>

#include "solver/shape/particle.hpp"
#include "solver/output/trace.hpp"

/// Energy of an impact by its place, computed from outside: from what `--fields` writes, by none of the
/// solver's own sums.
namespace granulaw::verification {

/// Shares of the impact's kinetic energy.
struct EnergyShares
{
  double time;  ///< R/c*
  double kinetic, elastic, plastic;
  double total() const { return kinetic + elastic + plastic; }
};

/// One grid, elastic-perfectly-plastic or elastic sphere, R = rho = E* = 1. Kinetic: lumped masses of the
/// cells times nodal velocities. Elastic: J^2 (q^2/(6 G) + p^2/(2 K)) of each cell's reference volume; J from
/// ln J = -p J/K. Plastic: J Y d(ep), summed over the frames. The hourglass control's energy is in none of
/// them.
std::vector<EnergyShares> energy_audit(const Particle& sphere, double velocity, int cells_across, int frames);

/// Impulse of the contact force, summed over a trace of a single grid; each sample holds the mean force of
/// its interval and the interval's middle, the first begins at time 0.
double impulse(const std::vector<TraceSample>& trace);

}  // namespace granulaw::verification
