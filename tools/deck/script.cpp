#include "deck/script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.hpp"

namespace granulaw::deck {

namespace {

std::string trimmed(const std::string& text)
{
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

/// Without the comment; '#' within quotes is text.
std::string uncommented(const std::string& text)
{
  char quote = 0;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (quote) {
      if (text[k] == quote) quote = 0;
    } else if (text[k] == '"' || text[k] == '\'') {
      quote = text[k];
    } else if (text[k] == '#') {
      return text.substr(0, k);
    }
  }
  return text;
}

}  // namespace

std::string path_from(const std::string& folder, const std::string& path)
{
  const std::filesystem::path p(path);
  return p.is_absolute() || folder.empty() ? path : (std::filesystem::path(folder) / p).string();
}

void Script::note(const std::string& where, const std::string& what)
{
  const std::string text = printable(where + ": " + what);
  if (std::find(notes_.begin(), notes_.end(), text) == notes_.end() && notes_.size() < 200)
    notes_.push_back(text);
}

void Script::preset(const std::string& name, const std::vector<std::string>& values)
{
  variables_[name] = {false, false, values, 0};
}

void Script::read(const std::string& path)
{
  folder_ = std::filesystem::path(path).parent_path().string();
  std::string file = path, label;
  for (;;) {
    run_file(file, label);
    if (jump_.empty()) return;
    file = jump_.back().file, label = jump_.back().label;
    jump_.clear();
  }
}

const Script::Lines& Script::lines(const std::string& path)
{
  if (const auto known = files_.find(path); known != files_.end()) return known->second;
  std::error_code ignored;
  std::ifstream in(path, std::ios::binary);
  if (!in || !std::filesystem::is_regular_file(path, ignored)) fail(path, "cannot be read");
  if (std::filesystem::file_size(path, ignored) > 16u << 20)
    fail(path, "is no LIGGGHTS script", "more than 16 MB");
  Lines result;
  std::string text, joined;
  int n = 0, first = 0;
  while (std::getline(in, text)) {
    ++n;
    if (text.find('\0') != std::string::npos)
      fail(fmt::format("{}:{}", path, n), "is no LIGGGHTS script", "a byte 0");
    if (joined.empty()) first = n;
    const std::string bare = trimmed(text);
    if (!bare.empty() && bare.back() == '&') {
      joined += bare.substr(0, bare.size() - 1) + " ";
      continue;
    }
    result.push_back({first, trimmed(uncommented(joined + text))});
    joined.clear();
  }
  if (!joined.empty()) result.push_back({first, trimmed(uncommented(joined))});
  return files_[path] = std::move(result);
}

void Script::run_file(const std::string& path, const std::string& label)
{
  if (++depth_ > largest_depth)
    fail(path, fmt::format("files include each other more than {} deep", largest_depth));
  const Lines all = lines(path);
  const auto position_of = [&](const std::string& wanted) -> std::size_t {
    for (std::size_t k = 0; k < all.size(); ++k) {
      const auto words = split(all[k].text);
      if (words.size() == 2 && words[0] == "label" && words[1] == wanted) return k + 1;
    }
    fail(path, "has no label that a jump leads to", "'" + wanted + "'");
  };
  std::size_t k = label.empty() ? 0 : position_of(label);
  for (; k < all.size(); ++k) {
    if (all[k].text.empty()) continue;
    run_line(all[k].text, fmt::format("{}:{}", path, all[k].number), path);
    if (jump_.empty()) continue;
    if (jump_.back().file != path) break;  // read() or the including file goes on there
    const std::string to = jump_.back().label;
    jump_.clear();
    k = to.empty() ? static_cast<std::size_t>(-1) : position_of(to) - 1;
  }
  --depth_;
}

void Script::run_line(const std::string& text, const std::string& where, const std::string& path)
{
  if (++executed_ > largest_number_of_lines)
    fail(where, fmt::format("the deck executes more than {} lines", largest_number_of_lines));
  Command command{where, folder_, {}, {}};
  std::string line = text;
  try {
    line = substitute(text, true);
  } catch (const Unknown& error) {
    command.unknown = error.what();
  }
  command.words = split(line);
  if (command.words.empty()) return;
  const std::string& name = command.words[0];
  if (name == "label") return;
  if (name == "variable") {
    if (!command.unknown.empty()) {  // it stays unknown: whoever uses it says so
      if (command.words.size() > 1) variables_[command.words[1]] = {true, false, {"unknown"}, 0};
      return;
    }
    set_variable(command.words, where);
  } else if (name == "next") {
    advance(command.words, where);
  } else if (name == "include" || name == "jump") {
    if (name == "jump" && skip_jump_) {
      skip_jump_ = false;
      return;
    }
    if (!command.unknown.empty() || command.words.size() < 2) {
      note(where, fmt::format("{} is not followed: {}", name,
                              command.unknown.empty() ? "its file is missing" : command.unknown));
      return;
    }
    const std::string file = command.words[1] == "SELF" ? path : path_from(folder_, command.words[1]);
    if (name == "jump") {
      if (++jumps_ > largest_number_of_jumps) {
        if (jumps_ == largest_number_of_jumps + 1)
          note(where, fmt::format("more than {} jumps: the loop is left here", largest_number_of_jumps));
        return;
      }
      jump_ = {{file, command.words.size() > 2 ? command.words[2] : ""}};
    } else {
      run_file(file, "");
    }
  } else if (name == "if") {
    run_if(command.words, where, path);
  } else {
    execute_(command);
  }
}

bool Script::holds(const std::string& condition) const
{
  const std::string text = substitute(condition, false);
  try {
    return formula(text, 0) != 0;
  } catch (const Unknown&) {
    // words may be compared as well: "${model} == mpm"
    for (const char* sign : {"==", "!="}) {
      const auto at = text.find(sign);
      if (at == std::string::npos) continue;
      const std::string a = trimmed(text.substr(0, at)), b = trimmed(text.substr(at + 2));
      const auto word = [](const std::string& w) {
        return !w.empty() && std::all_of(w.begin(), w.end(), [](char c) {
          return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.' || c == '-' || c == '/';
        });
      };
      if (word(a) && word(b) && !a.starts_with("v_") && !a.starts_with("c_") && !a.starts_with("f_"))
        return (a == b) == (std::string(sign) == "==");
    }
    throw;
  }
}

void Script::run_if(const std::vector<std::string>& words, const std::string& where, const std::string& path)
{
  // if COND then CMD... [elif COND CMD...]... [else CMD...]
  if (words.size() < 4 || words[2] != "then") {
    note(where, "'if' is not followed: it needs CONDITION then COMMAND...");
    return;
  }
  bool chosen = false;
  try {
    chosen = holds(words[1]);
  } catch (const Unknown& error) {
    note(where, fmt::format("'if' is skipped: {}", error.what()));
    return;
  }
  for (std::size_t k = 3; k < words.size(); ++k) {
    if (words[k] == "else" || words[k] == "elif") {
      if (chosen) return;
      if (words[k] == "else") {
        chosen = true;
      } else if (k + 1 < words.size()) {
        try {
          chosen = holds(words[++k]);
        } catch (const Unknown& error) {
          note(where, fmt::format("'elif' is skipped: {}", error.what()));
          return;
        }
      }
      continue;
    }
    if (!chosen) continue;
    run_line(trimmed(words[k]), where, path);
    if (!jump_.empty()) return;
  }
}

void Script::set_variable(const std::vector<std::string>& words, const std::string& where)
{
  if (words.size() < 3) {
    note(where, "'variable' is not followed: it needs a name and a style");
    return;
  }
  const std::string &name = words[1], &style = words[2];
  const std::vector<std::string> rest(words.begin() + 3, words.end());
  if (style == "delete") {
    variables_.erase(name);
  } else if (style == "index" || style == "universe" || style == "world" || style == "uloop") {
    if (variables_.contains(name) || rest.empty()) return;
    variables_[name] = {false, false, style == "uloop" ? std::vector<std::string>{"1"} : rest, 0};
    if (style != "index")
      note(where, fmt::format("of the {} variable '{}' only the first value is followed", style, name));
  } else if (style == "loop") {
    if (variables_.contains(name)) return;
    std::vector<long> ends;
    for (const std::string& word : rest)
      if (const auto n = number(word)) ends.push_back(static_cast<long>(std::clamp(*n, -1e9, 1e9)));
    if (ends.empty()) {
      note(where, fmt::format("the loop variable '{}' is not followed: it needs a number", name));
      return;
    }
    const long first = ends.size() > 1 ? ends[0] : 1, last = ends.size() > 1 ? ends[1] : ends[0];
    Variable loop;
    for (long n = first; n <= std::min(last, first + largest_number_of_jumps); ++n)
      loop.values.push_back(std::to_string(n));
    if (!loop.values.empty()) variables_[name] = loop;
  } else if (style == "equal" || style == "atom") {
    std::string text;
    for (const std::string& word : rest) text += (text.empty() ? "" : " ") + word;
    // a preset stands: LIGGGHTS, too, lets -var win over the style it is given for
    if (const auto old = variables_.find(name);
        old != variables_.end() && !old->second.formula && !old->second.per_atom)
      return;
    variables_[name] = {style == "equal", style == "atom", {text}, 0};
  } else if (style == "string") {
    variables_[name] = {false, false, {rest.empty() ? "" : rest[0]}, 0};
  } else {
    note(where,
         fmt::format("the {} variable '{}' is not followed: give it by --var {} VALUE", style, name, name));
  }
}

void Script::advance(const std::vector<std::string>& words, const std::string&)
{
  for (std::size_t k = 1; k < words.size(); ++k) {
    const auto variable = variables_.find(words[k]);
    if (variable == variables_.end() || variable->second.formula) continue;
    if (++variable->second.at < variable->second.values.size()) continue;
    variables_.erase(variable);
    skip_jump_ = true;
  }
}

std::string Script::value(const std::string& name) const
{
  const auto variable = variables_.find(name);
  if (variable == variables_.end()) throw Unknown(fmt::format("the variable '{}' has no value", name));
  const Variable& v = variable->second;
  if (v.per_atom) throw Unknown(fmt::format("the variable '{}' is one of each atom", name));
  return v.formula ? number_text(formula(v.values[0], 0)) : v.values[v.at];
}

double Script::formula(const std::string& text, int depth) const
{
  return evaluate(text, [&](std::string_view name) -> std::optional<double> {
    if (!name.starts_with("v_")) return state_(name);
    const auto variable = variables_.find(std::string(name.substr(2)));
    if (variable == variables_.end() || depth > 50) return {};
    const Variable& v = variable->second;
    if (v.per_atom) return {};
    return v.formula ? formula(v.values[0], depth + 1) : number(v.values[v.at]);
  });
}

std::string Script::substitute(const std::string& text, bool skip_quoted) const
{
  std::string result;
  char quote = 0;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (skip_quoted && (c == '"' || c == '\'')) quote = quote == 0 ? c : quote == c ? 0 : quote;
    if (c != '$' || quote || k + 1 >= text.size()) {
      result += c;
      continue;
    }
    const char next = text[k + 1];
    if (next == '{') {
      const auto end = text.find('}', k);
      if (end == std::string::npos) throw Unknown("a '}' is missing");
      result += value(text.substr(k + 2, end - k - 2));
      k = end;
    } else if (next == '(') {
      int open = 0;
      std::size_t end = k + 1;
      for (; end < text.size(); ++end) {
        if (text[end] == '(') ++open;
        if (text[end] == ')' && --open == 0) break;
      }
      if (end == text.size()) throw Unknown("a ')' is missing");
      result += number_text(formula(text.substr(k + 2, end - k - 2), 0));
      k = end;
    } else {
      result += value(std::string(1, next));
      ++k;
    }
  }
  return result;
}

std::vector<std::string> Script::split(const std::string& text)
{
  std::vector<std::string> words;
  std::string word;
  char quote = 0;
  bool open = false;
  for (const char c : text) {
    if (quote) {
      if (c == quote)
        quote = 0;
      else
        word += c;
    } else if (c == '"' || c == '\'') {
      quote = c, open = true;
    } else if (std::isspace(static_cast<unsigned char>(c))) {
      if (open) words.push_back(word);
      word.clear(), open = false;
    } else {
      word += c, open = true;
    }
  }
  if (open) words.push_back(word);
  return words;
}

}  // namespace granulaw::deck
