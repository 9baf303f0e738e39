#pragma once

#include <string>
#include <utility>
#include <vector>

#include "deck/commands/handlers.hpp"

namespace granulaw::deck {

/// Of fix particletemplate.
struct Template
{
  int type = 1;
  double radius_min = 0, radius_max = 0;
  double density = 0;  ///< the largest

  double mean_volume() const;  ///< of the mean radius
};

/// Of fix particledistribution.
struct Distribution
{
  std::vector<std::pair<std::string, double>> parts;  ///< ID of the template, share of mass
};

/// `fix ID group particletemplate/... atom_type T density ... radius ...`
void follow_template(Reading& reading, const Fix& fix, Words words);
/// `fix ID group particledistribution/... SEED N ID SHARE ...`
void follow_distribution(Reading& reading, const Fix& fix, Words words);

}  // namespace granulaw::deck
