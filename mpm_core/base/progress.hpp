#pragma once

#include <functional>
#include <string>

namespace granulaw {

/// Progress callback: gets the fraction of a batch that is done, 0..1, and which run goes on; some ten times
/// a second, by the thread that called Farm::run. May throw to stop.
using Progress = std::function<void(double done, const std::string& what)>;

}  // namespace granulaw
