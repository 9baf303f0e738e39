#undef _FORTIFY_SOURCE  // its inline functions bear the names that are defined here
#include "liggghts_plugin/plan/deck_files.hpp"

#include <dlfcn.h>
#include <mpi.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace granulaw::plan {

namespace {

bool closed = false;

/// A file of commands, read as LIGGGHTS reads it (Input::file): a line may come in parts, as its buffer grows, and a
/// command may go over several lines.
struct Place
{
  std::string path;
  int line = 0;  ///< lines that were read to their end
  int first_line = 0;  ///< of the command that is being read; 0: none is
  std::string command{};
};

/// Files that the deck wrote, by path: in memory, where it can read them again. Negative: it took the file away.
std::map<std::string, int>& written()
{
  static std::map<std::string, int> files;
  return files;
}

std::map<std::FILE*, Place>& places()
{
  static std::map<std::FILE*, Place> open_files;
  return open_files;
}

std::function<bool(std::FILE*)> is_deck_file, is_of_one_rank;
std::function<void(const char*, const char*)> on_line;
std::function<void(const char*, bool)> on_file;
std::function<void(std::FILE*)> on_read;

template <class Function>
Function* next(const char* name)
{
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

using Open = std::FILE*(const char*, const char*);

std::FILE* really_open(const char* path, const char* mode)
{
  static Open* const open = next<Open>("fopen64");
  return open(path, mode);
}

/// Folders that the deck made, none of which is there, and the one of them that it went to; empty: none.
std::set<std::string> made_folders;
std::string made_folder;

std::string key_of(const char* path)
{
  std::error_code ignored;
  const auto whole = std::filesystem::absolute(std::filesystem::path(made_folder) / path, ignored).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).string();
}

int not_there()
{
  errno = ENOENT;
  return -1;
}

int make_folder(const char* path)
{
  made_folders.insert(key_of(path));
  return 0;
}

int go_to_folder(const char* path)
{
  static auto* const go = next<int(const char*)>("chdir");
  if (!closed) return go(path);
  const std::string folder = key_of(path);
  const bool is_made = go(folder.c_str()) != 0;
  if (is_made && !made_folders.contains(folder)) return not_there();
  made_folder = is_made ? folder : "";
  return 0;
}

void copy_into(int memory, const char* path)
{
  std::FILE* from = really_open(path, "r");
  if (!from) return;
  char part[65536];
  for (std::size_t n; (n = std::fread(part, 1, sizeof part, from)) > 0;)
    if (::write(memory, part, n) < 0) break;
  std::fclose(from);
}

std::string path_in_memory(int file)
{
  return "/proc/self/fd/" + std::to_string(file);
}

/// In place of a file that is opened to write.
std::FILE* open_in_memory(const char* path, const char* mode)
{
  const bool keeps = mode[0] != 'w';
  const auto [found, is_new] = written().try_emplace(key_of(path), -1);
  if (found->second < 0) {
    found->second = memfd_create("deck", MFD_CLOEXEC);
    if (keeps && is_new) copy_into(found->second, found->first.c_str());
  }
  return really_open(path_in_memory(found->second).c_str(), mode);
}

bool is_there(const char* path)
{
  const auto own = written().find(key_of(path));
  return own == written().end() ? ::access(key_of(path).c_str(), F_OK) == 0 : own->second >= 0;
}

int take_away(const char* path)
{
  if (!is_there(path)) return not_there();
  written()[key_of(path)] = -1;
  return 0;
}

/// A folder stays where it is.
int move_file(const char* from, const char* to)
{
  if (!is_there(from)) return not_there();
  std::error_code ignored;
  if (std::filesystem::is_directory(key_of(from), ignored)) return 0;
  const auto [found, is_new] = written().try_emplace(key_of(from), -1);
  if (is_new) copy_into(found->second = memfd_create("deck", MFD_CLOEXEC), found->first.c_str());
  written()[key_of(to)] = std::exchange(found->second, -1);
  return 0;
}

std::FILE* open_file(const char* path, const char* mode)
{
  if (!closed || !path || !mode) return really_open(path, mode);
  if (std::strpbrk(mode, "wa+")) {
    if (std::strncmp(path, "/dev/", 5) == 0 || std::strncmp(path, "/proc/", 6) == 0)
      return really_open(path, mode);
    if (on_file) on_file(path, true);
    return open_in_memory(path, mode);
  }
  const auto own = written().find(key_of(path));
  if (own != written().end() && own->second < 0) {
    errno = ENOENT;
    return nullptr;
  }
  std::FILE* file = really_open(own != written().end() ? path_in_memory(own->second).c_str() : made_folder.empty() ? path : key_of(path).c_str(), mode);
  if (file) places()[file] = {path};
  if (file && on_file && own == written().end()) on_file(path, false);
  return file;
}

/// "processors 2 1 1" becomes "processors * * *", of the same length.
void free_grid(char* text)
{
  char* at = text + std::strspn(text, " \t");
  if (std::strncmp(at, "processors", 10) != 0 || !std::isspace(static_cast<unsigned char>(at[10]))) return;
  at += 10;
  for (int word = 0; word < 3; ++word) {
    at += std::strspn(at, " \t");
    const std::size_t length = std::strcspn(at, " \t\r\n");
    if (length == 0) return;
    std::memset(at, ' ', length);
    at[0] = '*';
    at += length;
  }
}

/// True of a file of commands.
bool is_followed(std::FILE* file)
{
  return closed && is_deck_file && is_deck_file(file) && places().contains(file);
}

/// `part`: what was read, of `length` bytes; null: the file has ended. LIGGGHTS takes it up to a byte of zero, and goes on.
void follow_part(std::FILE* file, const char* part, std::size_t length)
{
  Place& place = places().at(file);
  if (part) {
    if (place.first_line == 0) place.first_line = place.line + 1;
    place.command += part;
    place.line += length > 0 && part[length - 1] == '\n' ? 1 : 0;
    if (place.command.empty()) place.first_line = 0;
    if (!place.command.ends_with('\n')) return;
    const auto last = place.command.find_last_not_of(" \t\n\v\f\r");
    if (last != std::string::npos && place.command[last] == '&') return place.command.resize(last);
  }
  if (place.first_line == 0) return;
  const Place whole = std::exchange(place, {place.path, place.line});
  on_line((whole.path + ":" + std::to_string(whole.first_line)).c_str(), whole.command.c_str());
}

}  // namespace

void close_files()
{
  closed = true;
  rlimit files{};  // each file that is written stays open
  if (getrlimit(RLIMIT_NOFILE, &files) != 0) return;
  files.rlim_cur = files.rlim_max;
  setrlimit(RLIMIT_NOFILE, &files);
}

void open_files()
{
  closed = false;
}

void follow_lines(std::function<bool(std::FILE*)> is_deck, std::function<void(const char*, const char*)> line)
{
  is_deck_file = std::move(is_deck);
  on_line = std::move(line);
}

void read_on_one_rank(std::function<bool(std::FILE*)> is_deck)
{
  is_of_one_rank = std::move(is_deck);
}

void follow_reads(std::function<void(std::FILE*)> read)
{
  on_read = std::move(read);
}

void follow_files(std::function<void(const char*, bool)> file)
{
  on_file = std::move(file);
}

}  // namespace granulaw::plan

#define GRANULAW_OWN extern "C" __attribute__((visibility("default")))

GRANULAW_OWN std::FILE* fopen(const char* path, const char* mode)
{
  return granulaw::plan::open_file(path, mode);
}
GRANULAW_OWN std::FILE* fopen64(const char* path, const char* mode)
{
  return granulaw::plan::open_file(path, mode);
}

GRANULAW_OWN char* fgets(char* text, int size, std::FILE* file)
{
  static auto* const read = granulaw::plan::next<char*(char*, int, std::FILE*)>("fgets");
  if (granulaw::plan::on_read) granulaw::plan::on_read(file);
  const bool is_followed = granulaw::plan::is_followed(file);
  const auto begin = is_followed ? ftello(file) : 0;
  char* result = read(text, size, file);
  if (result && granulaw::plan::is_of_one_rank && granulaw::plan::is_of_one_rank(file)) granulaw::plan::free_grid(text);
  if (is_followed) granulaw::plan::follow_part(file, result, static_cast<std::size_t>(ftello(file) - begin));
  return result;
}

GRANULAW_OWN void rewind(std::FILE* file)
{
  static auto* const back = granulaw::plan::next<void(std::FILE*)>("rewind");
  if (granulaw::plan::closed)
    if (const auto place = granulaw::plan::places().find(file); place != granulaw::plan::places().end())
      place->second = {place->second.path};
  back(file);
}

GRANULAW_OWN std::FILE* popen(const char* command, const char* mode)
{
  static auto* const start = granulaw::plan::next<std::FILE*(const char*, const char*)>("popen");
  // gzip -d of a file to read stays; a compressed dump goes nowhere
  return granulaw::plan::closed && mode[0] == 'w' ? granulaw::plan::really_open("/dev/null", "w")
                                                  : start(command, mode);
}

GRANULAW_OWN int system(const char* command)
{
  static auto* const run = granulaw::plan::next<int(const char*)>("system");
  return granulaw::plan::closed ? 0 : run(command);
}

GRANULAW_OWN int mkdir(const char* path, mode_t mode) noexcept
{
  static auto* const make = granulaw::plan::next<int(const char*, mode_t)>("mkdir");
  return granulaw::plan::closed ? granulaw::plan::make_folder(path) : make(path, mode);
}

GRANULAW_OWN int chdir(const char* path) noexcept
{
  return granulaw::plan::go_to_folder(path);
}

GRANULAW_OWN int rmdir(const char* path) noexcept
{
  static auto* const take = granulaw::plan::next<int(const char*)>("rmdir");
  return granulaw::plan::closed ? 0 : take(path);
}

GRANULAW_OWN int unlink(const char* path) noexcept
{
  static auto* const take = granulaw::plan::next<int(const char*)>("unlink");
  return granulaw::plan::closed ? granulaw::plan::take_away(path) : take(path);
}

GRANULAW_OWN int remove(const char* path) noexcept
{
  static auto* const take = granulaw::plan::next<int(const char*)>("remove");
  return granulaw::plan::closed ? granulaw::plan::take_away(path) : take(path);
}

GRANULAW_OWN int rename(const char* from, const char* to) noexcept
{
  static auto* const move = granulaw::plan::next<int(const char*, const char*)>("rename");
  return granulaw::plan::closed ? granulaw::plan::move_file(from, to) : move(from, to);
}

GRANULAW_OWN int MPI_File_open(MPI_Comm comm, const char* path, int mode, MPI_Info info, MPI_File* file)
{
  if (!granulaw::plan::closed || !(mode & (MPI_MODE_WRONLY | MPI_MODE_RDWR | MPI_MODE_CREATE)))
    return PMPI_File_open(comm, path, mode, info, file);
  if (granulaw::plan::on_file) granulaw::plan::on_file(path, true);
  return PMPI_File_open(comm, "/dev/null", MPI_MODE_WRONLY, info, file);
}

/// At the end of LIGGGHTS's error->all.
GRANULAW_OWN int MPI_Finalize()
{
  granulaw::plan::open_files();
  return PMPI_Finalize();
}

/// It ends the process at once: what streams hold, the reason as well, would be lost.
GRANULAW_OWN int MPI_Abort(MPI_Comm comm, int status)
{
  if (granulaw::plan::closed) std::exit(1);
  std::fflush(nullptr);
  return PMPI_Abort(comm, status);
}
