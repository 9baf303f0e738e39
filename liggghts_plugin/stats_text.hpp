#pragma once

#include <string>

#include "liggghts_plugin/ledger.hpp"

namespace granulaw::plugin {

/// The start-up table: one line for each pair of types that can meet. In SI. Empty if there is none.
std::string start_table(const ContactLedger& ledger, const DeckUnits& units);

/// The line at the end of a run, from the sums of all ranks, in SI. `inertia_limit`: largest rho V^2/Y that
/// the laws answer for, 0: not stated; `largest_dt`: s, of the steps that were taken.
std::string end_line(const ContactLedger& sum, const DeckUnits& units, double inertia_limit,
                     double largest_dt);

}  // namespace granulaw::plugin
