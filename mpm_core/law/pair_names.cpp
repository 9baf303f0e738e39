#include "law/pair_names.hpp"

#include <fmt/format.h>

#include "base/error.hpp"

namespace granulaw {

namespace {

[[noreturn]] void refuse(const std::string& text, const std::string& allowed)
{
  fail("--pair", "cannot be used", fmt::format("'{}'", text), allowed);
}

}  // namespace

PairNames split_pair(const std::string& text)
{
  const auto colon = text.find(':');
  return {text.substr(0, colon), colon == std::string::npos ? std::string() : text.substr(colon + 1)};
}

PairNames pair_option(const std::string& text, const Law& law)
{
  if (text.find(':') == std::string::npos) refuse(text, law.pair_list());
  return split_pair(text);
}

std::vector<PairNames> pairs_asked(const std::string& text, const Law& law)
{
  if (!text.empty()) return {pair_option(text, law)};
  std::vector<PairNames> all;
  for (const LawPair& pair : law.pairs) all.emplace_back(pair.a, pair.b);
  return all;
}

PairNames new_pair(const std::string& text)
{
  const PairNames pair = split_pair(text);
  const auto& [a, b] = pair;
  if (a.empty() || b.empty() || (a == wall_name && b == wall_name))
    refuse(text, "a:b or a:wall, with names of materials or particles");
  return pair;
}

}  // namespace granulaw
