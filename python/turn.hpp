#pragma once

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
    if (is_mine()) return refuse_inside();
    ++looks_;
    wait(lock, [&] { return !is_taken_; });
    --looks_;
    changed_.notify_all();
    refuse_if_taken();
  }

  /// Waits for looks and changes. Throws Error within the object's own tick or change, during
  /// another tick, and if another thread takes 10 s.
  void begin(Kind kind) {
    std::unique_lock lock(mutex_);
    if (is_taken_ && is_mine()) return refuse_inside();
    if (is_taken_ && kind == Kind::tick && kind_ == Kind::tick)
      throw Error("this " + name_ +
                  " is busy with a tick of another thread; one thread at a time would be valid");
    if (is_taken_ || looks_ > 0) wait(lock, [&] { return !is_taken_ && looks_ == 0; });
    refuse_if_taken();
    is_taken_ = true;
    kind_ = kind;
    owner_ = std::this_thread::get_id();
  }

  void end() noexcept {
    const std::lock_guard lock(mutex_);
    is_taken_ = false;
    changed_.notify_all();
  }

 private:
  static constexpr std::chrono::seconds kPatience{10};

  [[nodiscard]] bool is_mine() const { return owner_ == std::this_thread::get_id(); }

  /// Whoever holds `lock` does not wait for the interpreter's.
  template <typename Condition>
  void wait(std::unique_lock<std::mutex>& lock, const Condition& holds) {
    lock.unlock();
    {
      const nb::gil_scoped_release others_may_run;
      lock.lock();
      (void)changed_.wait_for(lock, kPatience, holds);
      lock.unlock();
    }
    lock.lock();
  }

  void refuse_inside() const {
    if (calls_back_)
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
  int looks_ = 0;  // that wait
  bool is_taken_ = false;
  Kind kind_ = Kind::tick;
  std::thread::id owner_;
};

}  // namespace surefoot::python
