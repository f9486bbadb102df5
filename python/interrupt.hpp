#pragma once

#include "python/interpreter.hpp"

#include <nanobind/nanobind.h>

#include <optional>
#include <utility>

namespace surefoot::python {

namespace nb = nanobind;

/// Of this thread: what a part of the user's own raised that ends a program, as Ctrl-C or
/// sys.exit(). It waits here until the tick is over, because a tick always gives a command.
inline std::optional<nb::python_error>& waiting_exit() {
  thread_local std::optional<nb::python_error> exit;
  return exit;
}

[[nodiscard]] inline bool ends_program(const nb::python_error& error) {
  return !error.matches(PyExc_Exception);
}

/// With the lock, after a tick.
inline void raise_waiting_exit() {
  if (!waiting_exit()) return;
  nb::python_error exit = std::move(*waiting_exit());
  waiting_exit().reset();
  throw std::move(exit);
}

/// Ctrl-C while C++ runs without the interpreter's lock.
class Interrupt {
 public:
  /// Called often, without the lock.
  [[nodiscard]] bool is_asked() {
    if (has_come()) return true;
    if (waiting_exit()) {
      error_.emplace(std::move(*waiting_exit()));
      waiting_exit().reset();
    } else if (++calls_ % kCalls == 0) {
      const Interpreter::Locked python;
      if (PyErr_CheckSignals() != 0) error_.emplace();
    }
    return has_come();
  }
  [[nodiscard]] bool has_come() const { return error_.has_value(); }
  /// With the lock: the exception of the signal's handler, if there was one.
  void raise() {
    if (has_come()) throw std::move(*error_);
  }

 private:
  static constexpr int kCalls = 40;
  int calls_ = 0;
  std::optional<nb::python_error> error_;
};

}  // namespace surefoot::python
