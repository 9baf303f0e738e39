#pragma once

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "material_file/material_range.hpp"

namespace granulaw {

using Words = std::vector<std::string>;

/// One table of the file, with the words that lead its messages.
class Section
{
 public:
  Section(const std::string& path, const toml::table& table, std::string name)
      : path_(path), table_(table), name_(cut(name))
  {
  }

  std::string where(const toml::node& node) const
  {
    return fmt::format("{}:{}: [{}]", path_, node.source().begin.line, name_);
  }
  std::string where() const { return where(table_); }

  void check_keys(const Words& known) const
  {
    for (const auto& [key, node] : table_) {
      const std::string word(key.str());
      if (std::find(known.begin(), known.end(), word) == known.end())
        fail_unknown(where(node), "unknown key", word, known);
    }
  }
  bool has(const char* key) const { return table_.contains(key); }
  const toml::node& node(const char* key) const
  {
    const toml::node* found = table_.get(key);
    if (!found) fail(where(), fmt::format("the key '{}' is missing", key));
    return *found;
  }
  double number(const char* key, const char* unit) const
  {
    const toml::node& n = node(key);
    if (n.is_floating_point()) return n.as_floating_point()->get();
    if (n.is_integer()) return static_cast<double>(n.as_integer()->get());
    fail(where(n), fmt::format("'{}' must be a number{}", key, *unit ? fmt::format(" in {}", unit) : ""));
  }
  double positive(const char* key, const char* unit) const
  {
    const double value = number(key, unit);
    require_positive(where(node(key)), key, value, unit);
    return value;
  }
  std::string text(const char* key) const
  {
    const toml::node& n = node(key);
    if (!n.is_string()) fail(where(n), fmt::format("'{}' must be a text in quotes", key));
    return n.as_string()->get();
  }
  std::vector<double> numbers(const char* key, const char* unit) const
  {
    const toml::node& n = node(key);
    std::vector<double> values;
    if (const toml::array* list = n.as_array())
      for (const toml::node& entry : *list) {
        const std::optional<double> value = entry.value<double>();
        if (!value || !entry.is_number()) fail(where(entry), fmt::format("'{}' must hold numbers only", key));
        values.push_back(*value);
      }
    if (values.empty())
      fail(where(n),
           fmt::format("'{}' must be a list of numbers{}", key, *unit ? fmt::format(" in {}", unit) : ""));
    return values;
  }
  /// Refuses all but `true`.
  void check_true(const char* key) const
  {
    const toml::node& n = node(key);
    if (!n.is_boolean() || !n.as_boolean()->get())
      fail(where(n), fmt::format("'{}' cannot be used", key), {},
           fmt::format("{} = true, or no such key", key));
  }
  /// A list of lists of `width` finite numbers each.
  std::vector<std::vector<double>> rows(const char* key, std::size_t width, const char* example) const
  {
    const toml::node& n = node(key);
    std::vector<std::vector<double>> found;
    if (const toml::array* list = n.as_array())
      for (const toml::node& entry : *list) {
        std::vector<double> row;
        if (const toml::array* numbers = entry.as_array())
          for (const toml::node& number : *numbers)
            if (number.is_number() && std::isfinite(*number.value<double>()))
              row.push_back(*number.value<double>());
        if (row.size() != width || entry.as_array()->size() != width)
          fail(where(entry),
               fmt::format("entry {} of '{}' is not {} finite numbers", found.size() + 1, key, width), {},
               example);
        found.push_back(row);
      }
    if (found.empty()) fail(where(n), fmt::format("'{}' must be a list of lists, such as {}", key, example));
    return found;
  }
  /// A list of pairs of numbers.
  std::vector<std::pair<double, double>> pairs(const char* key, const char* example) const
  {
    const toml::node& n = node(key);
    std::vector<std::pair<double, double>> found;
    if (const toml::array* list = n.as_array())
      for (const toml::node& entry : *list) {
        const toml::array* pair = entry.as_array();
        if (!pair || pair->size() != 2 || !(*pair)[0].is_number() || !(*pair)[1].is_number())
          fail(where(entry), fmt::format("entry {} of '{}' is not a pair of numbers", found.size() + 1, key),
               {}, example);
        found.emplace_back(*(*pair)[0].value<double>(), *(*pair)[1].value<double>());
      }
    if (found.empty()) fail(where(n), fmt::format("'{}' must be a list of pairs, such as {}", key, example));
    return found;
  }
  /// A list of tables; each is named "NAME.KEY 2".
  std::vector<Section> tables(const char* key, const char* example) const
  {
    const toml::node& n = node(key);
    const auto complain = [&](const toml::node& at) {
      fail(where(at), fmt::format("'{}' must be a list of tables, such as {}", key, example));
    };
    if (!n.is_array()) complain(n);
    std::vector<Section> found;
    for (const toml::node& entry : *n.as_array()) {
      if (!entry.is_table()) complain(entry);
      found.push_back({path_, *entry.as_table(), fmt::format("{}.{} {}", name_, key, found.size() + 1)});
    }
    return found;
  }
  Section table(const char* key, const char* example) const
  {
    const toml::node& n = node(key);
    if (!n.is_table()) fail(where(n), fmt::format("'{}' must be a table, such as {}", key, example));
    return {path_, *n.as_table(), fmt::format("{}.{}", name_, key)};
  }

 private:
  const std::string& path_;
  const toml::table& table_;
  std::string name_;
};

}  // namespace granulaw
