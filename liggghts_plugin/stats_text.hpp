#pragma once

#include <string>

#include "liggghts_plugin/contact_statistics.hpp"

namespace granulaw::plugin {

/// The start-up table: one line for each pair of types that can meet. In SI. Empty if there is none.
std::string start_table(const ContactStatistics& statistics, const DeckUnits& units);

/// The line at the end of a run, from the sums of all ranks, in SI. `damage_number_limit`: largest rho V^2/Y
/// that the laws answer for, 0: not stated; `largest_dt`: s, of the steps that were taken.
std::string end_line(const ContactStatistics& sum, const DeckUnits& units, double damage_number_limit,
                     double largest_dt);

}  // namespace granulaw::plugin
