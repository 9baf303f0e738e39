#include "base/error.hpp"
#include "commands.hpp"
#include "run_output.hpp"

namespace granulaw::tool {

void add_press(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("press", "Press one sphere slowly onto a rigid wall and take it off");
  command->footer(
      "Example:\n  mpm press materials.toml --particle granule --depth 0.02 --support midplane --json\n\n"
      "free: the whole sphere, driven by a uniform body force, as in a collision; delta is the way of its centre.\n"
      "midplane: half a sphere whose equator plane is driven, as finite-element references do.");
  auto arguments = std::make_shared<RunArguments>();
  auto depth = std::make_shared<double>(0);
  auto support = std::make_shared<std::string>("free");
  add_run_arguments(*command, *arguments);
  command->add_option("--depth", *depth, "largest overlap over radius, up to 0.8")->required();
  command->add_option("--support", *support, "free or midplane")->capture_default_str();
  command->callback([=] {
    if (*support != "free" && *support != "midplane") fail("--support", "cannot be used", *support, "free, midplane");
    run_and_report(*arguments, "press", [&](const Sphere& sphere, const RunOptions& options) {
      PressPlan plan;
      plan.depth = *depth * sphere.radius;
      plan.support = *support == "free" ? Support::free : Support::midplane;
      return run_press(sphere, plan, options);
    });
  });
}

}  // namespace granulaw::tool
