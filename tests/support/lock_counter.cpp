#include "tests/support/lock_counter.hpp"

#include <dlfcn.h>
#include <pthread.h>

#include <atomic>

namespace {

// Static storage of the thread: reading it never allocates or locks.
__attribute__((tls_model("initial-exec"))) thread_local std::size_t g_count = 0;

using Lock = int (*)(pthread_mutex_t*);
constinit std::atomic<Lock> g_lock{nullptr};

}  // namespace

extern "C" int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept {
  Lock lock = g_lock.load(std::memory_order_relaxed);
  if (lock == nullptr) {
    lock = reinterpret_cast<Lock>(dlsym(RTLD_NEXT, "pthread_mutex_lock"));
    g_lock.store(lock, std::memory_order_relaxed);
  }
  ++g_count;
  return lock(mutex);
}

namespace surefoot::test {

LockCounter::LockCounter() : start_(g_count) {}

std::size_t LockCounter::count() const { return g_count - start_; }

}  // namespace surefoot::test
