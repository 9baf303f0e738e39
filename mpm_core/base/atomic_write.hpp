#pragma once

#include <functional>
#include <string>

namespace granulaw {

/// Calls `write(temporary path)` and renames the result to `path`: readers see the old file or the new one,
/// never a part, and nothing is lost where writing fails (the temporary file is removed, the exception goes
/// on). A symbolic link stays, and the file that it names is written. Throws Error where `path` is a folder, a device
/// or a pipe. The temporary file stands beside the file and keeps its ending. Any number of threads, processes and
/// machines that share the folder may write one path at once: the last one's file stays.
void write_atomically(const std::string& path, const std::function<void(const std::string&)>& write);

/// The same for bytes at hand. Throws Error if they cannot be written.
void write_text_atomically(const std::string& path, const std::string& text);

/// The file that `path` names, which may not exist: links followed. Throws Error where they lead to themselves.
std::string linked_file(const std::string& path);

/// Throws Error now if `path` could not be written later: its folder is missing or not writable, or it is no regular
/// file.
void require_writable(const std::string& path, const std::string& where);

/// Refuses an output name that could not be written, before the work starts: its folder must exist, and the
/// ending be one of `endings` (".csv, .h5"); the complaint of an ending names `option`. An empty path is none.
void check_output(const std::string& option, const std::string& path, const std::string& endings);

}  // namespace granulaw
