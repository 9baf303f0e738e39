#pragma once

#include <cstdio>
#include <functional>

// The files of a deck that is planned: nothing that it writes is written. The launcher's own fopen, mkdir and
// so on stand before those of the C library in the whole process, for C++ streams and VTK, too.
namespace granulaw::plan {

/// From now on.
void close_files();
/// As ever again: Open MPI takes its own files away when it ends.
void open_files();

/// Called for each command that is read from a file, before it is executed: "FILE:LINE" of its first line, its text.
/// `is_deck`: the file is one of commands.
void follow_lines(std::function<bool(std::FILE*)> is_deck,
                  std::function<void(const char* where, const char* text)> line);

/// A deck's own command `processors`, for several ranks, leaves the grid to LIGGGHTS.
void read_on_one_rank(std::function<bool(std::FILE*)> is_deck);

/// Called before each line that is read from any file, whether files are closed or not.
void follow_reads(std::function<void(std::FILE*)> read);

/// Called for each file that is opened from now on, with its path.
void follow_files(std::function<void(const char* path, bool is_written)> file);

}  // namespace granulaw::plan
