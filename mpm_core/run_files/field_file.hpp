#pragma once

#include <functional>
#include <string>

#include "solver/runs.hpp"

namespace granulaw {

/// Throws Error now if `path` (NAME.xdmf) cannot become a field series.
void check_field_output(const std::string& path);

/// Calls `run` with an observer that writes NAME.h5 while the run goes on, then NAME.xdmf, which ParaView
/// opens; both appear under their names only when they are complete. A run that starts again (--tolerance)
/// replaces the frames. Layout: docs/reference/fields.md.
RunResult run_with_fields(const std::string& path, int frames,
                          const std::function<RunResult(const FieldObserver&)>& run);

}  // namespace granulaw
