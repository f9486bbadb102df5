#include "app/operator_forces.hpp"

#include "tests/config/messages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace surefoot {
namespace {

constexpr double kPeriod = 0.0025;

Push push(double time, double force, double duration, const std::string& body = "base") {
  return {.body = body, .time = time, .duration = duration, .force = Vec3(0.0, force, 0.0)};
}

TEST(OperatorForces, pushes_that_are_too_small_for_the_limits_are_not_taken_without_end) {
  OperatorForces forces(ViewLimits(), {"base"});
  int taken = 0;
  std::string problem;
  for (int i = 0; i < 1000; ++i) {
    const std::string told = forces.push(push(0.0, 1e-9, 0.001));
    taken += told.empty() ? 1 : 0;
    if (!told.empty()) problem = told;
  }
  EXPECT_EQ(taken, 100);
  EXPECT_TRUE(test::holds(problem, "100 pushes act already")) << problem;
  forces.advance(0.0025);
  EXPECT_EQ(forces.push(push(0.0025, 1e-9, 0.001)), "");
}

TEST(OperatorForces, whatever_is_asked_for_the_limits_hold_at_each_time_and_over_each_window) {
  const ViewLimits limits;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    OperatorForces forces(limits, {"base", "LF_SHANK"});
    std::vector<Push> acting;
    double pulled = 0.0, time = 0.0;
    std::vector<double> given{0.0};  // up to each tick [N·s]
    for (int tick = 0; tick < 2000; ++tick, time = tick * kPeriod) {
      forces.advance(time);
      if (share(random) < 0.02) {
        const double duration = 0.001 + share(random), force = 300.0 * share(random);
        const Push wanted = push(time, force, duration, share(random) < 0.5 ? "base" : "LF_SHANK");
        if (forces.push(wanted).empty()) acting.push_back(wanted);
      }
      if (tick % 20 == 0 || forces.is_too_much(kPeriod)) {
        const Vec3 force = forces.bounded(Vec3(300.0 * share(random), 300.0, 0.0));
        forces.pull({.body = "base", .force = force}, true);
        pulled = force.norm();
      }
      double sum = pulled, impulse = kPeriod * pulled;
      for (const Push& one : acting) {
        const double end = one.time + one.duration;
        if (time < end - 1e-6) sum += one.force.norm();
        impulse += one.force.norm() * std::clamp(end - time, 0.0, kPeriod);
      }
      ASSERT_LE(sum, limits.push_force + 1e-5) << seed;
      ASSERT_GE(forces.now().store, -1e-6) << seed;
      given.push_back(given.back() + impulse);
    }
    for (std::size_t from = 0; from < given.size(); from += 7) {
      for (std::size_t to = from; to < given.size(); to += 5) {
        const double window = kPeriod * static_cast<double>(to - from);
        ASSERT_LE(given[to] - given[from], limits.push_impulse + limits.push_refill * window + 1e-5)
            << seed;
      }
    }
  }
}

TEST(OperatorForces, pushes_and_pulls_are_counted_apart_along_the_way_of_the_force) {
  OperatorForces forces(ViewLimits(), {"base", "LF_SHANK"});
  EXPECT_EQ(forces.push(push(0.0, 100.0, 0.1)), "");
  EXPECT_EQ(forces.push(push(0.0, -100.0, 0.2, "LF_SHANK")), "");
  forces.pull({.body = "base", .force = Vec3(30.0, 0.0, 0.0)}, false);
  forces.advance(0.1);
  forces.pull({.body = "base", .force = Vec3(-30.0, 0.0, 0.0)}, false);
  forces.advance(0.15);
  EXPECT_NEAR(forces.now().push.given, 25.0, 1e-9);
  EXPECT_NEAR(forces.now().pull.given, 4.5, 1e-9);
  EXPECT_EQ(forces.now().push.force, Vec3(0.0, -100.0, 0.0));
  EXPECT_EQ(forces.now().push.body, 1);
  forces.advance(0.3);
  EXPECT_EQ(forces.now().push.body, -1);
  EXPECT_EQ(forces.push(push(0.3, 10.0, 0.1)), "");
  forces.advance(0.4);
  EXPECT_NEAR(forces.now().push.given, 1.0, 1e-9) << "of those that overlap";
}

TEST(OperatorForces, a_push_that_is_left_out_is_told_with_what_would_be_valid) {
  OperatorForces forces(ViewLimits(), {"base"});
  EXPECT_EQ(forces.push(push(0.0, 250.0, 0.2)), "");
  EXPECT_TRUE(test::holds(forces.push(push(0.0, 60.0, 0.1)), "up to 300 N at one time"));
  forces.advance(0.2);
  const std::string problem = forces.push(push(0.2, 60.0, 1.0));
  EXPECT_TRUE(test::holds(problem, "22 N·s can be given now")) << problem;
  EXPECT_TRUE(test::holds(problem, "60 N·s more each second")) << problem;
  forces.advance(0.9);
  EXPECT_EQ(forces.push(push(0.9, 60.0, 1.0)), "");
}

}  // namespace
}  // namespace surefoot
