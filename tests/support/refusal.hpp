#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "base/error.hpp"

namespace granulaw {

/// The sentence of the Error that `what` throws; empty: it throws none.
inline std::string sentence_of(const std::function<void()>& what)
{
  try {
    what();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

/// Expects an Error whose sentence holds `part`.
inline void expect_error(const std::string& part, const std::function<void()>& what)
{
  const std::string sentence = sentence_of(what);
  EXPECT_NE(sentence.find(part), std::string::npos) << "'" << part << "' not in: " << sentence;
}

}  // namespace granulaw
