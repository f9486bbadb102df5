#include "server/live_feed.hpp"

#include "server/live_view.hpp"
#include "surefoot/closed_loop/closed_loop.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "tests/support/lock_counter.hpp"
#include "tests/support/malloc_counter.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <thread>

namespace surefoot::server {
namespace {

using test::holds;

constexpr std::size_t kPlaces = 1024;    // of the queue to the server
constexpr std::size_t kFirstTicks = 20;  // at the first the view learns where the run begins

/// Steers as a live view does, and counts what its calls allocate and lock.
class CountedView final : public closed_loop::RunSteering {
 public:
  explicit CountedView(LiveView& view) : view_(view) {}

  void begin(const closed_loop::RunParts& parts) override { view_.begin(parts); }
  closed_loop::RunOrder before_tick(double time) override {
    closed_loop::RunOrder order{};
    count([&] { order = view_.before_tick(time); });
    return order;
  }
  UserCommand user(const UserCommand& planned) override { return view_.user(planned); }
  void after_tick(const TickRecord& tick, const simulation::GroundTruth& truth,
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
  config::Scenario scenario = config::load_scenario({"walk_flat_ideal", 0, {"duration=4"}});
  LiveOperator wishes{scenario, ViewLimits()};
  LiveFeed feed{scenario, wishes, ""};
  LiveView view{wishes, feed, [] { return false; }};
  CountedView counted{view};

  /// `ready` is called when pages may be served.
  void run(std::function<void()> ready = {}) {
    (void)wishes.command({.type = ViewCommandType::speed, .factor = 8.0});
    closed_loop::ClosedLoopOptions options;
    options.steering = &counted;
    options.ready = std::move(ready);
    (void)closed_loop::run_closed_loop(scenario, options);
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

TEST(LiveFeed, a_run_that_is_steered_before_a_busy_server_waits_for_no_lock) {
  WatchedRun watched;
  std::atomic<bool> ends{false};
  int taken = 0;
  std::thread server;
  watched.run([&] {
    server = std::thread([&] {
      for (int i = 0; !ends; ++i) {
        const double friction = 0.3 + 0.01 * (i % 10);
        const ViewCommand friction_now{.type = ViewCommandType::friction, .value = friction};
        const ViewCommand push{.type = ViewCommandType::push,
                               .body = "base",
                               .impulse = Vec3(0.0, 0.1, 0.0),
                               .duration = 0.01};
        for (const ViewCommand& command : {friction_now, push})
          taken += watched.feed.command(command).empty() ? 1 : 0;
        (void)watched.feed.blocks();
        (void)watched.feed.get("/api/session", {});
        (void)watched.feed.status(8);
        (void)watched.feed.messages(50);
      }
    });
  });
  ends = true;
  server.join();
  EXPECT_GT(taken, 10);
  EXPECT_GT(watched.counted.allocations, 0u) << "what is steered came to effect";
  EXPECT_EQ(watched.counted.locks, 0u);
}

TEST(LiveFeed, a_tick_is_packed_with_what_was_new_before_it_and_a_status_never_mixes_two_runs) {
  WatchedRun watched;
  closed_loop::ClosedLoopOptions options;
  options.steering = &watched.counted;
  (void)watched.wishes.command({.type = ViewCommandType::speed, .factor = 8.0});
  (void)closed_loop::run_closed_loop(watched.scenario, options);
  (void)closed_loop::run_closed_loop(watched.scenario,
                                     options);  // begun again; nobody has read yet
  const std::vector<SharedBlock> blocks = watched.feed.blocks();
  ASSERT_EQ(blocks.size(), 1u) << "what found room is of the first run";
  EXPECT_EQ(blocks.front().generation, 0u);
  EXPECT_TRUE(watched.feed.welcome().empty()) << "a page that comes now gets nothing of it";
  EXPECT_EQ(watched.feed.get("/api/frames", {{"count", "4096"}}).body.size(), kBlockHeadBytes);
  EXPECT_EQ(watched.feed.get("/api/events", {}).body, "[]");
  const std::string status = watched.feed.status(0);
  EXPECT_TRUE(holds(status, R"("tick":0,)"));
  EXPECT_TRUE(holds(status, R"("generation":1,)"));
  EXPECT_TRUE(holds(status, R"("begun":1,)"));
}

TEST(LiveFeed, a_speed_that_was_asked_for_just_now_is_not_said_to_be_missed) {
  WatchedRun watched;
  std::atomic<bool> ends{false};
  std::vector<nlohmann::json> told;
  std::thread server;
  closed_loop::ClosedLoopOptions options;
  options.steering = &watched.counted;
  options.ready = [&] {
    server = std::thread([&] {
      for (int i = 0; !ends; ++i) {
        (void)watched.feed.blocks();
        told.push_back(nlohmann::json::parse(watched.feed.status(1)));
        if (i == 160) (void)watched.wishes.command({.type = ViewCommandType::speed, .factor = 8.0});
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
    });
  };
  (void)closed_loop::run_closed_loop(watched.scenario, options);
  ends = true;
  server.join();
  const auto number = [](const char* key) {
    return [key](const nlohmann::json& status) { return status.at(key).get<double>(); };
  };
  const auto faster = std::ranges::find(told, 8.0, number("speed"));
  ASSERT_NE(faster, told.end());
  ASSERT_NE(faster, told.begin());
  EXPECT_GT(number("real_factor")(*(faster - 1)), 0.0) << "measured by then";
  EXPECT_EQ(number("real_factor")(*faster), 0.0);
}

TEST(LiveFeed, the_first_status_of_a_run_knows_no_speed_however_long_the_machine_has_been_up) {
  WatchedRun watched;
  watched.scenario.duration = 0.1;
  closed_loop::ClosedLoopOptions options;
  options.steering = &watched.counted;
  (void)closed_loop::run_closed_loop(watched.scenario, options);
  (void)watched.feed.blocks();
  const auto status = nlohmann::json::parse(watched.feed.status(1));
  EXPECT_GT(status.at("time").get<double>(), 0.0);
  EXPECT_EQ(status.at("real_factor").get<double>(), 0.0);
}

TEST(LiveFeed, a_run_that_has_begun_again_has_no_command_of_the_one_before) {
  WatchedRun watched;
  watched.scenario.duration = 0.05;
  watched.run([&] {
    const ViewCommand walk{.type = ViewCommandType::walk, .walk = true, .yaw_rate = 0.25};
    EXPECT_EQ(watched.wishes.command(walk), "");
  });
  const auto yaw_rate = [&] {
    (void)watched.feed.blocks();
    return nlohmann::json::parse(watched.feed.status(1)).at("command").at("yaw_rate");
  };
  EXPECT_EQ(yaw_rate(), 0.25);
  watched.run([&] { EXPECT_EQ(yaw_rate(), 0.0); });
}

TEST(LiveFeed, changes_of_a_run_before_are_not_told_with_those_of_the_run_that_has_begun) {
  WatchedRun watched;
  const auto changes_told = [&] {
    (void)watched.feed.blocks();
    const std::vector<std::string> told = watched.feed.messages(1);
    return std::ranges::count_if(told, [](const std::string& message) {
      return message.find(R"("kind":"change")") != std::string::npos;
    });
  };
  const auto run_with = [&](double friction) {
    watched.run([&watched, friction] {
      EXPECT_EQ(watched.feed.command({.type = ViewCommandType::friction, .value = friction}), "");
    });
  };
  run_with(0.4);
  EXPECT_EQ(changes_told(), 1);
  run_with(0.3);
  watched.run();
  EXPECT_EQ(changes_told(), 0);
}

}  // namespace
}  // namespace surefoot::server
