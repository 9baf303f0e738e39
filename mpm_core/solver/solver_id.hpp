#pragma once

#include <string>

namespace granulaw {

/// Identity of the solver, on which a run's results depend besides its request: a hash of the sources of
/// mpm_core/base and
/// mpm_core/solver, the compiler and its flags, taken when the program was built, and the instruction set of
/// kernels() on this machine; for example "5f0c1d2e3a4b5968-avx512". Runs with equal requests and equal ids
/// have the same bits; another commit that leaves the solver alone has the same id. (Not in it: the C
/// library, whose mathematical functions may change in the last bit from one version to the next.)
/// Throws Error if GRANULAW_ISA names what this processor cannot run.
const std::string& solver_id();

}  // namespace granulaw
