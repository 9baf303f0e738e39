#pragma once

#include <string>
#include <vector>

namespace granulaw {

/// `values` has `count` entries, each from `low` to `high` (NaN is not): else Error naming `where` and
/// `name`.
void check_values(const std::vector<double>& values, std::size_t count, double low, double high,
                  const std::string& where, const std::string& name);

/// The nodes may be sane and the cubic after node `node` not, where a slope is wild: its turning points lie
/// from `low` to `high`, else Error.
void check_between(const double (&c)[4], double low, double high, const std::string& where,
                   const std::string& name, std::size_t node);

}  // namespace granulaw
