#include "tests/gaits/puppet.hpp"
#include "tests/gaits/some_gaits.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace surefoot::gaits {
namespace {

constexpr double kPeriod = test::Puppet::kPeriod;
constexpr double kCycle = 1.6;  // of the crawl, in which it sways [s]
constexpr int kCrawl = 0, kTrot = 1, kFlight = 2, kPace = 3;

test::Puppet walker(int gait, double speed) {
  test::Puppet puppet(test::kTrot, test::level_ground(), Vec2::Zero(), 0.0, test::some_gaits(),
                      kTrot);
  puppet.user = {.walk = true, .velocity = {speed, 0.0}, .gait = gait};
  return puppet;
}

/// No reference and no force limit may jump.
struct Smooth {
  const test::Puppet& puppet;
  MotionPlan before = puppet.plan();

  void operator()() {
    const MotionPlan& now = puppet.plan();
    ASSERT_LT((now.com.v - before.com.v).norm(), 0.05) << puppet.time();
    ASSERT_LT((now.com.a - before.com.a).norm(), 6.0) << puppet.time();
    ASSERT_LT(std::abs(now.torso.height - before.torso.height), 0.01) << puppet.time();
    ASSERT_LT(std::abs(now.torso.height_rate - before.torso.height_rate), 0.2) << puppet.time();
    for (std::size_t k = 0; k < kNumLegs; ++k)
      ASSERT_LT(std::abs(now.feet[k].force_max - before.feet[k].force_max), 100.0) << puppet.time();
    before = now;
  }
};

TEST(GaitChange, happens_on_the_way_without_a_jump_between_any_two_gaits) {
  for (const int from : {kCrawl, kTrot, kFlight, kPace}) {
    for (const int to : {kCrawl, kTrot, kFlight, kPace}) {
      if (from == to) continue;
      test::Puppet puppet = walker(from, 0.2);
      puppet.run(6.0);
      ASSERT_EQ(puppet.plan().gait, from);
      puppet.user.gait = to;
      double slowest = 1.0;
      std::vector<double> places;
      puppet.run(4.0, [&, smooth = Smooth{puppet}]() mutable {
        smooth();
        places.push_back(puppet.com().x());
        const auto cycle = static_cast<std::size_t>(std::lround(kCycle / kPeriod));
        if (places.size() > cycle)
          slowest = std::min(slowest, (places.back() - *(places.end() - 1 - cycle)) / kCycle);
      });
      EXPECT_EQ(puppet.plan().gait, to) << from;
      if (to != kCrawl) {
        EXPECT_GT(slowest, 0.05) << "it does not stop, from " << from << " to " << to;
      }
      EXPECT_EQ(puppet.happenings(PlanEvent::gait_changed).size(), from == kTrot ? 1u : 2u);
    }
  }
}

TEST(GaitChange, sways_before_the_first_step_of_a_crawl_and_does_not_turn_then) {
  test::Puppet puppet = walker(kTrot, 0.1);
  puppet.user.yaw_rate = 0.3;
  puppet.run(6.0);
  puppet.user.gait = kCrawl;
  while (puppet.plan().gait != kCrawl && puppet.time() < 10.0) puppet.tick();
  const std::size_t steps = puppet.happenings(PlanEvent::lift_off).size();
  puppet.run(0.5);
  EXPECT_EQ(puppet.plan().gait, kCrawl);
  EXPECT_EQ(puppet.happenings(PlanEvent::lift_off).size(), steps);
  EXPECT_EQ(puppet.plan().torso.w_WB.z(), 0.0);
  puppet.run(1.0);
  EXPECT_GT(puppet.happenings(PlanEvent::lift_off).size(), steps + 1);
  EXPECT_GT(puppet.plan().torso.w_WB.z(), 0.1);
}

TEST(GaitChange, waits_until_the_robot_is_slow_enough_for_the_next_gait) {
  test::Puppet puppet = walker(kTrot, 1.0);
  puppet.run(5.0);
  puppet.user.gait = kCrawl;
  double first = 0.0;
  puppet.run(3.0, [&] {
    if (puppet.plan().gait == kCrawl && first == 0.0) first = puppet.plan().com.v.x();
  });
  EXPECT_EQ(puppet.plan().gait, kCrawl);
  EXPECT_LT(first, 0.18);
  EXPECT_FALSE(puppet.happenings(PlanEvent::too_fast).empty()) << "1 m/s is told";
  const double begin = puppet.com().x();
  puppet.run(2.0 * kCycle);
  const double speed = (puppet.com().x() - begin) / (2.0 * kCycle);
  EXPECT_GT(speed, 0.2) << "as its strides allow";
  EXPECT_LT(speed, 0.31);
}

TEST(GaitChange, that_can_not_be_is_told_once_and_the_gait_stays) {
  for (const int unknown : {7, -5, UserCommand::kKeepGait}) {
    const PlanEvent event =
        unknown == UserCommand::kKeepGait ? PlanEvent::invalid_command : PlanEvent::unknown_gait;
    test::Puppet puppet = walker(kCrawl, 0.1);
    puppet.run(4.0);
    ASSERT_TRUE(puppet.happenings(event).empty());
    puppet.user.gait = unknown;
    puppet.run(2.0);
    EXPECT_EQ(puppet.plan().gait, kCrawl);
    EXPECT_EQ(puppet.happenings(event).size(), 1u) << unknown;
    for (const int known : {UserCommand::kOwnGait, kCrawl, UserCommand::kAutoGait}) {
      puppet.user.gait = known;
      puppet.run(0.1);
    }
    EXPECT_EQ(puppet.happenings(event).size(), 1u) << unknown;
    puppet.user.gait = unknown;
    puppet.run(0.1);
    EXPECT_EQ(puppet.happenings(event).size(), 2u) << "asked for once more";
  }
}

TEST(GaitChange, follows_the_speed_if_the_user_wants_it_so) {
  test::Puppet puppet = walker(UserCommand::kAutoGait, 0.1);
  puppet.run(4.0);
  EXPECT_EQ(puppet.plan().gait, kCrawl);
  for (const auto& [speed, gait] : {std::pair{0.6, kTrot}, {1.5, kFlight}, {0.1, kCrawl}}) {
    puppet.user.velocity.x() = speed;
    puppet.run(6.0);
    EXPECT_EQ(puppet.plan().gait, gait) << speed;
  }
}

TEST(GaitChange, is_at_once_where_the_robot_stands) {
  test::Puppet puppet = walker(kTrot, 0.0);
  puppet.user.walk = false;
  puppet.run(0.5);
  puppet.user.gait = kPace;
  puppet.run(2 * kPeriod);
  EXPECT_EQ(puppet.plan().gait, kPace);
  EXPECT_EQ(puppet.plan().num_contacts(), kNumLegs);
}

TEST(GaitChange, to_one_that_stands_comes_to_rest_on_all_feet) {
  std::vector<NamedGait> gaits = test::some_gaits();
  gaits.push_back({"stand", {}});
  gaits.back().options.rhythm.stands = true;
  test::Puppet puppet(test::kTrot, test::level_ground(), Vec2::Zero(), 0.0, gaits, kTrot);
  puppet.user = {.walk = true, .velocity = {0.5, 0.0}, .gait = kTrot};
  puppet.run(3.0);
  puppet.user.gait = 4;
  puppet.run(3.0);
  EXPECT_EQ(puppet.plan().num_contacts(), kNumLegs);
  EXPECT_LT(puppet.plan().com.v.norm(), 0.01);
  puppet.user.gait = kTrot;
  puppet.run(3.0);
  EXPECT_NEAR(puppet.plan().com.v.x(), 0.5, 0.01);
}

TEST(GaitChange, begins_with_the_legs_that_have_stood_longest) {
  for (const int from : {kCrawl, kTrot}) {
    for (const double when : {5.0, 5.25, 5.4, 5.8, 6.2}) {
      test::Puppet puppet = walker(from, 0.2);
      puppet.run(when);
      ASSERT_EQ(puppet.plan().gait, from);
      puppet.user.gait = kFlight;
      puppet.run(2.0);
      const double change = puppet.happenings(PlanEvent::gait_changed).back().time;
      Leg landed = Leg::LF;
      for (const test::Happening& touchdown : puppet.happenings(PlanEvent::touchdown)) {
        if (touchdown.time <= change) landed = touchdown.leg;
      }
      const Leg first = puppet.first_after(change, PlanEvent::lift_off).leg;
      const auto is_of_first_pair = [](Leg k) { return k == Leg::LF || k == Leg::RH; };
      EXPECT_NE(is_of_first_pair(first), is_of_first_pair(landed)) << from << ", " << when << " s";
    }
  }
}

TEST(GaitChange, to_a_slow_crawl_sways_before_the_first_leg_lifts_off) {
  test::Puppet puppet = walker(kTrot, 0.2);
  puppet.run(5.0);
  puppet.user.gait = kCrawl;
  puppet.run(4.0);
  const double change = puppet.happenings(PlanEvent::gait_changed).back().time;
  EXPECT_GT(puppet.first_after(change, PlanEvent::lift_off).time - change, 0.1 * kCycle);
}

/// Speed of the COM's reference when the gait changes.
double speed_of_change(int from, int to) {
  test::Puppet puppet = walker(from, 1.0);
  puppet.run(5.0);
  puppet.user.gait = to;
  double speed = 0.0;
  puppet.run(4.0, [&] {
    if (puppet.plan().gait == to && speed == 0.0) speed = puppet.plan().com.v.x();
  });
  return speed;
}

TEST(GaitChange, is_slow_where_other_legs_step_together) {
  EXPECT_GT(speed_of_change(kTrot, kFlight), 0.5);
  EXPECT_GT(speed_of_change(kTrot, kPace), 0.2);
  EXPECT_LT(speed_of_change(kTrot, kPace), 0.4);
}

/// Half the mean distance between left and right feet.
double half_width(const test::Puppet& puppet) {
  double sum = 0.0;
  for (const Leg k : puppet.plan().feet.legs())
    sum += std::abs(puppet.foot(k).y() - puppet.com().y());
  return sum / kNumLegs;
}

TEST(GaitChange, of_a_narrow_gait_widens_the_stance_and_leaves_no_leg_unloaded) {
  std::vector<NamedGait> gaits = test::some_gaits();
  gaits[kPace].options.stance.half_width = 0.1;
  test::Puppet puppet(test::kTrot, test::level_ground(), Vec2::Zero(), 0.0, gaits, kTrot);
  puppet.user = {.walk = true, .velocity = {0.2, 0.0}, .gait = kPace};
  puppet.run(5.0);
  ASSERT_LT(half_width(puppet), 0.13);
  puppet.user.gait = kCrawl;
  puppet.run(4.0, [&] {
    if (puppet.happenings(PlanEvent::gait_changed).size() == 1) return;
    ASSERT_GT(half_width(puppet), 0.19) << "it crawls";
  });
  EXPECT_EQ(puppet.plan().gait, kCrawl);
  puppet.user.gait = kPace;
  puppet.run(4.0);
  puppet.user.walk = false;
  puppet.run(3.0);
  EXPECT_GT(half_width(puppet), 0.19) << "it stands";
  for (const FootPlan& foot : puppet.plan().feet) EXPECT_GT(foot.force_max, 100.0);
}

}  // namespace
}  // namespace surefoot::gaits
