#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "deck/words.hpp"

namespace granulaw::deck {

/// What a deck has named, things of one kind, by their ID.
template <class Thing>
class Named
{
 public:
  /// `kind`: the word for such a thing in messages.
  explicit Named(std::string kind) : kind_(std::move(kind)) {}

  void put(const std::string& id, Thing thing) { things_.insert_or_assign(id, std::move(thing)); }
  void erase(const std::string& id) { things_.erase(id); }

  /// Throws Unknown with the ID and the nearest known one.
  const Thing& at(const std::string& id) const
  {
    const auto found = things_.find(id);
    if (found == things_.end()) misread("no " + kind_ + " '" + id + "' is known", id, ids());
    return found->second;
  }
  Thing& at(const std::string& id) { return const_cast<Thing&>(std::as_const(*this).at(id)); }

  auto begin() { return things_.begin(); }
  auto end() { return things_.end(); }

 private:
  std::string kind_;
  std::map<std::string, Thing> things_;

  std::vector<std::string> ids() const
  {
    std::vector<std::string> result;
    for (const auto& entry : things_) result.push_back(entry.first);
    return result;
  }
};

}  // namespace granulaw::deck
