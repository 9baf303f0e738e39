#pragma once

#include <string>

namespace LAMMPS_NS {
class LAMMPS;
}

// `liggghts-mpm -steps N FILE -in DECK`: the deck as it is, of any models, for N time steps in all. FILE gets
// particles, energy, and the names of the files that the deck would have written: none is.
namespace granulaw::plugin::plan {

/// To be called before each line of the deck: `clear` and `run_style` make a new integrator.
void limit_steps(LAMMPS_NS::LAMMPS* lmp, long long steps, const std::string& file);

/// A file that the deck opens.
void note_file_of_short_run(const char* path, bool is_written);

/// The deck has ended before.
void write_short_run();

}  // namespace granulaw::plugin::plan
