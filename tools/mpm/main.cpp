// mpm: contact laws by the material point method. One command a file; this one parses, reports and exits.
//
// Exit codes: 0 done; 1 the input cannot be used (one sentence on stderr); 2 the command line cannot be
// understood; 130 stopped by Ctrl-C. Under mpirun all ranks end with the largest of theirs.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hdf5.h>

#include <algorithm>
#include <new>
#include <vector>

#include "base/error.hpp"
#include "base/version.hpp"
#include "commands.hpp"
#include "ranks.hpp"
#include "terminal.hpp"

namespace granulaw {
std::string command_line;
}

namespace {

using namespace granulaw;

/// The first command or option that there is none of, with the nearest there is; empty: all are known. CLI11
/// would rather complain of a required option that is missing because it was mistyped.
std::string unknown_word(const CLI::App& app, int argc, char** argv)
{
  const CLI::App* command = nullptr;
  for (int k = 1; k < argc; ++k) {
    const std::string word = std::string(argv[k]).substr(0, std::string(argv[k]).find('='));
    const bool is_option = word.starts_with("--") && word != "--";
    if (!is_option && command) continue;
    std::vector<std::string> known;
    if (is_option) {
      for (const CLI::Option* option : (command ? *command : app).get_options())
        for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    } else {
      for (const CLI::App* one : app.get_subcommands({})) {
        if (one->get_name() == word) command = one;
        known.push_back(one->get_name());
      }
    }
    if (std::find(known.begin(), known.end(), word) == known.end() && !word.starts_with("-h"))
      return fmt::format("no {} '{}'{}: allowed is {}", is_option ? "option" : "command", printable(word),
                         did_you_mean(word, known), fmt::join(known, ", "));
  }
  return {};
}

/// The first word that is empty; CLI11 would take it for a name, or for the number 0.
std::string empty_word(int argc, char** argv)
{
  for (int k = 1; k < argc; ++k)
    if (*argv[k] == '\0')
      return fmt::format("{}: found an empty word, allowed is a name or a number",
                         k > 1 ? printable(argv[k - 1]) : "the command");
  return {};
}

/// Carries out the command line. Returns the exit code; `sentence` says why it is not 0.
int run(int argc, char** argv, std::string& sentence)
{
  // HDF5 prints at exit after it was fed a damaged file; every file is closed by its owner anyway.
  H5dont_atexit();
  for (int k = 0; k < argc; ++k) command_line += (k ? " " : "") + std::string(k ? argv[k] : "mpm");

  CLI::App app{
      "mpm: contact laws between particles, computed by the material point method.\n"
      "\n"
      "All input and output is in SI units: kg/m^3, Pa, m, m/s, N, J, s.\n"
      "A first session:\n"
      "  mpm impact materials.toml --particle grain --velocity 1.0        one collision with a rigid wall\n"
      "  mpm table materials.toml -o law.h5                               the contact law of every pair\n"
      "  mpm law law.h5 --pair powder:wall --radius 2e-3 --velocity 1.0   the same collision by the law\n"
      "  mpm plot law.h5 -o law.png                                       what the law looks like\n"
      "Each command explains itself: mpm impact --help",
      "mpm"};
  app.set_version_flag("--version", fmt::format("mpm {} ({})", version(), git_hash()));
  app.require_subcommand(1);
  add_impact(app);
  add_press(app);
  add_table(app);
  add_atlas(app);
  add_law(app);
  add_check(app);
  add_info(app);
  add_plot(app);
  add_export(app);
  add_plan(app);
  add_soften(app);

  catch_interrupts();
  try {
    sentence = empty_word(argc, argv);
    if (!sentence.empty()) return 2;
    if (argc > 1) join_ranks(argv[1]);
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::Success& asked) {  // --help, --version
    return app.exit(asked);
  } catch (const CLI::ConversionError& error) {  // "Could not convert: --velocity = fast"
    const std::string text = error.what();
    const auto colon = text.find(": ");
    sentence = fmt::format("{}: is no number, or not of the kind that is wanted",
                           printable(colon == std::string::npos ? text : text.substr(colon + 2)));
    return 2;
  } catch (const CLI::ValidationError& error) {  // "--depth: cannot be used: found '2', allowed is ..."
    sentence = printable(error.what());
    return 2;
  } catch (const CLI::ParseError& error) {
    sentence = unknown_word(app, argc, argv);
    if (sentence.empty())
      sentence = fmt::format("{} (mpm --help and mpm COMMAND --help list what is possible)",
                             printable(error.what()));
    return 2;
  } catch (const Interrupted&) {
    sentence = "stopped";
    return 130;
  } catch (const std::bad_alloc&) {
    sentence = "not enough memory";
  } catch (const std::exception& error) {
    sentence = error.what();
  }
  return 1;
}

}  // namespace

int main(int argc, char** argv)
{
  std::string sentence;
  const int code = run(argc, argv, sentence);
  return leave_ranks(code, sentence);
}
