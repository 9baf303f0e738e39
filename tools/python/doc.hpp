#pragma once

#include <string>
#include <string_view>

/// The docstring of a name in granulaw/__init__.pyi, such as "Pair.force".
const char* doc(std::string_view name);
