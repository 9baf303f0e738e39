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

/// "40 s", "12 minutes", "3.5 hours".
std::string duration_text(double seconds);

/// Progress on stderr with the time left, only when it is asked to be visible: a bar on a terminal, elsewhere (a batch
/// job's log) a line every half minute, and the first after 5 s where over a minute is left. A lower fraction begins the
/// next run. Every update also looks for Ctrl-C.
class ProgressBar
{
 public:
  using Clock = std::chrono::steady_clock;
  /// `every`: between two lines where stderr is no terminal.
  explicit ProgressBar(bool visible = true, Clock::duration every = std::chrono::seconds(30));
  ~ProgressBar() { clear(); }
  void update(double done, const std::string& what);
  void clear();  ///< wipes the bar's line, before something else is printed

 private:
  bool visible_, is_terminal_;
  Clock::duration every_;
  bool is_first_ = true;
  double done_ = 0;
  Clock::time_point start_, last_;
};

}  // namespace granulaw
