#include "benchmarks/solver/trial.hpp"

#include "surefoot/base/error.hpp"

#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <new>
#include <thread>

namespace surefoot::benchmarks {
namespace {

using Clock = std::chrono::steady_clock;
using Shared = std::atomic<Outcome>;

/// Outcomes that a child writes and its parent reads.
class SharedOutcomes {
 public:
  explicit SharedOutcomes(std::size_t count) : bytes_(count * sizeof(Shared)) {
    void* memory = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw Error("no memory for the outcomes of a trial");
    outcomes_ = static_cast<Shared*>(memory);
    for (std::size_t i = 0; i < count; ++i) new (outcomes_ + i) Shared(Outcome::not_tried);
  }
  ~SharedOutcomes() { munmap(outcomes_, bytes_); }
  SharedOutcomes(const SharedOutcomes&) = delete;
  SharedOutcomes& operator=(const SharedOutcomes&) = delete;
  Shared& operator[](std::size_t i) { return outcomes_[i]; }

 private:
  std::size_t bytes_;
  Shared* outcomes_;
};

[[noreturn]] void solve_from(std::size_t first, const PeerKind& kind, const ProblemSet& set,
                             SharedOutcomes& outcomes) {
  std::unique_ptr<Peer> peer;
  for (std::size_t i = first; i < set.problems.size(); ++i) {
    if (!peer || !set.is_sequence) peer = kind.make();
    peer->prepare(set.problems[i]);
    outcomes[i] = peer->solve() ? Outcome::solved : Outcome::failed;
  }
  _exit(0);
}

/// The first problem without an outcome once the child is gone or sits on it for too long.
std::size_t watch(pid_t child, std::size_t next, std::size_t count, double limit,
                  SharedOutcomes& outcomes) {
  auto last = Clock::now();
  while (true) {
    const bool is_gone = waitpid(child, nullptr, WNOHANG) == child;
    const std::size_t before = next;
    while (next < count && outcomes[next] != Outcome::not_tried) ++next;
    if (next != before) last = Clock::now();
    if (is_gone) {
      if (next < count) outcomes[next] = Outcome::crashed;
      return next;
    }
    if (next < count && std::chrono::duration<double>(Clock::now() - last).count() > limit) {
      kill(child, SIGKILL);
      waitpid(child, nullptr, 0);
      outcomes[next] = Outcome::hung;
      return next;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace

std::vector<Outcome> try_all(const PeerKind& kind, const ProblemSet& set, double time_limit) {
  const std::size_t count = set.problems.size();
  SharedOutcomes shared(count);
  for (std::size_t next = 0; next < count; ++next) {
    const pid_t child = fork();
    if (child < 0) throw Error("no further process can be started for a trial");
    if (child == 0) solve_from(next, kind, set, shared);
    next = watch(child, next, count, time_limit, shared);
  }
  std::vector<Outcome> outcomes;
  for (std::size_t i = 0; i < count; ++i) outcomes.push_back(shared[i]);
  return outcomes;
}

}  // namespace surefoot::benchmarks
