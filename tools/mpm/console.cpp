#include "console.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

namespace granulaw::tool {

using namespace std::chrono_literals;

ProgressBar::ProgressBar(std::string title)
    : title_(std::move(title)), terminal_(isatty(STDERR_FILENO)), start_(std::chrono::steady_clock::now()), last_(start_ - 1s)
{
}

ProgressBar::~ProgressBar()
{
  if (terminal_) fmt::print(stderr, "\r\033[K");
}

void ProgressBar::show(double fraction, const std::string& what)
{
  const auto now = std::chrono::steady_clock::now();
  if (!terminal_ || now - last_ < 100ms) return;
  last_ = now;
  fraction = std::clamp(fraction, 0.0, 1.0);
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const auto filled = static_cast<std::size_t>(30 * fraction);
  const std::string left = fraction > 0.02 ? fmt::format("{:.0f} s left", elapsed * (1 - fraction) / fraction) : "";
  fmt::print(stderr, "\r\033[K{} [{}{}] {:3.0f} %  {}  {}", title_, std::string(filled, '#'), std::string(30 - filled, '.'),
             100 * fraction, left, what);
  std::fflush(stderr);
}

void warn(const std::string& sentence) { fmt::print(stderr, "mpm: {}\n", sentence); }

}  // namespace granulaw::tool
