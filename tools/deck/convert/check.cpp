#include "deck/convert/check.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

namespace granulaw::deck {

namespace {

namespace fs = std::filesystem;

/// Names without the number of the step.
std::set<std::string> without_numbers(const std::vector<std::string>& files)
{
  std::set<std::string> names;
  for (const std::string& file : files) {
    std::string name;
    for (const char ch : file) {
      const bool digit = ch >= '0' && ch <= '9';
      if (!digit)
        name += ch;
      else if (name.empty() || name.back() != '*')
        name += '*';
    }
    names.insert(name);
  }
  return names;
}

/// Those of `a` that are not in `b`.
std::vector<std::string> alone(const std::vector<std::string>& a, const std::vector<std::string>& b)
{
  const std::set<std::string> in_a = without_numbers(a), in_b = without_numbers(b);
  std::vector<std::string> result;
  std::set_difference(in_a.begin(), in_a.end(), in_b.begin(), in_b.end(), std::back_inserter(result));
  return result;
}

}  // namespace

Checked check(const Scene& scene, const fs::path& folder, double step_factor)
{
  constexpr long long steps = 300;
  const std::string name = fs::path(scene.deck).filename().string();
  const ShortRun before = short_run(scene.folder, words_of(scene.folder.empty() ? scene.deck : name, scene.presets), steps);
  const double done = before.ended ? before.steps : static_cast<double>(steps);
  const ShortRun after = short_run(folder.string(), words_of(name, scene.presets), static_cast<long long>(std::ceil(done * step_factor)));
  return {before, after, alone(before.files, after.files), alone(after.files, before.files)};
}

}  // namespace granulaw::deck
