#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

// Lists on the command line: "a,b", "a, b" and "a b" behind an option that is one (Option::list) are the same.
namespace granulaw {

/// Each item of a list becomes a word.
std::vector<std::string> split_lists(const CLI::App& command, const std::vector<std::string>& words);

/// With the file that a list has taken before its command, whose own it is: `--materials a,b in.deck`. Empty: no list
/// ends with a file.
std::vector<std::string> give_file_back(const CLI::App& command, const std::vector<std::string>& words);

}  // namespace granulaw
