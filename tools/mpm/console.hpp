#pragma once

#include <chrono>
#include <string>

namespace granulaw::tool {

/// A progress bar on stderr, only where stderr is a terminal; cleared when done.
class ProgressBar
{
 public:
  explicit ProgressBar(std::string title);
  ~ProgressBar();
  void show(double fraction, const std::string& what = {});

 private:
  std::string title_;
  bool terminal_;
  std::chrono::steady_clock::time_point start_, last_;
};

/// One sentence on stderr, led by "mpm: ".
void warn(const std::string& sentence);

}  // namespace granulaw::tool
