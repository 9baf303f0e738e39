// mpm plot: a picture of a law file, or of one pair of it, drawn by plot_law.py. The curves come from here, so that the Python
// that draws needs Matplotlib alone, not the module `granulaw`, which is another package.
#include <fmt/format.h>

#include <memory>
#include <vector>

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "command.hpp"
#include "law/law_file.hpp"
#include "law/pair_curves.hpp"
#include "option_checks.hpp"
#include "own_files.hpp"
#include "shape_output.hpp"

namespace granulaw {

namespace of_plot {

struct Request : PairAsked
{
  std::string output, shape;
  std::optional<double> velocity;
};

nlohmann::ordered_json as_json(const DrawnLine& line) { return {{"name", line.name}, {"role", line.role}, {"x", line.x}, {"y", line.y}}; }

nlohmann::ordered_json as_json(const ForceLine& line)
{
  nlohmann::ordered_json out = as_json(static_cast<const DrawnLine&>(line));
  out["unloading"] = nlohmann::ordered_json::array();
  for (const DrawnLine& branch : line.unloading) out["unloading"].push_back(as_json(branch));
  return out;
}

/// Labels of a picture's axes. `overlap`: the axis's unit in that of the curves.
struct Axes
{
  const char *overlap_text, *force_text, *speed_text;
  double overlap;
};

void draw(const LawCurves& curves, const Axes& axes, const std::string& output)
{
  nlohmann::ordered_json told{{"title", curves.title}, {"overlap_unit", axes.overlap}, {"labels", {axes.overlap_text, axes.force_text, axes.speed_text}}};
  for (const ForceLine& line : curves.force) told["force"].push_back(as_json(line));
  for (const DrawnLine& line : curves.restitution) told["restitution"].push_back(as_json(line));
  draw_by_python("plot", "plot_law.py", {output}, told.dump(), output);
  fmt::print("wrote {}\n", output);
}

void draw_certificate(const Law& law, const Request& r)
{
  std::vector<std::string> shapes;
  for (const auto& [name, body] : law.bodies)
    if (body.shape) shapes.push_back(name);
  const auto found = law.bodies.find(r.shape);
  if (found == law.bodies.end() || !found->second.shape) fail_unknown("--shape", "no body with a certificate over orientations", r.shape, shapes);
  draw_shape("plot", r.shape, *found->second.shape, r.output);
}

void plot(const Request& r)
{
  check_output("-o", r.output, ".png, .pdf, .svg");
  const Law law = read_law(r.law);
  if (!r.shape.empty()) return draw_certificate(law, r);
  if (r.pair.empty()) return draw(body_curves(law), {"overlap / R", "force / (Y R²)", "V / $V_y$", 1}, r.output);
  draw(pair_curves(law, choose_pair(law, r), r.velocity), {"overlap, µm", "force, N", "approach speed, m/s", 1e-6}, r.output);
}

void define(Options& command)
{
  const auto r = std::make_shared<Request>();
  command.add_option("LAW", r->law, "law file of mpm table").required();
  define_pair_options(command, *r);
  command.add_option("--velocity", r->velocity, "of a pair: the largest approach speed, m/s (default: a hundred yield velocities, or where the law ends)")
      .check(above_zero());
  command.add_option("--shape", r->shape, "a particle of any shape: draw what its law is wrong by over its orientations").excludes(command.get_option("--pair"));
  command.get_option("--pair").description("a:b or a:wall: draw this pair (default: every material on the rigid wall)");
  for (const char* of_pair : {"--radius", "--radius2", "--velocity"}) command.get_option(of_pair).needs(command.get_option("--pair"));
  command.add_option("-o,--output", r->output, "picture, NAME.png, .pdf or .svg").required();
  command.callback([r] { plot(*r); });
}

}  // namespace of_plot

extern const Command plot_command{"plot",
    "Draws a law: force against overlap with its unloading branches, and e against velocity beside Thornton's\n"
    "closed form. For a pair also the pair rule, Hertz's force and the energy of waves.\n"
    "Example: mpm plot law.h5 -o law.png\n"
    "         mpm plot law.h5 --shape pebble -o map.png\n"
    "         mpm plot law.h5 --pair powder:steel --radius 5e-4 --radius2 inf -o pair.png",
    of_plot::define};

}  // namespace granulaw
