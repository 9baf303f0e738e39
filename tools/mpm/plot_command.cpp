// mpm plot: a picture of a law file, drawn by plot_law.py.
#include <fmt/format.h>

#include <memory>

#include "command.hpp"
#include "law/law_file.hpp"
#include "python_script.hpp"
#include "trace_file.hpp"

namespace granulaw {

namespace {

void plot(const std::string& law, const std::string& output)
{
  check_output(output, ".png, .pdf, .svg");
  read_law(law);  // its sentence is better than Python's
  draw_by_python("mpm plot", "plot_law.py", law, output);
  fmt::print("wrote {}\n", output);
}

void define(CLI::App& command)
{
  struct Request
  {
    std::string law, output;
  };
  const auto r = std::make_shared<Request>();
  command.add_option("LAW", r->law, "law file of mpm table")->required();
  command.add_option("-o,--output", r->output, "picture, NAME.png, .pdf or .svg")->required();
  command.callback([r] { plot(r->law, r->output); });
}

}  // namespace

extern const Command plot_command{
    "plot",
    "Draws a law: force against overlap with its unloading branches, and e against velocity beside\n"
    "Thornton's closed form. Example: mpm plot law.h5 -o law.png",
    define};

}  // namespace granulaw
