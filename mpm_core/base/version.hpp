#pragma once

namespace granulaw {

/// Release, for example "0.1.0".
const char* version() noexcept;

/// Commit this binary was configured from, with "-dirty" where the tree had changes.
const char* git_hash() noexcept;

}  // namespace granulaw
