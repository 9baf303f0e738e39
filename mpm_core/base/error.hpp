#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace granulaw {

/// Input or a user's action that cannot be used: one sentence, no stack trace. Errors of the programmer are
/// assertions.
class Error : public std::runtime_error
{
 public:
  using std::runtime_error::runtime_error;
};

/// `text` as it may go to a terminal: control characters (line breaks, escape sequences) become '?'. For
/// whatever comes from a file.
std::string printable(std::string_view text);

/// Throws Error "WHERE: WHAT: found FOUND, allowed is ALLOWED". Empty parts are left out.
/// WHERE is a file and line, a key or an option; it always leads. The sentence is printable().
[[noreturn]] void fail(std::string_view where, std::string_view what, std::string_view found = {},
                       std::string_view allowed = {});

/// The candidate with the smallest edit distance to `word`, or "" where none is near
/// (distance over half of the word's length).
std::string nearest(std::string_view word, std::span<const std::string> candidates);

/// " (did you mean 'X'?)" or "".
std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);

/// `text` as a sentence can hold it: cut after `longest` bytes, between characters.
std::string cut(std::string_view text, std::size_t longest = 60);

/// "a, b, c", each word cut; of many words the first twenty and their number.
std::string list_of(std::span<const std::string> words);

/// Throws Error "WHERE: WHAT 'WORD' (did you mean 'X'?): allowed is KNOWN". WHAT: "no material", "unknown
/// key". `more` follows the list of what is known.
[[noreturn]] void fail_unknown(std::string_view where, std::string_view what, std::string_view word,
                               std::span<const std::string> known, std::string_view more = {});

}  // namespace granulaw
