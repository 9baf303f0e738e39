#include "python_script.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "atlas_path.hpp"
#include "base/error.hpp"

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

Ended run_python(const char* command, const std::string& script, const std::string& input,
                 const std::string& output)
{
  int complaints[2];
  if (pipe(complaints) != 0) fail(command, "cannot make a pipe");
  const pid_t child = fork();
  if (child < 0) fail(command, fmt::format("cannot start {}", python));
  if (child == 0) {
    dup2(complaints[1], STDERR_FILENO);
    close(complaints[0]);
    close(complaints[1]);
    // its whole path as its name: by "python3" alone Python looks for its modules beside the PATH's first one
    execl(python, python, script.c_str(), input.c_str(), output.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  close(complaints[1]);
  Ended ended{0, read_all(complaints[0])};
  close(complaints[0]);
  waitpid(child, &ended.status, 0);
  return ended;
}

void require_success(const char* command, Ended ended, const std::string& output)
{
  if (WIFEXITED(ended.status) && WEXITSTATUS(ended.status) == 127)
    fail(command, fmt::format("{} is missing (Debian: python3-matplotlib, python3-h5py)", python));
  if (WIFEXITED(ended.status) && WEXITSTATUS(ended.status) == 0) return;
  std::string& said = ended.said;
  while (said.ends_with('\n')) said.pop_back();  // a traceback's last line says what went wrong
  fail(output, "cannot be drawn", said.substr(said.rfind('\n') + 1));
}

}  // namespace

void draw_by_python(const char* command, const std::string& script, const std::string& input,
                    const std::string& output)
{
  const std::string path = own_file(script);
  if (path.empty()) fail(command, fmt::format("{} is not beside the program", script));
  require_success(command, run_python(command, path, input, output), output);
}

}  // namespace granulaw
