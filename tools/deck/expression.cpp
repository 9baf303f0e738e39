#include "deck/expression.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace granulaw::deck {

namespace {

/// Recursive descent, one function for each level of precedence.
class Parser
{
 public:
  Parser(std::string_view text, const Lookup& lookup) : text_(text), lookup_(lookup) {}

  double all()
  {
    const double value = either();
    space();
    if (at_ < text_.size()) stop("cannot go on at '" + std::string(text_.substr(at_)) + "'");
    return value;
  }

 private:
  std::string_view text_;
  const Lookup& lookup_;
  std::size_t at_ = 0;
  int depth_ = 0;  // of parentheses and signs: a hostile formula must not exhaust the stack

  [[noreturn]] void stop(const std::string& why) const
  {
    throw Unknown(fmt::format("the formula '{}': {}", text_, why));
  }
  void space()
  {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  bool take(std::string_view symbol)
  {
    space();
    if (!text_.substr(at_).starts_with(symbol)) return false;
    at_ += symbol.size();
    return true;
  }

  double either()
  {
    double value = both();
    while (take("||")) {
      const double other = both();
      value = value != 0 || other != 0;
    }
    return value;
  }
  double both()
  {
    double value = comparison();
    while (take("&&")) {
      const double other = comparison();
      value = value != 0 && other != 0;
    }
    return value;
  }
  double comparison()
  {
    double value = sum();
    for (;;) {
      if (take("=="))
        value = value == sum();
      else if (take("!="))
        value = value != sum();
      else if (take("<="))
        value = value <= sum();
      else if (take(">="))
        value = value >= sum();
      else if (take("<"))
        value = value < sum();
      else if (take(">"))
        value = value > sum();
      else
        return value;
    }
  }
  double sum()
  {
    double value = product();
    for (;;) {
      if (take("+"))
        value += product();
      else if (take("-"))
        value -= product();
      else
        return value;
    }
  }
  double product()
  {
    double value = power();
    for (;;) {
      if (take("*"))
        value *= power();
      else if (take("/")) {
        const double by = power();
        if (by == 0) stop("divides by zero");
        value /= by;
      } else
        return value;
    }
  }
  double power()
  {
    double value = signed_value();
    while (take("^")) value = std::pow(value, signed_value());
    return value;
  }
  double signed_value()
  {
    if (++depth_ > 200) stop("is nested too deeply");
    double value;
    if (take("-"))
      value = -signed_value();
    else if (take("+"))
      value = signed_value();
    else if (at_ + 1 < text_.size() && text_[at_] == '!' && text_[at_ + 1] != '=' && take("!"))
      value = signed_value() == 0;
    else
      value = atom();
    --depth_;
    return value;
  }
  double atom()
  {
    if (take("(")) {
      const double value = either();
      if (!take(")")) stop("a ')' is missing");
      return value;
    }
    space();
    if (at_ >= text_.size()) stop("ends too early");
    const char c = text_[at_];
    if (std::isdigit(static_cast<unsigned char>(c)) || c == '.') {
      const std::string rest(text_.substr(at_));
      char* end = nullptr;
      const double value = std::strtod(rest.c_str(), &end);
      if (end == rest.c_str()) stop("cannot go on at '" + rest + "'");
      at_ += static_cast<std::size_t>(end - rest.c_str());
      return value;
    }
    const std::size_t start = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_'))
      ++at_;
    const std::string_view name = text_.substr(start, at_ - start);
    if (name.empty()) stop("cannot go on at '" + std::string(text_.substr(start)) + "'");
    if (take("(")) return call(name);
    if (name == "PI") return M_PI;
    if (take("[")) stop(fmt::format("'{}[...]' is known only while it runs", name));
    if (const auto value = lookup_(name)) return *value;
    stop(fmt::format("'{}' is known only while it runs", name));
  }
  double call(std::string_view name)
  {
    std::vector<double> a;
    do a.push_back(either());
    while (take(","));
    if (!take(")")) stop("a ')' is missing");
    struct Unary
    {
      std::string_view name;
      double (*value)(double);
    };
    static constexpr std::array<Unary, 14> unary{{{"sqrt", std::sqrt},
                                                  {"exp", std::exp},
                                                  {"ln", std::log},
                                                  {"log", std::log10},
                                                  {"abs", std::fabs},
                                                  {"sin", std::sin},
                                                  {"cos", std::cos},
                                                  {"tan", std::tan},
                                                  {"asin", std::asin},
                                                  {"acos", std::acos},
                                                  {"atan", std::atan},
                                                  {"ceil", std::ceil},
                                                  {"floor", std::floor},
                                                  {"round", std::round}}};
    for (const Unary& f : unary)
      if (f.name == name && a.size() == 1) return f.value(a[0]);
    if (name == "atan2" && a.size() == 2) return std::atan2(a[0], a[1]);
    stop(fmt::format("the function '{}' of {} numbers is known only while it runs", name, a.size()));
  }
};

}  // namespace

double evaluate(std::string_view formula, const Lookup& lookup)
{
  const double value = Parser(formula, lookup).all();
  if (!std::isfinite(value)) throw Unknown(fmt::format("the formula '{}' is not a finite number", formula));
  return value;
}

std::optional<double> number(std::string_view word)
{
  const std::string text(word);
  // strtod alone would take leading blanks, "inf", "nan" and hexadecimal numbers
  if (text.empty() || text.find_first_not_of("0123456789+-.eE") != std::string::npos) return {};
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (*end != '\0' || end == text.c_str() || !std::isfinite(value)) return {};
  return value;
}

std::string number_text(double value)
{
  return fmt::format("{:.15g}", value);
}

}  // namespace granulaw::deck
