#pragma once

#include <functional>
#include <string>

#include "law/law_material.hpp"

namespace granulaw {

/// Leads the sentence about one key of a material: file and line, or what the caller likes.
using WhereOfKey = std::function<std::string(const char* key)>;

/// Throws Error if the number of `key` is not over 0 and finite; `unit` may be empty.
void require_positive(const std::string& where, const std::string& key, double value, const std::string& unit);

/// Density (kg/m^3), E (Pa) and nu of a material. Throws Error where a number is out of range.
void check_elastic(const LawMaterial& m, const WhereOfKey& where);
/// Its yield stress, Pa; infinity: it is elastic.
void check_yield_stress(const LawMaterial& m, const WhereOfKey& where);
/// Its linear hardening, Pa; `where` leads the sentence.
void check_hardening(const LawMaterial& m, const std::string& where);

}  // namespace granulaw
