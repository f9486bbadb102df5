#pragma once

#include <nanobind/nanobind.h>

#include <optional>
#include <utility>

namespace surefoot::python {

namespace nb = nanobind;

/// Ctrl-C while C++ runs without the interpreter's lock.
class Interrupt {
 public:
  /// Called often, without the lock.
  [[nodiscard]] bool is_asked() {
    if (has_come_ || ++calls_ % kCalls != 0) return has_come_;
    const nb::gil_scoped_acquire python;
    has_come_ = PyErr_CheckSignals() != 0;
    if (has_come_) error_.emplace();
    return has_come_;
  }
  [[nodiscard]] bool has_come() const { return has_come_; }
  /// With the lock: the exception of the signal's handler, if there was one.
  void raise() {
    if (has_come_) throw std::move(*error_);
  }

 private:
  static constexpr int kCalls = 40;
  int calls_ = 0;
  bool has_come_ = false;
  std::optional<nb::python_error> error_;
};

}  // namespace surefoot::python
