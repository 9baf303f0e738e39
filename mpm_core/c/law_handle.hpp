#pragma once

#include <memory>

#include "c/granulaw.h"
#include "law/law.hpp"

namespace granulaw {

/// A law in memory as granulaw.h has it, for bindings in C++; granulaw_close() ends it.
granulaw_law* law_handle(std::shared_ptr<const Law> law);

}  // namespace granulaw
