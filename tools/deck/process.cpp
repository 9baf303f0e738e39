#include "deck/process.hpp"

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "base/error.hpp"

namespace granulaw {

namespace {

/// Open MPI would take a program that a rank starts for the rank itself.
void leave_mpi()
{
  std::vector<std::string> names;
  for (char** entry = environ; *entry; ++entry) {
    const std::string text = *entry;
    for (const char* prefix : {"PMIX_", "PMI_", "OMPI_COMM_", "OMPI_UNIVERSE_", "OMPI_MCA_orte", "OMPI_MCA_ess_base"})
      if (text.starts_with(prefix)) names.push_back(text.substr(0, text.find('=')));
  }
  for (const std::string& name : names) unsetenv(name.c_str());
}

[[noreturn]] void start(const Process& process, const int output[2])
{
  std::vector<char*> arguments;
  for (const std::string& word : process.words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  if (process.input >= 0) dup2(process.input, STDIN_FILENO);
  if (!process.keeps_stdout) dup2(output[1], STDOUT_FILENO);
  dup2(output[1], STDERR_FILENO);
  close(output[0]);
  close(output[1]);
  leave_mpi();
  if (process.folder.empty() || chdir(process.folder.c_str()) == 0) execv(arguments[0], arguments.data());
  _exit(127);
}

}  // namespace

std::string own_file(const std::string& name)
{
  namespace fs = std::filesystem;
  const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
  for (const fs::path& candidate : {here / name, here / "../share/granulaw" / name, here / "../../liggghts_plugin" / name})
    if (fs::exists(candidate)) return candidate.string();
  return {};
}

int memory_file(const std::string& who, const std::string& text)
{
  const int file = memfd_create("granulaw", 0);
  std::size_t done = 0;
  for (ssize_t length; file >= 0 && done < text.size(); done += static_cast<std::size_t>(length))
    if ((length = write(file, text.data() + done, text.size() - done)) <= 0) break;
  if (file < 0 || done < text.size() || lseek(file, 0, SEEK_SET) != 0) fail(who, "cannot hand over its data (memory full?)");
  return file;
}

std::string read_all(int file)
{
  std::string all;
  char part[65536];
  for (ssize_t length; (length = read(file, part, sizeof part)) > 0;) all.append(part, static_cast<std::size_t>(length));
  return all;
}

Ended run_process(const Process& process)
{
  int output[2];
  if (pipe(output) != 0) fail(process.words[0], "cannot make a pipe");
  const pid_t child = fork();
  if (child == 0) start(process, output);
  close(output[1]);
  Ended ended{.said = read_all(output[0])};
  close(output[0]);
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child) fail(process.words[0], "cannot be started");
  ended.exit = WIFEXITED(status) ? WEXITSTATUS(status) : 1;
  ended.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  return ended;
}

}  // namespace granulaw
