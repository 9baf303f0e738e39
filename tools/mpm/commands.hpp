#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace granulaw {

/// Each command adds its options and its callback to the application; one file each.
void add_impact(CLI::App& app);
void add_press(CLI::App& app);
void add_table(CLI::App& app);
void add_atlas(CLI::App& app);
void add_law(CLI::App& app);
void add_check(CLI::App& app);
void add_info(CLI::App& app);
void add_plot(CLI::App& app);
void add_export(CLI::App& app);
void add_plan(CLI::App& app);
void add_soften(CLI::App& app);

/// The command line as typed, for provenance; set by main.
extern std::string command_line;

}  // namespace granulaw
