// mpm plot: a picture of a law file, drawn by plot_law.py, or of one pair of it, drawn by plot_pair.py.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <memory>
#include <vector>

#include "atlas_path.hpp"
#include "base/error.hpp"
#include "command.hpp"
#include "law/law_file.hpp"
#include "option_checks.hpp"
#include "pair_curves.hpp"
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

/// All of `text`, or as much as is read: one who ended without reading says why on stderr.
void write_all(int pipe_end, const std::string& text)
{
  std::signal(SIGPIPE, SIG_IGN);
  std::size_t done = 0;
  for (ssize_t length; done < text.size(); done += static_cast<std::size_t>(length))
    if ((length = write(pipe_end, text.data() + done, text.size() - done)) <= 0) return;
}

/// Runs the script with these words; it reads `input` on stdin.
Ended run_python(const std::string& script, const std::vector<std::string>& words, const std::string& input)
{
  // its whole path as its name: by "python3" alone Python looks for its modules beside the PATH's first one
  std::vector<const char*> arguments{python, script.c_str()};
  for (const std::string& word : words) arguments.push_back(word.c_str());
  arguments.push_back(nullptr);
  int told[2], complaints[2];
  if (pipe(told) != 0 || pipe(complaints) != 0) fail("mpm plot", "cannot make a pipe");
  const pid_t child = fork();
  if (child < 0) fail("mpm plot", fmt::format("cannot start {}", python));
  if (child == 0) {
    dup2(told[0], STDIN_FILENO);
    dup2(complaints[1], STDERR_FILENO);
    for (const int end : {told[0], told[1], complaints[0], complaints[1]}) close(end);
    execv(python, const_cast<char* const*>(arguments.data()));
    _exit(127);
  }
  close(told[0]);
  close(complaints[1]);
  write_all(told[1], input);
  close(told[1]);
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

struct Request : PairOptions
{
  std::string output;
  std::optional<double> velocity;
};

/// `name`: of a script beside the program.
void draw(const char* name, const std::vector<std::string>& words, const std::string& input,
          const std::string& output)
{
  const std::string script = own_file(name);
  if (script.empty()) fail("mpm plot", fmt::format("{} is not beside the program", name));
  require_success(run_python(script, words, input), output);
  fmt::print("wrote {}\n", output);
}

void plot(const Request& r)
{
  check_output(r.output, ".png, .pdf, .svg");
  const Law law = read_law(r.law);  // its sentence is better than Python's
  if (r.pair.empty()) return draw("plot_law.py", {r.law, r.output}, {}, r.output);
  const auto curves = pair_curves(law, choose_pair(law, r), r.velocity);
  draw("plot_pair.py", {r.output}, curves.dump(), r.output);
}

void define(CLI::App& command)
{
  const auto r = std::make_shared<Request>();
  command.add_option("LAW", r->law, "law file of mpm table")->required();
  define_pair_options(command, *r);
  command
      .add_option("--velocity", r->velocity,
                  "of a pair: the largest approach speed, m/s (default: a hundred yield velocities, or where "
                  "the law ends)")
      ->check(above_zero());
  command.get_option("--pair")->description(
      "a:b or a:wall: draw this pair (default: every material on the rigid wall)");
  for (const char* of_pair : {"--radius", "--radius2", "--velocity"})
    command.get_option(of_pair)->needs(command.get_option("--pair"));
  command.add_option("-o,--output", r->output, "picture, NAME.png, .pdf or .svg")->required();
  command.callback([r] { plot(*r); });
}

}  // namespace

extern const Command plot_command{
    "plot",
    "Draws a law: force against overlap with its unloading branches, and e against velocity beside\n"
    "Thornton's closed form; of a pair also the pair rule, Hertz's force and what waves take.\n"
    "Example: mpm plot law.h5 -o law.png\n"
    "         mpm plot law.h5 --pair powder:steel --radius 5e-4 --radius2 inf -o pair.png",
    define};

}  // namespace granulaw
