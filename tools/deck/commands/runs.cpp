#include "deck/commands/runs.hpp"

#include "deck/commands/reading.hpp"

namespace granulaw::deck {

void follow_run(Reading& reading, Words w)
{
  double steps = w.value();
  if (w.take("upto")) steps -= reading.steps;
  if (w.after("every")) reading.note(w.where(), "the commands of 'run ... every' are not followed");
  if (!(steps >= 0)) misread("it would run backwards");
  if (reading.time_step == 0 && steps > 0) reading.note(w.where(), "no time step is set before this run");
  const double duration = steps * reading.time_step, before = reading.scene.count();
  insert_particles(reading, steps, duration);
  move_meshes(reading, duration);
  reading.steps += steps;
  reading.scene.runs.push_back({w.where(), steps, reading.time_step, 0.5 * (before + reading.scene.count())});
}

}  // namespace granulaw::deck
