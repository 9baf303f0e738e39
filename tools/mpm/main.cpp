// mpm: contact laws by the material point method. One command a file (commands.hpp); this one parses, reports
// and exits.
//
// Exit codes: 0 done; 1 a file cannot be used (one sentence on stderr); 2 the command line cannot be understood,
// or a value in it cannot be used; 3 (convert) a number is needed that the deck does not say; 130 stopped by
// Ctrl-C. Under mpirun all ranks end with the largest of theirs.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hdf5.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <new>
#include <vector>

#include "base/error.hpp"
#include "base/version.hpp"
#include "commands.hpp"
#include "deck/questions.hpp"
#include "farm/farm.hpp"
#include "ranks.hpp"
#include "terminal.hpp"

namespace granulaw {
std::string command_line;
}

namespace {

using namespace granulaw;

constexpr const char* summary =
    "mpm: contact laws between particles, by the material point method. SI units.\n"
    "First: mpm table materials.toml -o law.h5, then mpm plot law.h5 -o law.png";

/// The commands by groups, a line each: one screen.
class GroupedHelp final : public CLI::Formatter
{
  std::string make_usage(const CLI::App* app, std::string name) const override
  {
    return app->get_parent() ? Formatter::make_usage(app, name) : "Usage: mpm COMMAND [OPTIONS], or mpm --version\n";
  }

  std::string make_subcommands(const CLI::App* app, CLI::AppFormatMode) const override
  {
    std::string text, group;
    for (const CLI::App* one : app->get_subcommands({})) {
      if (text.empty()) text = "Commands (mpm COMMAND --help explains each):\n";
      if (one->get_group() != group) text += fmt::format("{}:\n", group = one->get_group());
      const std::string whole = one->get_description();
      const auto end = std::min({whole.find(": "), whole.find(". "), whole.find(".\n"), whole.find("; "), whole.find(" (")});
      text += fmt::format("  {:<10} {}\n", one->get_name(), whole.substr(0, end));
    }
    return text;
  }
};

/// Error for the caller of the program.
struct Outcome
{
  int code = 0;
  std::string sentence;  ///< why the code is not 0; empty: nothing is to be said
};

/// All options of one command, or of none.
std::vector<std::string> options_of(const CLI::App& app)
{
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::vector<std::string> commands_of(const CLI::App& app)
{
  std::vector<std::string> names;
  for (const CLI::App* one : app.get_subcommands({})) {
    names.push_back(one->get_name());
    for (const std::string& alias : one->get_aliases()) names.push_back(alias);
  }
  return names;
}

/// Null: there is none.
const CLI::App* command_named(const std::string& name, const CLI::App& app)
{
  for (const CLI::App* one : app.get_subcommands({}))
    if (one->check_name(name)) return one;
  return nullptr;
}

/// The first command or option that there is none of, with the nearest there is; empty: all are known. CLI11
/// would rather complain of a required option that is missing because it was mistyped.
std::string unknown_word(const CLI::App& app, int argc, char** argv)
{
  const CLI::App* command = nullptr;
  for (int k = 1; k < argc; ++k) {
    const std::string word = std::string(argv[k]).substr(0, std::string(argv[k]).find('='));
    const bool is_option = word.starts_with("--") && word != "--";
    if (!is_option && command) continue;
    const std::vector<std::string> known = is_option ? options_of(command ? *command : app) : commands_of(app);
    if (std::find(known.begin(), known.end(), word) == known.end() && !word.starts_with("-h"))
      return fmt::format("no {} '{}'{}: allowed is {}", is_option ? "option" : "command", printable(word), did_you_mean(word, known), fmt::join(known, ", "));
    if (!is_option) command = command_named(word, app);
  }
  return {};
}

/// The first word that is empty; CLI11 would take it for a name, or for the number 0.
std::string empty_word(int argc, char** argv)
{
  for (int k = 1; k < argc; ++k)
    if (*argv[k] == '\0') return fmt::format("{}: found an empty word, allowed is a name or a number", k > 1 ? printable(argv[k - 1]) : "the command");
  return {};
}

void add_commands(CLI::App& app)
{
  app.set_version_flag("--version", fmt::format("mpm {} ({})", version(), git_hash()));
  app.require_subcommand(1);
  for (const auto& [group, command] : commands) {
    CLI::App* added = app.add_subcommand(command->name, command->summary)->group(group);
    if (*command->alias) added->alias(command->alias);
    Options options(*added);
    command->define(options);
  }
}

/// True if the first word is a command whose runs are spread over the processes of mpirun.
bool runs_on_ranks(const std::string& word)
{
  return std::any_of(commands.begin(), commands.end(), [&](const CommandEntry& c) { return c.command->on_ranks && c.command->name == word; });
}

/// "Could not convert: --velocity = fast" in the tool's own words.
std::string conversion_sentence(const std::string& text)
{
  const auto colon = text.find(": ");
  return fmt::format("{}: is no number, or not of the kind that is wanted", printable(colon == std::string::npos ? text : text.substr(colon + 2)));
}

std::string parse_sentence(const CLI::App& app, int argc, char** argv, const CLI::ParseError& error)
{
  const std::string unknown = unknown_word(app, argc, argv);
  if (!unknown.empty()) return unknown;
  return fmt::format("{} (mpm --help and mpm COMMAND --help list what is possible)", printable(error.what()));
}

/// True of a sentence that an option leads: "--depth: cannot be used: ...".
bool names_an_option(const std::string& sentence) { return sentence.starts_with("--") || sentence.starts_with("-o: "); }

/// CLI11 takes the words from their end.
void parse_reversed(CLI::App& app, std::vector<std::string> words)
{
  std::reverse(words.begin(), words.end());
  app.parse(std::move(words));
}

void parse(CLI::App& app, const std::vector<std::string>& words)
{
  const CLI::App* command = words.empty() ? nullptr : command_named(words[0], app);
  if (!command) return parse_reversed(app, words);
  try {
    parse_reversed(app, split_lists(*command, words));
  } catch (const CLI::RequiredError&) {
    const std::vector<std::string> other = give_file_back(*command, words);
    if (other.empty()) throw;
    parse_reversed(app, split_lists(*command, other));
  }
}

/// Carries out the command line.
Outcome run(int argc, char** argv)
{
  CLI::App app{summary, "mpm"};
  app.formatter(std::make_shared<GroupedHelp>());
  app.get_formatter()->label("SUBCOMMAND", "COMMAND");
  add_commands(app);
  for (CLI::Option* own : app.get_options()) own->group("");  // in the line of usage
  try {
    if (const std::string sentence = empty_word(argc, argv); !sentence.empty()) return {2, sentence};
    if (argc > 1) join_ranks(argv[1], runs_on_ranks(argv[1]));
    parse(app, {argv + 1, argv + argc});
    return {};
  } catch (const CLI::Success& asked) {  // --help, --version
    return {app.exit(asked), {}};
  } catch (const CLI::ConversionError& error) {
    return {2, conversion_sentence(error.what())};
  } catch (const CLI::ValidationError& error) {  // "--depth: cannot be used: found '2', allowed is ..."
    return {2, printable(error.what())};
  } catch (const CLI::ParseError& error) {
    return {2, parse_sentence(app, argc, argv, error)};
  } catch (const Interrupted&) {
    return {130, "stopped"};
  } catch (const std::bad_alloc&) {
    return {1, "not enough memory"};
  } catch (const deck::Unanswered& error) {
    return {3, error.what()};
  } catch (const Error& error) {
    return {names_an_option(error.what()) ? 2 : 1, error.what()};
  } catch (const FarmBroken& error) {
    return {1, error.what()};
  } catch (const std::filesystem::filesystem_error& error) {
    return {1, fmt::format("{}: cannot be read or written", printable(error.path1().string()))};
  } catch (const std::exception&) {
    // a library's words mean nothing to who gave the command; a debugger that stops at throws shows them
    return {1, fmt::format("a defect of this program has ended the command: please report '{}' with its files", printable(command_line))};
  }
}

}  // namespace

int main(int argc, char** argv)
{
  // HDF5 prints at exit after it was fed a damaged file; every file is closed by its owner anyway.
  H5dont_atexit();
  for (int k = 0; k < argc; ++k) command_line += (k ? " " : "") + std::string(k ? argv[k] : "mpm");
  catch_interrupts();
  const Outcome outcome = run(argc, argv);
  return leave_ranks(outcome.code, outcome.sentence);
}
