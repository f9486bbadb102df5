#include "surefoot/control/stack_reach.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/config/data_file.hpp"
#include "surefoot/config/stack_file.hpp"
#include "surefoot/tasks/limb_extension_limits.hpp"
#include "tests/support/anymal_b.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace surefoot::control {
namespace {

using test::message_of;

StackOptions stack_of(const std::string& task, const std::string& number, double value) {
  return {"test", {{task, {{.task = task, .numbers = {{number, value}}, .choices = {}}}}}};
}

TEST(StackReach, no_posture_reaches_further_and_a_leg_can_be_so_long) {
  const model::RobotModel model(test::anymal_b());
  const StackReach reach = reach_of(model);
  test::Random random(3);
  double longest = 0.0, furthest = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const Leg leg = kLegs[static_cast<std::size_t>(i) % kLegs.size()];
    const Vec3 q = random.vector(4.0);
    const Vec3 p_BF = model.foot_in_base(leg, q);
    longest = std::max(longest, (p_BF - model.hip_in_base(leg, q)).norm());
    furthest = std::max(furthest, p_BF.norm());
  }
  EXPECT_LE(longest, reach.leg + 1e-6);
  EXPECT_NEAR(longest, reach.leg, 1e-3);
  EXPECT_LE(furthest, reach.base);
  EXPECT_GT(furthest, 0.8 * reach.base);
}

TEST(StackReach, bounds_beyond_it_are_refused_with_what_is_valid) {
  const StackReach reach{.leg = 0.5, .base = 0.6};
  EXPECT_NO_THROW(check_reach(stack_of("limb_extension_limits", "max", 0.5), reach));
  EXPECT_NO_THROW(check_reach(stack_of("body_height_limits", "max", 0.55), reach));
  EXPECT_NO_THROW(check_reach(stack_of("com_xy", "kp", 500.0), reach));
  EXPECT_THROW(check_reach(stack_of("limb_extension_limits", "min", 0.51), reach), Error);
  EXPECT_THROW(check_reach(stack_of("body_height_limits", "max", 0.61), reach), Error);
  EXPECT_EQ(
      message_of([&] { check_reach(stack_of("limb_extension_limits", "max", 5.2), reach); }),
      "limb_extension_limits: max is 5.2, but this robot reaches only 0.5 m; valid is a number "
      "up to that");
}

TEST(StackReach, a_bound_that_is_not_given_counts_by_its_default) {
  const double usual = tasks::LimbExtensionLimits::Options().max;
  const StackOptions stack = stack_of("limb_extension_limits", "min", 0.1);
  EXPECT_NO_THROW(check_reach(stack, {.leg = usual, .base = 1.0}));
  try {
    check_reach(stack, {.leg = 0.9 * usual, .base = 1.0});
    FAIL();
  } catch (const BeyondReachError& error) {
    EXPECT_EQ(error.task(), "limb_extension_limits");
    EXPECT_EQ(error.number(), "max");
  }
}

TEST(StackReach, all_stacks_here_are_within_it) {
  const StackReach reach = reach_of(model::RobotModel(test::anymal_b()));
  const std::vector<std::string> names = config::list_data("stacks");
  ASSERT_GE(names.size(), 7u);
  for (const std::string& name : names) {
    EXPECT_NO_THROW(check_reach(config::load_stack(name), reach)) << name;
  }
}

}  // namespace
}  // namespace surefoot::control
