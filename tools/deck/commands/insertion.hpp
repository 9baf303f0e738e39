#pragma once

#include <string>
#include <vector>

#include "deck/commands/handlers.hpp"

namespace granulaw::deck {

/// A fix insert/... while it is on. Where a number is 0 the deck does not say it.
struct Insertion
{
  std::vector<std::size_t> sources;  ///< in Scene::sources
  std::vector<double> shares;        ///< of each in the number of particles
  double total = 0;                  ///< particles at most
  double rate = 0;                   ///< particles in the deck's unit of time
  double each = 0;                   ///< particles of one insertion
  double every = 0;                  ///< steps from one insertion to the next
  double inserted = 0;               ///< particles so far
};

/// `fix ID group insert/... distributiontemplate ID ...`
void follow_insertion(Reading& reading, const Fix& fix, Words words);

/// Brings in what the insertions add within a run.
void insert_particles(Reading& reading, double steps, double duration);

}  // namespace granulaw::deck
