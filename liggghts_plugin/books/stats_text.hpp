#pragma once

#include <string>

#include "liggghts_plugin/books/contact_statistics.hpp"

namespace granulaw::plugin {

/// The start-up table: one line for each pair of types that can meet. In SI. Empty if there is none.
std::string start_table(const ContactStatistics& statistics, const DeckUnits& units);

/// Contacts of a run that were deeper than PairInfo::deep_overlap.
struct DeepContacts
{
  double contacts = 0;   ///< ended and open
  double particles = 0;  ///< with two or more of them at once
};

/// The table at the end of a run, from the sums of all ranks, in SI. `largest_dt`: s, of the steps that were
/// taken.
std::string end_table(const ContactStatistics& sum, const DeckUnits& units, const DeepContacts& deep,
                      double largest_dt);

}  // namespace granulaw::plugin
