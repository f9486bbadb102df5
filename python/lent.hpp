#pragma once

#include "surefoot/base/error.hpp"

#include <nanobind/nanobind.h>

#include <memory>
#include <string>
#include <utility>

namespace surefoot::python {

namespace nb = nanobind;

/// An object of one's own, or one that a run lends until it ends.
template <typename T>
class Lent {
 public:
  /// `name` for messages, as "plant".
  Lent(std::unique_ptr<T> own, const char* name)
      : name_(name), own_(std::move(own)), object_(own_.get()) {}
  Lent(T& another, const char* name) : name_(name), object_(&another) {}

  T& operator*() const {
    if (object_ == nullptr)
      throw Error("the run of this " + std::string(name_) +
                  " has ended; take what you need of it while the run goes on");
    return *object_;
  }
  T* operator->() const { return &**this; }
  [[nodiscard]] bool is_own() const { return own_ != nullptr; }
  [[nodiscard]] bool has_ended() const { return object_ == nullptr; }
  void end() { object_ = own_.get(); }

  /// Calls with the object and without the interpreter's lock; one such call at a time.
  template <typename Call>
  void unlocked(const Call& call) {
    T& object = **this;
    if (is_busy_)
      throw Error("this " + std::string(name_) +
                  " is busy, with a tick of another thread or with the tick that calls it; one "
                  "thread at a time would be valid");
    is_busy_ = true;
    const struct Free {
      bool& busy;
      ~Free() { busy = false; }
    } at_end{is_busy_};
    const nb::gil_scoped_release others_may_run;
    call(object);
  }

 private:
  const char* name_;
  std::unique_ptr<T> own_;
  T* object_;
  bool is_busy_ = false;  // guarded by the interpreter's lock
};

}  // namespace surefoot::python
