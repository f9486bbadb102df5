#pragma once

#include "python/interpreter.hpp"
#include "python/turn.hpp"
#include "surefoot/base/error.hpp"

#include <nanobind/nanobind.h>

#include <memory>
#include <string>
#include <utility>

namespace surefoot::python {

namespace nb = nanobind;

/// An object of one's own, or one that a run lends until it ends. Whoever looks at it or changes it
/// waits for another thread's tick.
template <typename T>
class Lent {
 public:
  /// `name` for messages, as "plant". `calls_back`: its ticks call code of the user's.
  Lent(std::unique_ptr<T> own, const char* name, bool calls_back)
      : name_(name),
        own_(std::move(own)),
        object_(own_.get()),
        turn_(std::make_unique<Turn>(name, calls_back)) {}
  Lent(T& another, const char* name, bool calls_back)
      : name_(name), object_(&another), turn_(std::make_unique<Turn>(name, calls_back)) {}

  /// To look at while the interpreter's lock is kept.
  T& operator*() const {
    turn_->look();
    return object();
  }
  T* operator->() const { return &**this; }
  [[nodiscard]] bool is_own() const { return own_ != nullptr; }
  [[nodiscard]] bool has_ended() const { return object_ == nullptr; }

  /// Calls with the object and without the interpreter's lock; one such call at a time.
  template <typename Call>
  void unlocked(const Call& call) {
    const Turn::Taken taken(*turn_, Turn::Kind::tick);
    T& mine = object();
    const Interpreter::Unlocked others_may_run;
    call(mine);
  }
  /// Calls with the object, whose change may call code of the user's.
  template <typename Call>
  auto changed(const Call& call) {
    const Turn::Taken taken(*turn_, Turn::Kind::change);
    return call(object());
  }

  /// The run goes on with what it lends, until it pauses.
  void resume() { turn_->resume(); }
  void pause() { turn_->end(); }
  /// The run, which goes on, ends.
  void end() {
    object_ = own_.get();
    pause();
  }

 private:
  T& object() const {
    if (object_ == nullptr)
      throw Error("the run of this " + std::string(name_) +
                  " has ended; take what you need of it while the run goes on");
    return *object_;
  }

  const char* name_;
  std::unique_ptr<T> own_;
  T* object_;
  std::unique_ptr<Turn> turn_;
};

}  // namespace surefoot::python
