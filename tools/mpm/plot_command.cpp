// mpm plot: a picture of a law file, drawn by plot_law.py.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <memory>

#include "atlas_path.hpp"
#include "base/error.hpp"
#include "command.hpp"
#include "law/law_file.hpp"
#include "trace_file.hpp"

namespace granulaw {

namespace {

constexpr const char* python = "/usr/bin/python3";

/// A program that has ended.
struct Ended
{
  int status;        ///< of waitpid()
  std::string said;  ///< on stderr
};

std::string read_all(int pipe_end)
{
  std::string all;
  char part[4096];
  for (ssize_t length; (length = read(pipe_end, part, sizeof part)) > 0;)
    all.append(part, static_cast<std::size_t>(length));
  return all;
}

Ended run_python(const std::string& script, const std::string& law, const std::string& output)
{
  int complaints[2];
  if (pipe(complaints) != 0) fail("mpm plot", "cannot make a pipe");
  const pid_t child = fork();
  if (child < 0) fail("mpm plot", fmt::format("cannot start {}", python));
  if (child == 0) {
    dup2(complaints[1], STDERR_FILENO);
    close(complaints[0]);
    close(complaints[1]);
    // its whole path as its name: by "python3" alone Python looks for its modules beside the PATH's first one
    execl(python, python, script.c_str(), law.c_str(), output.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  close(complaints[1]);
  Ended ended{0, read_all(complaints[0])};
  close(complaints[0]);
  waitpid(child, &ended.status, 0);
  return ended;
}

void require_success(Ended ended, const std::string& output)
{
  if (WIFEXITED(ended.status) && WEXITSTATUS(ended.status) == 127)
    fail("mpm plot", fmt::format("{} is missing (Debian: python3-matplotlib, python3-h5py)", python));
  if (WIFEXITED(ended.status) && WEXITSTATUS(ended.status) == 0) return;
  std::string& said = ended.said;
  while (said.ends_with('\n')) said.pop_back();  // a traceback's last line says what went wrong
  fail(output, "cannot be drawn", said.substr(said.rfind('\n') + 1));
}

void plot(const std::string& law, const std::string& output)
{
  check_output(output, ".png, .pdf, .svg");
  read_law(law);  // its sentence is better than Python's
  const std::string script = own_file("plot_law.py");
  if (script.empty()) fail("mpm plot", "plot_law.py is not beside the program");
  require_success(run_python(script, law, output), output);
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
