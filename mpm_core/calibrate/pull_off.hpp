#pragma once

#include <string>
#include <vector>

#include "law/law.hpp"

namespace granulaw {

/// A contact that was slowly pressed and drawn off.
struct PullOff
{
  double preload = 0, pull_off = 0;  ///< N, both over 0
};
/// A text whose header is preload_N,pull_off_N. Throws Error led by `source`.
std::vector<PullOff> parse_pull_offs(const std::string& text, const std::string& source);
/// The same of a file.
std::vector<PullOff> read_pull_offs(const std::string& path);

/// Work of adhesion that pull-off forces show, J/m2.
struct FoundAdhesion
{
  double work = 0, low = 0, high = 0;  ///< 95 %: scatter of the data, and the law's error at their chi
  double scatter = 0;                  ///< standard deviation of ln(measured/law's pull-off)
  double trend = 0, trend_sd = 0;      ///< slope of that over ln preload: 0 where the dent explains the growth
};
/// At the best w by least squares of ln(pull-off). Throws Error led by `source` where a preload is beyond the law, or adhesion does not
/// hold for such surfaces (DentAdhesion::fault); `range`: of attraction, m.
FoundAdhesion fit_adhesion(const PairLaw& pair, double r_eff, const std::vector<PullOff>& data, double range, const std::string& source);

}  // namespace granulaw
