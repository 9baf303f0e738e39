#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "commands.hpp"
#include "law/law_file.hpp"

namespace granulaw::tool {

namespace {

std::string find_script(const char* name)
{
  for (const char* folder : {GRANULAW_INSTALLED_SCRIPTS, GRANULAW_SOURCE_SCRIPTS})
    if (const auto path = std::filesystem::path(folder) / name; std::filesystem::exists(path)) return path.string();
  fail("mpm plot", fmt::format("the script '{}' is not installed", name));
}

/// Runs a program with arguments, no shell; throws if it fails.
void run_program(const std::vector<std::string>& words)
{
  const pid_t child = fork();
  if (child < 0) fail("mpm plot", "cannot start another program");
  if (child == 0) {
    std::vector<char*> argv;
    for (const std::string& w : words) argv.push_back(const_cast<char*>(w.c_str()));
    argv.push_back(nullptr);
    execv(argv[0], argv.data());
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    fail("mpm plot", "the plotting script failed; it needs Debian's python3-matplotlib and python3-h5py");
}

}  // namespace

void add_plot(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("plot", "Draw a law: force against overlap, restitution against velocity");
  auto law = std::make_shared<std::string>();
  auto output = std::make_shared<std::string>();
  command->add_option("law", *law, "law file")->required();
  command->add_option("-o,--output", *output, "picture to write (.png, .pdf, .svg)")->required();
  command->callback([=] {
    require_writable(*output, "-o");
    read_law(*law);  // a broken file gets its sentence here, not a Python traceback
    const std::string script = find_script("plot_law.py");
    write_atomically(*output, [&](const std::string& path) { run_program({"/usr/bin/python3", script, *law, path}); });
  });
}

void add_plan(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("plan", "Read a LIGGGHTS deck and say what law it needs (not in this version)");
  auto deck = std::make_shared<std::string>();
  command->add_option("deck", *deck, "LIGGGHTS input script")->required();
  command->callback([] { fail("mpm plan", "this version cannot read decks yet; give `mpm table` the pairs with --pair"); });
}

}  // namespace granulaw::tool
