#pragma once

#include "python/interpreter.hpp"
#include "surefoot/base/error.hpp"

#include <nanobind/nanobind.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

namespace surefoot::python {

namespace nb = nanobind;

/// Whose turn it is with an object: one tick's, which may leave the interpreter's lock to others,
/// one change's, or that of looks, which keep the interpreter's lock. All but `end` are called with
/// that lock, and let it go while they wait for another thread.
class Turn {
 public:
  enum class Kind { tick, change };

  /// From `begin` to `end`.
  class Taken {
   public:
    Taken(Turn& turn, Kind kind) : turn_(turn) { turn_.begin(kind); }
    Taken(const Taken&) = delete;
    Taken& operator=(const Taken&) = delete;
    ~Taken() { turn_.end(); }

   private:
    Turn& turn_;
  };

  /// `name` for messages, as "plant". `calls_back`: its ticks call code of the user's.
  Turn(std::string name, bool calls_back) : name_(std::move(name)), calls_back_(calls_back) {}

  /// Throws Error within the object's own tick or change, and if another thread's takes 10 s.
  void look() {
    std::unique_lock lock(mutex_);
    if (!is_taken_) return;
    if (is_mine()) {
      if (calls_back_) refuse_inside();
      return;
    }
    wait_before_ticks(lock, kPatience);
    refuse_if_taken();
  }

  /// Waits for looks and changes. Throws Error within the object's own tick or change, during
  /// another tick, and if another thread takes 10 s.
  void begin(Kind kind) {
    std::unique_lock lock(mutex_);
    if (is_taken_ && is_mine()) refuse_inside();
    if (is_taken_ && kind == Kind::tick && kind_ == Kind::tick)
      throw Error("this " + name_ +
                  " is busy with a tick of another thread; one thread at a time would be valid");
    if (kind == Kind::change) {
      wait_before_ticks(lock, kPatience);
    } else {
      wait(lock, kPatience, [&] { return !is_taken_ && waiting_ == 0; });
    }
    refuse_if_taken();
    take(kind);
  }
  /// As a tick, however long another thread takes.
  void resume() {
    std::unique_lock lock(mutex_);
    wait(lock, std::chrono::hours(1000), [&] { return !is_taken_ && waiting_ == 0; });
    take(Kind::tick);
  }

  void end() noexcept {
    const std::lock_guard lock(mutex_);
    is_taken_ = false;
    changed_.notify_all();
  }

 private:
  static constexpr std::chrono::seconds kPatience{10};

  [[nodiscard]] bool is_mine() const { return owner_ == std::this_thread::get_id(); }

  void take(Kind kind) {
    is_taken_ = true;
    kind_ = kind;
    owner_ = std::this_thread::get_id();
  }
  /// The next tick begins after whoever waits here.
  void wait_before_ticks(std::unique_lock<std::mutex>& lock, std::chrono::seconds patience) {
    ++waiting_;
    wait(lock, patience, [&] { return !is_taken_; });
    --waiting_;
    changed_.notify_all();
  }
  /// Until it holds while this thread has both locks. Nobody waits for one with the other.
  template <typename Condition>
  void wait(std::unique_lock<std::mutex>& lock, std::chrono::seconds patience,
            const Condition& holds) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (!holds() && std::chrono::steady_clock::now() < end) {
      lock.unlock();
      {
        const Interpreter::Unlocked others_may_run;
        lock.lock();
        (void)changed_.wait_until(lock, end, holds);
        lock.unlock();
      }
      lock.lock();
    }
  }

  [[noreturn]] void refuse_inside() const {
    throw Error("this " + name_ +
                " is busy with the call that called this; between two ticks would be valid");
  }
  void refuse_if_taken() const {
    if (is_taken_)
      throw Error("this " + name_ +
                  " is busy with another thread for 10 s; between two ticks would be valid");
  }

  const std::string name_;
  const bool calls_back_;
  std::mutex mutex_;
  std::condition_variable changed_;
  int waiting_ = 0;  // looks and changes
  bool is_taken_ = false;
  Kind kind_ = Kind::tick;
  std::thread::id owner_;
};

}  // namespace surefoot::python
