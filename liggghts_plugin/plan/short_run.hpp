#pragma once

#include <string>

namespace LAMMPS_NS {
class LAMMPS;
}

// `liggghts-mpm -steps N FILE -in DECK`: the deck as it is, of any models, for N time steps in all. FILE gets
// particles and energy.
namespace granulaw::plugin::plan {

/// To be called before each line of the deck: `clear` and `run_style` make a new integrator.
void limit_steps(LAMMPS_NS::LAMMPS* lmp, long long steps, const std::string& file);

/// The deck has ended before.
void write_short_run();

}  // namespace granulaw::plugin::plan
