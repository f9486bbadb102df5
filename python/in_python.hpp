#pragma once

#include "python/interpreter.hpp"
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

/// "Mine.update returned None; a MotionPlan would be valid"
[[nodiscard]] std::string wrong_result(nb::handle object, const char* method, nb::handle result,
                                       const std::string& valid);

/// What a method of the user's returned, as a T. Throws Error if it is none. `type`: in Python.
template <typename T>
const T& result_of(nb::handle object, const char* method, const char* type, nb::handle result) {
  const T* found = nullptr;
  if (nb::try_cast<const T*>(result, found) && found != nullptr) return *found;
  throw Error(wrong_result(object, method, result, "a " + std::string(type)));
}

/// Calls with the interpreter's lock. What ends a program waits until the tick is over.
template <typename Call>
auto in_python(const Call& call) {
  const Interpreter::Locked python;
  try {
    return call();
  } catch (nb::python_error& error) {
    const std::string told = one_line(error);
    if (ends_program(error)) waiting_exit().emplace(std::move(error));
    throw Error(told);
  }
}

}  // namespace surefoot::python
