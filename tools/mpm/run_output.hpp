#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "materials_file.hpp"
#include "solver/runs.hpp"

namespace granulaw::tool {

/// What `impact` and `press` share on the command line.
struct RunArguments
{
  std::string materials, particle, grid = "mapped", output;
  int resolution = 0;
  double tolerance = 0;
  bool json = false;
};

void add_run_arguments(CLI::App& command, RunArguments& arguments);

/// Runs `run(sphere, options)` as the arguments say (resolution raised until --tolerance is met), writes the trace
/// and prints the summary.
void run_and_report(const RunArguments& arguments, const std::string& title,
                    const std::function<RunResult(const Sphere&, const RunOptions&)>& run);

}  // namespace granulaw::tool
