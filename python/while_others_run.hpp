#pragma once

#include "python/interpreter.hpp"
#include "python/interrupt.hpp"
#include "surefoot/base/error.hpp"

#include <functional>

namespace surefoot::python {

/// What `compute(stops)` returns, without the interpreter's lock. It asks `stops()` often, and ends
/// where that is true: Ctrl-C then goes on in Python.
template <typename Compute>
auto while_others_run(const Compute& compute) {
  Interrupt interrupt;
  const auto computed = [&] {
    const Interpreter::Unlocked others_may_run;
    return compute(std::function<bool()>([&] { return interrupt.is_asked(); }));
  };
  try {
    auto result = computed();
    interrupt.raise();
    raise_waiting_exit();
    return result;
  } catch (const Error&) {
    interrupt.raise();
    raise_waiting_exit();
    throw;
  }
}

}  // namespace surefoot::python
