#pragma once

#include <nanobind/nanobind.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace surefoot::python {

namespace nb = nanobind;

/// The interpreter's lock, and its end. Python ends a thread that asks for its lock too late by
/// unwinding it, which C++ does not survive in the middle of a tick. So at the interpreter's end
/// the other threads stay where they would ask; one that is in Python code then is unwound all the
/// same, which aborts the program.
class Interpreter {
 public:
  /// For Python's atexit: until all threads in C++ have come to where they stay, but 1 s at most.
  static void end() {
    ending_thread() = std::this_thread::get_id();
    is_ending() = true;
    PyThreadState* const mine = PyEval_SaveThread();
    const auto last = std::chrono::steady_clock::now() + std::chrono::seconds(1);
    while (in_cpp() > depth() && std::chrono::steady_clock::now() < last)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    PyEval_RestoreThread(mine);
  }

  /// Leaves the lock to others.
  class Unlocked {
   public:
    Unlocked() {
      ++depth();
      ++in_cpp();
      state_ = PyEval_SaveThread();
      has_left() = true;
    }
    Unlocked(const Unlocked&) = delete;
    Unlocked& operator=(const Unlocked&) = delete;
    ~Unlocked() {
      stay_at_end();
      PyEval_RestoreThread(state_);
      has_left() = false;
      --in_cpp();
      --depth();
    }

   private:
    PyThreadState* state_;
  };

  /// Has the lock, again or still.
  class Locked {
   public:
    Locked() : had_left_(has_left()) {
      if (had_left_) stay_at_end();
      state_ = PyGILState_Ensure();
      has_left() = false;
    }
    Locked(const Locked&) = delete;
    Locked& operator=(const Locked&) = delete;
    ~Locked() {
      PyGILState_Release(state_);
      has_left() = had_left_;
    }

   private:
    const bool had_left_;
    PyGILState_STATE state_;
  };

 private:
  static std::atomic<bool>& is_ending() {
    static std::atomic<bool> ending = false;
    return ending;
  }
  static std::atomic<std::thread::id>& ending_thread() {
    static std::atomic<std::thread::id> thread;
    return thread;
  }
  /// How often threads have left the lock and not yet come back.
  static std::atomic<int>& in_cpp() {
    static std::atomic<int> count = 0;
    return count;
  }
  /// The same of this thread.
  static int& depth() {
    static thread_local int depth = 0;
    return depth;
  }
  static bool& has_left() {
    static thread_local bool has_left = false;
    return has_left;
  }
  static void stay_at_end() {
    if (!is_ending() || ending_thread().load() == std::this_thread::get_id()) return;
    in_cpp() -= depth();
    for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
  }
};

}  // namespace surefoot::python
