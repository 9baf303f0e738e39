#pragma once

#include <string>
#include <vector>

namespace granulaw {

/// Runs a Python script of the program (beside it or installed) with these words, `input` on its stdin, to
/// draw the picture `output`. `command` leads messages. Throws Error with the last line of what the script
/// complained of.
void draw_by_python(const char* command, const std::string& script, const std::vector<std::string>& words,
                    const std::string& input, const std::string& output);

}  // namespace granulaw
