#include "surefoot/gaits/gait_choice.hpp"

#include "surefoot/base/error.hpp"
#include "tests/gaits/some_gaits.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

namespace surefoot::gaits {
namespace {

constexpr int kCrawl = 0, kTrot = 1, kFlight = 2, kPace = 3;

UserCommand at(double speed, int gait = UserCommand::kAutoGait) {
  return {.walk = true, .velocity = {speed, 0.0}, .gait = gait};
}

GaitChoice choice(int first = kTrot) { return {test::kTrot, test::some_gaits(), first}; }

TEST(GaitChoice, goes_by_the_speed_where_the_user_leaves_it_to_that) {
  for (const int present : {kCrawl, kTrot, kFlight, kPace}) {
    EXPECT_EQ(choice().wanted(at(0.1), present), kCrawl);
    EXPECT_EQ(choice().wanted(at(0.6), present), kTrot);
    EXPECT_EQ(choice().wanted(at(1.5), present), kFlight);
    EXPECT_EQ(choice().wanted(at(2.5), present), kFlight) << "none is faster";
  }
  UserCommand turn = at(0.0);
  turn.yaw_rate = 1.5;
  EXPECT_EQ(choice().wanted(turn, kCrawl), kTrot) << "a turn needs steps, too";
}

TEST(GaitChoice, stays_about_a_limit) {
  EXPECT_EQ(choice().wanted(at(1.15), kTrot), kTrot);
  EXPECT_EQ(choice().wanted(at(1.15), kFlight), kFlight);
  EXPECT_EQ(choice().wanted(at(1.05), kFlight), kFlight);
  EXPECT_EQ(choice().wanted(at(0.95), kFlight), kTrot);
  EXPECT_EQ(choice().wanted(at(1.25), kTrot), kFlight);
}

TEST(GaitChoice, is_the_one_that_the_command_names_and_else_the_scenarios) {
  EXPECT_EQ(choice().wanted(at(0.1, kPace), kTrot), kPace);
  EXPECT_EQ(choice().wanted(at(0.1, UserCommand::kOwnGait), kPace), kTrot);
  EXPECT_EQ(choice(UserCommand::kAutoGait).wanted(at(0.1, UserCommand::kOwnGait), kPace), kCrawl);
  EXPECT_EQ(choice(UserCommand::kAutoGait).first(), kCrawl);
  EXPECT_EQ(choice().wanted(at(0.1, 17), kPace), kPace) << "no such gait: as it is";
  EXPECT_EQ(GaitChoice(test::kTrot, {}, UserCommand::kOwnGait).wanted(at(1.0), -1), -1);
}

TEST(GaitChoice, refuses_gaits_for_other_legs_and_a_first_one_that_is_not_there) {
  std::vector<NamedGait> gaits = test::some_gaits();
  set_num_legs(gaits[1].options, 6);
  EXPECT_TRUE(test::holds(test::message_of([&] { (void)GaitChoice(test::kTrot, gaits, 0); }),
                          "\"trot\" is for 6 legs; the robot has 4"));
  EXPECT_THROW(GaitChoice(test::kTrot, {}, 2), Error);
}

}  // namespace
}  // namespace surefoot::gaits
