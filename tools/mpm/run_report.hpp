#pragma once

#include <nlohmann/json.hpp>

#include "run_files/checkpoint_file.hpp"
#include "run_request.hpp"
#include "solver/output/trace.hpp"
#include "solver/run/accuracy.hpp"

namespace granulaw {

/// Before the run, for people: body, grid, yield velocity. `velocity`: m/s of an impact; 0: a press.
/// `damage_number`: of the impact (law/damage_number.hpp).
void print_setting(const RunRequest& request, const Particle& particle, double velocity, double damage_number = 0);

/// The centre of mass at an impact in three dimensions, m/s.
struct CentreMotion
{
  double approach = 0;                          ///< towards the wall, before
  double tangential = 0, tangential_after = 0;  ///< along +x of the wall
  int contacts = 1;                             ///< that follow each other (characterise/shape/energetic_restitution.hpp)
};

/// The object of --json. `grid`: name of the grid.
nlohmann::ordered_json run_json(const std::string& grid, const RunResult& result, const CentreMotion& centre = {}, const Attraction& attraction = {});

/// After it: writes the trace if one is asked for, and prints the summary or its JSON.
void report(const RunRequest& request, const Meeting& meeting, const RunResult& result, const CentreMotion& centre = {});

/// Makes the run as the request requires it (resolution or tolerance, progress bar, fields, checkpoint) and
/// reports it. `asked`: the command and its options beyond the request, for the checkpoint's identity.
/// `has_ramp`: of a press. `centre`: is read when the run is done.
void run_and_report(const RunRequest& request, const Meeting& meeting, const RunIdentity& asked, bool has_ramp, const Run& run, const CentreMotion& centre = {});

}  // namespace granulaw
