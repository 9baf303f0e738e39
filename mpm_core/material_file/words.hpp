#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace granulaw {

/// The words of a line, between blanks.
inline std::vector<std::string> words_of(const std::string& line)
{
  std::istringstream text(line);
  std::vector<std::string> words;
  for (std::string word; text >> word;) words.push_back(word);
  return words;
}

/// The same up to a comment, which '#' begins.
inline std::vector<std::string> words_before_comment(const std::string& line)
{
  return words_of(line.substr(0, line.find('#')));
}

}  // namespace granulaw
