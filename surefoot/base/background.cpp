#include "surefoot/base/background.hpp"

#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

namespace surefoot {
namespace {

constexpr int kAddedNiceness = 5;  // above that of the process

}  // namespace

// A refused request is no harm: the thread runs as before.
void become_background(const char* name) {
  pthread_setname_np(pthread_self(), name);
  const sched_param plain{};
  pthread_setschedparam(pthread_self(), SCHED_BATCH, &plain);
  const auto thread = static_cast<id_t>(gettid());
  setpriority(PRIO_PROCESS, thread, getpriority(PRIO_PROCESS, thread) + kAddedNiceness);
}

}  // namespace surefoot
