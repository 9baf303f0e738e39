#include "python_script.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
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

/// A file in memory that holds `text`: a pipe would have to be filled while the script is heard.
int file_of(const char* command, const std::string& text)
{
  const int file = memfd_create("input", 0);
  std::size_t done = 0;
  for (ssize_t length; file >= 0 && done < text.size(); done += static_cast<std::size_t>(length))
    if ((length = write(file, text.data() + done, text.size() - done)) <= 0) break;
  if (file < 0 || done < text.size() || lseek(file, 0, SEEK_SET) != 0) fail(command, "cannot hand over its data (memory full?)");
  return file;
}

/// Runs the script with these words; it reads `input` on stdin.
Ended run_python(const char* command, const std::string& script, const std::vector<std::string>& words,
                 const std::string& input)
{
  // its whole path as its name: by "python3" alone Python looks for its modules beside the PATH's first one
  std::vector<const char*> arguments{python, script.c_str()};
  for (const std::string& word : words) arguments.push_back(word.c_str());
  arguments.push_back(nullptr);
  const int told = file_of(command, input);
  int complaints[2];
  if (pipe(complaints) != 0) fail(command, "cannot make a pipe");
  const pid_t child = fork();
  if (child < 0) fail(command, fmt::format("cannot start {}", python));
  if (child == 0) {
    dup2(told, STDIN_FILENO);
    dup2(complaints[1], STDERR_FILENO);
    for (const int end : {told, complaints[0], complaints[1]}) close(end);
    execv(python, const_cast<char* const*>(arguments.data()));
    _exit(127);
  }
  close(told);
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

void draw_by_python(const char* command, const std::string& script, const std::vector<std::string>& words,
                    const std::string& input, const std::string& output)
{
  const std::string path = own_file(script);
  if (path.empty()) fail(command, fmt::format("{} is not beside the program", script));
  require_success(command, run_python(command, path, words, input), output);
}

}  // namespace granulaw
