#include "terminal.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>

namespace granulaw {

namespace {

volatile std::sig_atomic_t interrupted = 0;
extern "C" void remember_interrupt(int) { interrupted = 1; }

}  // namespace

void catch_interrupts()
{
  struct sigaction once = {};
  once.sa_handler = remember_interrupt;
  once.sa_flags = SA_RESETHAND | SA_RESTART;
  sigaction(SIGINT, &once, nullptr);
  sigaction(SIGTERM, &once, nullptr);
}

bool is_interrupted() { return interrupted != 0; }

void stop_if_interrupted()
{
  if (interrupted) throw Interrupted{};
}

std::string duration_text(double seconds)
{
  if (seconds < 99.5) return fmt::format("{:.0f} s", seconds);
  if (seconds < 99.5 * 60) return fmt::format("{:.0f} minutes", seconds / 60);
  return fmt::format("{:.2g} hours", seconds / 3600);
}

ProgressBar::ProgressBar(bool visible, Clock::duration every)
    : visible_(visible),
      is_terminal_(isatty(STDERR_FILENO) != 0),
      every_(is_terminal_ ? std::chrono::milliseconds(100) : every),
      start_(Clock::now()),
      last_(is_terminal_ ? Clock::time_point{} : start_)
{
}

void ProgressBar::clear()
{
  if (visible_ && is_terminal_) fmt::print(stderr, "\r{:79}\r", "");
}

void ProgressBar::update(double done, const std::string& what)
{
  stop_if_interrupted();
  const auto now = Clock::now();
  if (done < done_) start_ = now;
  done_ = done;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double left = done > 0 ? seconds * (1 - done) / done : 0;
  const bool costs_much = is_first_ && !is_terminal_ && seconds > 5 && left > 60;
  if (!visible_ || (now - last_ < every_ && !costs_much)) return;
  last_ = now, is_first_ = false;
  const std::string remains = duration_text(left) + " left";
  if (!is_terminal_) return fmt::print(stderr, "mpm: {:.0f} % after {:.0f} s, {}{}{}\n", 100 * done, seconds, remains, what.empty() ? "" : ": ", what);
  const auto width = static_cast<int>(20 * std::clamp(done, 0.0, 1.0));
  fmt::print(stderr, "\r[{:20}] {:3.0f} % {:4.0f} s, {:15} {:24.24}", std::string(static_cast<std::size_t>(width), '='), 100 * done, seconds, remains, what);
  std::fflush(stderr);
}

}  // namespace granulaw
