#pragma once

#include <string>

namespace granulaw {

/// Runs a Python script of the program (beside it or installed) with two words, an input and the picture it
/// shall draw. `command` leads messages. Throws Error with the last line of what the script complained of.
void draw_by_python(const char* command, const std::string& script, const std::string& input,
                    const std::string& output);

}  // namespace granulaw
