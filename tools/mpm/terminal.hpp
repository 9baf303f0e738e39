#pragma once

#include <chrono>
#include <string>

namespace granulaw {

/// Thrown where a run stops because of Ctrl-C or SIGTERM.
struct Interrupted
{
};

/// Ctrl-C and SIGTERM from now on only set a flag; the second one ends the program at once.
void catch_interrupts();
bool is_interrupted();
/// Throws Interrupted once the flag is set.
void stop_if_interrupted();

/// A bar on stderr, drawn only when it is asked to be visible and stderr is a terminal; every update also
/// looks for Ctrl-C.
class ProgressBar
{
 public:
  explicit ProgressBar(bool visible = true);
  ~ProgressBar() { clear(); }
  void update(double done, const std::string& what);
  void clear();  ///< wipes the bar's line, before something else is printed

 private:
  bool visible_;
  std::chrono::steady_clock::time_point start_, last_{};
};

}  // namespace granulaw
