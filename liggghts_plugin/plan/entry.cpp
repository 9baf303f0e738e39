#include "liggghts_plugin/plan/planner.hpp"

// Calls of the launcher (launcher.cpp), which is linked to the plug-in's library.
using granulaw::plugin::plan::Planner;

/// Before the deck is read. The planner lives as long as the process.
extern "C" __attribute__((visibility("default"))) void granulaw_plan(LAMMPS_NS::LAMMPS* lmp, const char* file)
{
  new Planner(lmp, file);
}

extern "C" __attribute__((visibility("default"))) void granulaw_plan_line(const char* where, const char* text)
{
  Planner::current()->begin_line(where, text);
}

extern "C" __attribute__((visibility("default"))) bool granulaw_plan_end(int status)
{
  return Planner::current()->finish(status);
}
