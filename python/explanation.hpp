#pragma once

#include "surefoot/base/printable.hpp"

#include <string>

namespace surefoot::python {

/// Of a tick of a log, or of a solved hierarchy; `Explanation` in Python.
struct Explanation {
  std::string text, json;

  static Explanation of(const auto& told) { return {printable(told.text(), "\n"), told.json()}; }
};

}  // namespace surefoot::python
