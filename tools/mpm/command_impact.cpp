#include "commands.hpp"
#include "run_output.hpp"

namespace granulaw::tool {

void add_impact(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("impact", "Throw one sphere at a rigid wall");
  command->footer(
      "Example:\n  mpm impact materials.toml --particle granule --velocity 0.5 --tolerance 0.01 -o trace.csv\n\n"
      "The trace holds time_s,delta_m,force_N,contact_radius_m,branch: the overlap delta is the way of the sphere's\n"
      "centre of mass towards the wall since first touch, the force is repulsive positive.");
  auto arguments = std::make_shared<RunArguments>();
  auto velocity = std::make_shared<double>(0);
  add_run_arguments(*command, *arguments);
  command->add_option("--velocity", *velocity, "impact velocity, m/s")->required();
  command->callback([=] {
    run_and_report(*arguments, "impact", [&](const Sphere& sphere, const RunOptions& options) {
      return run_impact(sphere, *velocity, options);
    });
  });
}

}  // namespace granulaw::tool
