#pragma once

#include "surefoot/base/error.hpp"

#include <gtest/gtest.h>

#include <string>

namespace surefoot::test {

/// What an Error says; a failure of the test if there is none.
template <typename Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return "";
}

/// Does a text hold another? With both in the message if not.
inline testing::AssertionResult holds(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "\"" << part << "\" is not in \"" << text << "\"";
}

}  // namespace surefoot::test
