#pragma once

#include "run_files/checkpoint_file.hpp"
#include "run_report.hpp"
#include "run_request.hpp"
#include "solver/run/accuracy.hpp"

namespace granulaw {

/// Makes the run as the request requires it (resolution or tolerance, progress bar, fields, checkpoint) and
/// reports it. `asked`: the command and its options beyond the request, for the checkpoint's identity.
/// `has_ramp`: of a press. `centre`: is read when the run is done.
void run_and_report(const RunRequest& request, const Meeting& meeting, const RunIdentity& asked,
                    bool has_ramp, const Run& run, const CentreMotion& centre = {});

}  // namespace granulaw
