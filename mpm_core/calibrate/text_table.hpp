#pragma once

#include <string>
#include <vector>

namespace granulaw {

/// A line of a table.
struct TextRow
{
  int line;
  std::vector<std::string> words;
};

/// Lines of a table of text, as spreadsheets, testing machines and editors write them: columns separated by
/// commas, semicolons, tabs or blanks, whichever the first line has; quoted words; CR, LF or both; a byte
/// order mark; a line `sep=;`. Blank lines, lines of separators alone and comments after # are left out, and
/// words after the last that any row needs. Throws Error of a file that is no such text.
std::vector<TextRow> parse_table(const std::string& text, const std::string& source);

/// Writes the numbers of a table with decimal commas by decimal points, from the row `first` on. Throws Error
/// where a comma may as well separate thousands.
void point_decimals(std::vector<TextRow>& rows, std::size_t first, const std::string& source);

/// True: the word is a number, finite or not.
bool is_number(const std::string& word);

}  // namespace granulaw
