#pragma once

#include "python/interrupt.hpp"
#include "surefoot/base/error.hpp"

#include <nanobind/nanobind.h>

#include <string>
#include <utility>

namespace surefoot::python {

namespace nb = nanobind;

/// str(object).
[[nodiscard]] std::string text_of(const nb::object& object);
/// "ValueError: no room (my_task.py, line 12)"
[[nodiscard]] std::string one_line(const nb::python_error& error);

/// Calls with the interpreter's lock. What ends a program waits until the tick is over.
template <typename Call>
auto in_python(const Call& call) {
  const nb::gil_scoped_acquire python;
  try {
    return call();
  } catch (nb::python_error& error) {
    const std::string told = one_line(error);
    if (ends_program(error)) waiting_exit().emplace(std::move(error));
    throw Error(told);
  }
}

}  // namespace surefoot::python
