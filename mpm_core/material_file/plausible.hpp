#pragma once

#include <string>

namespace granulaw {

/// Asks about a number that was probably given in another unit than SI: one line on stderr, once a program,
/// where a solid might have it. Throws Error where none has. `quantity`: density, youngs_modulus,
/// yield_stress, hardness, velocity or radius; `where` and `key` lead the sentence.
void check_plausible(const std::string& where, const std::string& quantity, const std::string& key,
                     double value);
bool is_usual_quantity(const std::string& quantity);  ///< check_plausible() takes it
/// From now on no line is printed: on all ranks but the first.
void ask_nothing_of_units();

}  // namespace granulaw
