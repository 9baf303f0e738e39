#include "deck/convert/step_counts.hpp"

#include <algorithm>
#include <map>

namespace granulaw::deck {

namespace {

using Words = std::vector<std::string>;

/// Places of the counts in `fix ID GROUP STYLE ...`, and words behind which one stands.
struct FixCounts
{
  std::vector<std::size_t> places;
  std::vector<std::string> keywords;
};

bool begins(const std::string& text, const char* with)
{
  return text.rfind(with, 0) == 0;
}

FixCounts counts_of_fix(const std::string& style)
{
  static const std::map<std::string, FixCounts> known{
      {"ave/time", {{4, 6}, {}}},      {"ave/spatial", {{4, 6}, {}}},   {"ave/atom", {{4, 6}, {}}},
      {"ave/histo", {{4, 6}, {}}},     {"ave/correlate", {{4, 6}, {}}}, {"ave/euler", {{}, {"nevery"}}},
      {"ave/euler/region", {{}, {"nevery"}}},
      {"print", {{4}, {}}},            {"adapt", {{4}, {}}},            {"check/timestep/gran", {{4}, {}}},
      {"check/timestep/sph", {{4}, {}}}, {"momentum", {{4}, {}}},       {"store/state", {{4}, {}}},
      {"deform", {{4}, {}}},           {"couple/cfd", {{}, {"couple_every", "every"}}},
      {"massflow/mesh/sieve", {{}, {}}},
  };
  if (begins(style, "insert/")) return {{}, {"insert_every", "start"}};
  const auto found = known.find(style);
  return found == known.end() ? FixCounts{} : found->second;
}

}  // namespace

std::vector<std::size_t> step_counts(const Words& words)
{
  std::vector<std::size_t> places;
  if (words.size() < 2) return places;
  const std::string& command = words[0];
  const auto behind = [&](const std::vector<std::string>& keywords, std::size_t from) {
    for (std::size_t k = from; k + 1 < words.size(); ++k)
      if (std::find(keywords.begin(), keywords.end(), words[k]) != keywords.end()) places.push_back(k + 1);
  };
  if (command == "run") {
    places.push_back(1);
    behind({"start", "stop", "every"}, 2);
  } else if (command == "thermo" || command == "restart" || command == "reset_timestep") {
    places.push_back(1);
  } else if (command == "dump" && words.size() > 4) {
    places.push_back(4);
  } else if (command == "dump_modify") {
    behind({"every"}, 2);
  } else if (command == "fix" && words.size() > 3) {
    const FixCounts counts = counts_of_fix(words[3]);
    for (const std::size_t k : counts.places)
      if (k < words.size()) places.push_back(k);
    behind(counts.keywords, 4);
  }
  return places;
}

}  // namespace granulaw::deck
