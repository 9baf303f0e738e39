#include "pages.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <vector>

#include "base/atomic_write.hpp"
#include "base/version.hpp"

namespace granulaw {

namespace {

using Words = std::vector<std::string>;

/// An option or a positional argument, as a page shows it.
struct Entry
{
  Words names;
  std::string value;    ///< TEXT, FLOAT, INT or UINT; empty: a flag
  std::string allowed;  ///< "a number over 0"
  bool several = false;
  std::string text;  ///< its meaning, and the notes of its head
};

Words lines_of(const std::string& text)
{
  std::istringstream in(text);
  Words lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string in_one_line(const std::string& text)
{
  Words words = lines_of(text);
  for (std::string& line : words) CLI::detail::trim(line);
  std::erase(words, "");
  return fmt::format("{}", fmt::join(words, " "));
}

std::string without_stops(std::string text)
{
  while (text.ends_with('.')) text.pop_back();
  return text;
}

/// Without its stop.
std::string first_sentence(const std::string& text)
{
  for (std::size_t k = 1; k < text.size(); ++k)
    if (std::isspace(static_cast<unsigned char>(text[k])) && (text[k - 1] == '.' || text[k - 1] == '?'))
      return without_stops(text.substr(0, k));
  return without_stops(text);
}

std::string names_of(const std::set<CLI::Option*>& options)
{
  Words names;
  for (const CLI::Option* option : options) names.push_back(option->get_name());
  std::sort(names.begin(), names.end());
  return fmt::format("{}", fmt::join(names, " "));
}

Entry entry_of(const CLI::Option& option, bool positional)
{
  Entry e;
  for (std::string& name : CLI::detail::split(positional ? option.get_name(true) : option.get_name(false, true), ','))
    e.names.push_back(name.substr(0, name.find('{')));
  Words notes{in_one_line(option.get_description())};
  if (option.get_type_size() != 0) {
    const std::string type = option.get_type_name();
    const std::size_t colon = type.find(':');
    e.value = type.substr(0, colon);
    if (colon != std::string::npos) e.allowed = type.substr(colon + 1);
    e.several = option.get_expected_max() == CLI::detail::expected_max_vector_size || option.get_expected_min() > 1;
    if (option.get_required()) notes.push_back("Required.");
    if (!e.allowed.empty() && notes[0].find(e.allowed) == std::string::npos) notes.push_back("Allowed: " + e.allowed + ".");
    if (!option.get_default_str().empty()) notes.push_back("Default: " + option.get_default_str() + ".");
  }
  if (const std::string others = names_of(option.get_needs()); !others.empty()) notes.push_back("Needs " + others + ".");
  if (const std::string others = names_of(option.get_excludes()); !others.empty()) notes.push_back("Not with " + others + ".");
  if (notes.size() > 1) notes[0] = without_stops(notes[0]) + ".";
  e.text = fmt::format("{}", fmt::join(notes, " "));
  return e;
}

std::vector<Entry> entries_of(const CLI::App& app, bool positional)
{
  std::vector<Entry> entries;
  for (const CLI::Option* option : app.get_options())
    if (positional ? option->get_positional() : option->nonpositional()) entries.push_back(entry_of(*option, positional));
  return entries;
}

/// Plain words: no request at the start of a line, no hyphenation mark.
std::string roff(const std::string& text)
{
  std::string escaped;
  for (const char c : text) {
    if ((c == '.' || c == '\'') && (escaped.empty() || escaped.back() == '\n')) escaped += "\\&";
    escaped += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
  }
  return escaped;
}

std::string literal(const Words& lines)
{
  std::string text = ".EX\n";
  for (const std::string& line : lines) text += roff(line) + "\n";
  return text + ".EE";
}

/// Lines that begin with two spaces keep their form.
std::string prose(const Words& lines)
{
  const auto kind = [](const std::string& line) { return line.empty() ? 0 : line.starts_with("  ") ? 1 : 2; };
  Words blocks;
  for (auto from = lines.begin(); from != lines.end();) {
    const auto to = std::find_if(from, lines.end(), [&](const std::string& line) { return kind(line) != kind(*from); });
    const Words block(from, to);
    blocks.push_back(kind(*from) == 0 ? ".PP" : kind(*from) == 1 ? literal(block) : roff(fmt::format("{}", fmt::join(block, "\n"))));
    from = to;
  }
  return fmt::format("{}", fmt::join(blocks, "\n"));
}

std::string listed(const std::vector<Entry>& entries)
{
  std::string text;
  for (const Entry& e : entries) {
    Words names;
    for (const std::string& name : e.names) names.push_back("\\fB" + roff(name) + "\\fR");
    text += fmt::format("{}.TP\n{}{}{}\n{}", text.empty() ? "" : "\n", fmt::join(names, ", "), e.value.empty() ? "" : " \\fI" + e.value + "\\fR",
                        e.several ? " ..." : "", roff(e.text));
  }
  return text;
}

using Rows = std::vector<std::pair<std::string, std::string>>;

std::string pairs(const Rows& rows)
{
  Words parts;
  for (const auto& [name, text] : rows) parts.push_back(".TP\n.B " + roff(name) + "\n" + roff(text));
  return fmt::format("{}", fmt::join(parts, "\n"));
}

std::string references(const Words& names)
{
  Words parts;
  for (const std::string& name : names) parts.push_back(".BR " + roff(name) + " (1)");
  return fmt::format("{}", fmt::join(parts, " ,\n"));
}

/// The line behind "Usage: ", names bold and values italic; `before`: of a command, "mpm".
std::string synopsis(const CLI::App& app, const std::string& before)
{
  const std::string help = app.help(before), mark = "Usage: ";
  const std::size_t from = help.find(mark) + mark.size();
  Words words = CLI::detail::split(help.substr(from, help.find('\n', from) - from), ' ');
  for (std::string& word : words)
    word = (CLI::detail::to_lower(word) != word ? "\\fI" : "\\fB") + roff(word) + "\\fR";
  return fmt::format("{}", fmt::join(words, " "));
}

/// `sections`: (heading, roff); those without text are left out.
std::string page(const std::string& name, const std::string& summary, const Rows& sections)
{
  std::string upper = name;
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  std::string text = fmt::format(".TH {} 1 \"\" \"granulaw {}\" \"Granulaw\"\n.SH NAME\n{} \\- {}\n", upper, version(), roff(name), roff(summary));
  for (const auto& [heading, body] : sections)
    if (!body.empty()) text += ".SH " + heading + "\n" + body + "\n";
  return text;
}

Rows exit_status(bool with_convert)
{
  Rows rows{{"0", "done"},
            {"1", "a file cannot be used: one sentence on stderr says why"},
            {"2", "the command line cannot be understood, or what an option says cannot be used"}};
  if (with_convert) rows.emplace_back("3", "mpm convert: a number is needed that the deck does not say");
  rows.emplace_back("130", "stopped by Ctrl-C");
  return rows;
}
const Rows environment{{"GRANULAW_ATLAS", "the atlas to use in place of the one that came with the program"},
                       {"XDG_CACHE_HOME", "the folder in which finished runs are kept, under granulaw/runs (default: ~/.cache)"}};

std::string page_of_all(const CLI::App& app)
{
  Words commands, others{"liggghts-mpm"};
  for (const CLI::App* one : app.get_subcommands({})) {
    commands.push_back(fmt::format(".TP\n.BR mpm\\-{} (1)\n{}", one->get_name(), roff(first_sentence(in_one_line(one->get_description())))));
    others.push_back("mpm-" + one->get_name());
  }
  Words lines = lines_of(app.get_description());
  const std::string summary = without_stops(lines.front().substr(std::string("mpm: ").size()));
  lines.erase(lines.begin());
  return page("mpm", summary,
              {{"SYNOPSIS", synopsis(app, "")},
               {"DESCRIPTION", prose(lines)},
               {"COMMANDS", fmt::format("{}", fmt::join(commands, "\n"))},
               {"OPTIONS", listed(entries_of(app, false))},
               {"EXIT STATUS", pairs(exit_status(true))},
               {"ENVIRONMENT", pairs(environment)},
               {"SEE ALSO", references(others)}});
}

/// The commands behind "Example: " have a section of their own.
std::string page_of_command(const CLI::App& one)
{
  const std::string mark = "Example: ", whole = one.get_description();
  const std::size_t at = whole.find(mark);
  Words description = lines_of(whole.substr(0, at)), examples;
  while (!description.empty() && CLI::detail::rtrim(description.back()).empty()) description.pop_back();
  if (at != std::string::npos)
    for (std::string line : lines_of(whole.substr(at + mark.size())))
      if (!CLI::detail::trim(line).empty()) examples.push_back(line);
  return page("mpm-" + one.get_name(), first_sentence(fmt::format("{}", fmt::join(description, " "))),
              {{"SYNOPSIS", synopsis(one, "mpm")},
               {"DESCRIPTION", prose(description)},
               {"ARGUMENTS", listed(entries_of(one, true))},
               {"OPTIONS", listed(entries_of(one, false))},
               {"EXAMPLES", examples.empty() ? "" : literal(examples)},
               {"EXIT STATUS", pairs(exit_status(one.get_name() == "convert"))},
               {"SEE ALSO", references({"mpm", "liggghts-mpm"})}});
}

/// Completions behind an argument or an option that takes a text; files, unless it stands here.
std::string text_completion(const std::string& name)
{
  static const std::map<std::string, std::string> others = [] {
    std::map<std::string, std::string> m{
        {"MATERIALS", "files:toml"},
        {"LAW", "files:h5"},
        {"DATA", "files:csv"},
        {"--particle", "heading:particle"},  // [particle.NAME] of the materials file
        {"--against", "heading:particle"},
        {"--wall", "heading:material"},
        {"--indenter", "heading:material"},
        {"--grid", "words:mapped rectilinear tartan updated rectilinear-3d"},
        {"--precision", "words:double single"},
        {"--support", "words:free midplane"},
        {"--fit", "words:youngs_modulus yield_stress hardening_modulus saturation_stress strain strength exponent offset"},
        {"--planes", "words:pair cube die bcc fcc"}};
    for (const char* free : {"--pair", "--var", "--materials", "--prior", "--bounds", "--name", "--guess", "--known", "--speeds", "--displacements", "--shape"})
      m[free] = "nothing";
    return m;
  }();
  const auto found = others.find(name);
  return found == others.end() ? "files" : found->second;
}

std::string completion_of(const Entry& e)
{
  if (e.value != "TEXT") return "nothing";
  if (!e.allowed.starts_with("{")) return text_completion(e.names.back());
  std::string words = e.allowed.substr(1, e.allowed.size() - 2);
  std::replace(words.begin(), words.end(), ',', ' ');
  return "words:" + words;
}

/// Two functions of the shell: the options of a command, and the completion of a value.
std::string completion(const CLI::App& app)
{
  std::string options, values;
  Words commands;
  const auto add = [&](const CLI::App& one, const std::string& command) {
    Words longs;
    for (const Entry& e : entries_of(one, false)) {
      Words patterns;
      for (const std::string& name : e.names) {
        patterns.push_back(command + ":" + name);
        if (name.starts_with("--")) longs.push_back(name);
      }
      if (!e.value.empty()) values += fmt::format("    {}) echo '{}' ;;\n", fmt::join(patterns, "|"), completion_of(e));
    }
    for (const Entry& e : entries_of(one, true)) values += fmt::format("    {}:argument) echo '{}' ;;\n", command, text_completion(e.names.front()));
    options += fmt::format("    {}) echo '{}' ;;\n", command, fmt::join(longs, " "));
  };
  for (const CLI::App* one : app.get_subcommands({})) {
    commands.push_back(one->get_name());
    add(*one, one->get_name());
  }
  Words own;
  for (const Entry& e : entries_of(app, false))
    std::copy_if(e.names.begin(), e.names.end(), std::back_inserter(own), [](const std::string& name) { return name.starts_with("--"); });
  return fmt::format("_mpm_first='{} {}'\n_mpm_options()\n{{\n  case $1 in\n{}  esac\n}}\n_mpm_value()\n{{\n  case $1:$2 in\n{}  esac\n}}\n",
                     fmt::join(commands, " "), fmt::join(own, " "), options, values);
}

}  // namespace

void write_pages(const CLI::App& app, const std::string& folder)
{
  std::filesystem::create_directories(folder);
  write_text_atomically(folder + "/mpm.1", page_of_all(app));
  for (const CLI::App* one : app.get_subcommands({})) write_text_atomically(folder + "/mpm-" + one->get_name() + ".1", page_of_command(*one));
  write_text_atomically(folder + "/completion.bash", completion(app));
}

}  // namespace granulaw
