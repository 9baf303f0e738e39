#include "liggghts_plugin/plan/planner.hpp"
#include "liggghts_plugin/plan/short_run.hpp"

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

/// LIGGGHTS evaluated a condition of `if`; the value that it goes by.
extern "C" __attribute__((visibility("default"))) double granulaw_plan_decide(double value)
{
  return Planner::current() ? Planner::current()->decide(value) : value;
}

extern "C" __attribute__((visibility("default"))) void granulaw_plan_file(const char* path, bool is_written)
{
  Planner::current()->note_file(path, is_written);
}

extern "C" __attribute__((visibility("default"))) void granulaw_limit_steps(LAMMPS_NS::LAMMPS* lmp, long long steps, const char* file)
{
  granulaw::plugin::plan::limit_steps(lmp, steps, file);
}

extern "C" __attribute__((visibility("default"))) void granulaw_short_run_file(const char* path, bool is_written)
{
  granulaw::plugin::plan::note_file_of_short_run(path, is_written);
}

extern "C" __attribute__((visibility("default"))) void granulaw_end_short_run()
{
  granulaw::plugin::plan::write_short_run();
}

extern "C" __attribute__((visibility("default"))) void granulaw_plan_crash()
{
  Planner::current()->note_crash();
}

extern "C" __attribute__((visibility("default"))) bool granulaw_plan_end(int status)
{
  return Planner::current()->finish(status);
}
