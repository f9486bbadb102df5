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

/// Does a text hold another? With both in the message of a failure.
inline testing::AssertionResult holds(const std::string& text, const std::string& part) {
  const bool is_in = text.find(part) != std::string::npos;
  return (is_in ? testing::AssertionSuccess() : testing::AssertionFailure())
         << "\"" << part << (is_in ? "\" is in \"" : "\" is not in \"") << text << "\"";
}

}  // namespace surefoot::test
