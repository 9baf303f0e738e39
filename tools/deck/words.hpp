#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "deck/geometry.hpp"
#include "deck/script.hpp"

namespace granulaw::deck {

/// The command cannot be followed: throws Unknown, and the deck's notes say why.
[[noreturn]] void misread(const std::string& why);
/// The same where `word` is none of `known`: names the nearest of them.
[[noreturn]] void misread(const std::string& why, std::string_view word, std::span<const std::string> known);

/// Reads the words of one command in their order. Throws Unknown where a word is missing or cannot be used.
class Words
{
 public:
  explicit Words(const Command& command) : command_(&command) {}

  const std::string& where() const { return command_->where; }
  /// Of the command.
  const std::string& name() const { return command_->words[0]; }
  bool more() const { return at_ < command_->words.size(); }
  const std::string& peek() const;
  const std::string& word();
  double value();
  Vec3 vector();
  /// A number of things, which must not become a huge or negative size.
  std::size_t count();
  int atom_type();
  /// A file's path, as the deck means it.
  std::string path();
  /// Whether the next word is `keyword`; if so, goes on behind it.
  bool take(std::string_view keyword);
  /// The words behind the next occurrence of `keyword`; empty: there is none.
  std::optional<Words> after(std::string_view keyword) const;
  /// The same where the command needs it.
  Words behind(std::string_view keyword) const;

 private:
  const Command* command_;
  std::size_t at_ = 1;  // behind the command's name
};

}  // namespace granulaw::deck
