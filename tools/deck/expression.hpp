#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace granulaw::deck {

/// A formula, or a word of a deck, whose value only the run itself knows, or which is not understood.
class Unknown : public std::runtime_error
{
 public:
  using std::runtime_error::runtime_error;
};

/// Value of a name in a formula: "v_NAME" of a variable, a thermo keyword such as "step" or "dt". Empty: it
/// is not known before the run.
using Lookup = std::function<std::optional<double>(std::string_view name)>;

/// Value of an equal-style formula of LIGGGHTS: + - * / ^, comparisons, && || !, parentheses, PI, functions
/// (sqrt, exp, ln, log, abs, sin, cos, tan, asin, acos, atan, atan2, ceil, floor, round), names by `lookup`.
/// As in LIGGGHTS, ^ binds to the left and unary minus binds tighter than ^. Throws Unknown naming the part
/// that is not understood.
double evaluate(std::string_view formula, const Lookup& lookup);

/// The whole of `word` as a finite number; empty: it is none.
std::optional<double> number(std::string_view word);

/// A number as LIGGGHTS puts it into a line.
std::string number_text(double value);

}  // namespace granulaw::deck
