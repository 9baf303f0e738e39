// LIGGGHTS's value of a condition in this process: a plan leaves loops that wait for a value of a run.
#pragma GCC visibility push(default)
#include "variable.h"
#pragma GCC visibility pop

#include <dlfcn.h>

/// plan/entry.cpp, of the plug-in's library
extern "C" double granulaw_plan_decide(double value);

double LAMMPS_NS::Variable::evaluate_boolean(char* text)
{
  using Evaluate = double(LAMMPS_NS::Variable*, char*);
  static auto* const evaluate = reinterpret_cast<Evaluate*>(dlsym(RTLD_NEXT, "_ZN9LAMMPS_NS8Variable16evaluate_booleanEPc"));
  return granulaw_plan_decide(evaluate(this, text));
}
