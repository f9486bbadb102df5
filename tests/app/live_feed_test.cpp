#include "app/live_feed.hpp"

#include "app/closed_loop.hpp"
#include "app/live_view.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "tests/support/lock_counter.hpp"
#include "tests/support/malloc_counter.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <mutex>
#include <thread>

namespace surefoot {
namespace {

constexpr std::size_t kPlaces = 1024;    // of the queue to the server
constexpr std::size_t kFirstTicks = 20;  // at the first the view learns where the run begins

/// Steers as a live view does, and counts what its calls allocate and lock.
class CountedView final : public RunSteering {
 public:
  explicit CountedView(LiveView& view) : view_(view) {}

  void begin(const RunParts& parts) override { view_.begin(parts); }
  RunOrder before_tick(double time) override {
    RunOrder order{};
    count([&] { order = view_.before_tick(time); });
    return order;
  }
  UserCommand user(const UserCommand& planned) override { return view_.user(planned); }
  void after_tick(const TickRecord& tick, const GroundTruth& truth,
                  const TickTiming& timing) override {
    count([&] { view_.after_tick(tick, truth, timing); });
    ++ticks;
  }

  std::size_t ticks = 0, allocations = 0, locks = 0;

 private:
  void count(const auto& call) {
    const test::MallocCounter malloc_counter;
    const test::LockCounter lock_counter;
    call();
    if (ticks < kFirstTicks) return;
    allocations += malloc_counter.count();
    locks += lock_counter.count();
  }

  LiveView& view_;
};

struct WatchedRun {
  Scenario scenario = load_scenario({"walk_flat_ideal", 0, {"duration=4"}});
  LiveOperator wishes{scenario, ViewLimits()};
  LiveFeed feed{scenario, wishes, ""};
  LiveView view{wishes, feed, [] { return false; }};
  CountedView counted{view};

  /// `ready` is called when pages may be served.
  void run(std::function<void()> ready = {}) {
    (void)wishes.command({.type = ViewCommandType::speed, .factor = 8.0});
    ClosedLoopOptions options;
    options.steering = &counted;
    options.ready = std::move(ready);
    (void)run_closed_loop(scenario, options);
  }
};

TEST(LiveFeed, the_counters_see_what_they_should) {
  std::mutex mutex;
  const test::LockCounter locks;
  {
    const std::lock_guard lock(mutex);
  }
  if (mutex.try_lock()) mutex.unlock();
  EXPECT_EQ(locks.count(), 1u);
}

TEST(LiveFeed,
     a_run_that_nobody_reads_neither_allocates_nor_waits_for_a_lock_and_counts_what_is_lost) {
  WatchedRun watched;
  watched.run();
  ASSERT_EQ(watched.counted.ticks, 1600u) << "more than the queue has places";
  EXPECT_EQ(watched.counted.allocations, 0u);
  EXPECT_EQ(watched.counted.locks, 0u);
  std::size_t frames = 0;
  for (const SharedBlock& block : watched.feed.blocks()) frames += block.frames;
  EXPECT_EQ(frames, kPlaces);
}

TEST(LiveFeed, a_server_that_is_busy_makes_no_tick_allocate_or_wait_for_a_lock) {
  WatchedRun watched;
  std::atomic<bool> ends{false};
  std::size_t frames = 0;
  std::thread server;
  watched.run([&] {
    server = std::thread([&] {
      while (!ends) {
        for (const SharedBlock& block : watched.feed.blocks()) frames += block.frames;
        (void)watched.feed.get("/api/session", {});
        (void)watched.feed.messages(50);
      }
    });
  });
  ends = true;
  server.join();
  EXPECT_EQ(watched.counted.allocations, 0u);
  EXPECT_EQ(watched.counted.locks, 0u);
  EXPECT_GT(frames, 0u);
}

}  // namespace
}  // namespace surefoot
