// Other robots than ANYmal B, and ANYmal B at other sizes, walk by the same scenarios and stacks.
#include "surefoot/closed_loop/closed_loop.hpp"
#include "surefoot/config/robot_file.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "tests/logging/temporary_folder.hpp"
#include "tests/scenarios/loop.hpp"
#include "tests/support/hexapod.hpp"
#include "tests/support/source_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace surefoot {
namespace {

evaluation::Metrics walked(const std::string& scenario, const std::string& robot,
                           std::vector<std::string> assignments = {}) {
  assignments.push_back("robot=" + robot);
  return closed_loop::run_closed_loop(config::load_scenario({scenario, 1, assignments}), {})
      .metrics;
}

class Robots : public testing::TestWithParam<const char*> {};

TEST_P(Robots, WalkOnFlatGroundByItsCriteriaAndStepDownATenthOfTheirLeg) {
  const evaluation::Metrics flat = walked("walk_flat", GetParam());
  EXPECT_EQ(flat.succeeded, true) << flat.reason;
  EXPECT_EQ(flat.false_touchdowns, 0);
  const evaluation::Metrics down =
      walked(test::source_file("campaigns/robots/step_down_10.yaml"), GetParam());
  EXPECT_EQ(down.succeeded, true) << down.reason;
  EXPECT_LE(down.false_touchdowns, 1);  // HyQ has one, its shanks on the edge
}

INSTANTIATE_TEST_SUITE_P(Each, Robots,
                         testing::Values("anymal_c", "a1", "go1", "go2", "b1", "laikago", "hyq",
                                         "solo12", "aliengo", "a2", "b2", "mini_cheetah", "spot"),
                         [](const auto& robot) { return std::string(robot.param); });

TEST(Hexapod, WalksOnFlatGroundAndStepsDownATenthOfItsLeg) {
  for (const char* scenario : {"flat.yaml", "step_down_10.yaml"}) {
    const evaluation::Metrics result =
        walked(test::source_file("campaigns/robots/") + scenario, "hexapod");
    EXPECT_EQ(result.succeeded, true) << scenario << ": " << result.reason;
    EXPECT_EQ(result.false_touchdowns, 0) << scenario;
    EXPECT_GT(result.steps_taken, 20) << scenario;
  }
}

TEST(Hexapod, NothingIsAllocatedAsItWalks) {
  test::Loop loop(test::scenario("walk_flat", {"robot=hexapod"}, 1));
  loop.run_until(13.0);
  EXPECT_GT(loop.count(PlanEvent::lift_off), 3);
  EXPECT_EQ(loop.allocations(), 0U) << loop.last_allocation();
}

TEST(FurtherJoints, OfLegsAllocateNothingAsTheyWalk) {
  const test::TemporaryFolder folder;
  test::write_file(folder / "hexapod.urdf", test::hexapod_urdf_with_further_joints());
  test::write_file(folder / "robot.yaml", test::contents(test::source_file("robots/hexapod.yaml")) +
                                              "  center: [0, 0, -0.05]\n");
  test::Loop loop(test::scenario("walk_flat", {"robot=" + (folder / "robot.yaml")}, 1));
  loop.run_until(15.0);
  EXPECT_GT(loop.count(PlanEvent::lift_off), 3);
  EXPECT_EQ(loop.allocations(), 0U) << loop.last_allocation();
}

/// Every number behind `attribute="` in a text, times a factor.
std::string multiplied(const std::string& text, const std::string& attribute, double factor) {
  const std::regex place(attribute + "=\"([^\"]*)\"");
  std::string result;
  auto begin = text.cbegin();
  for (std::sregex_iterator match(text.begin(), text.end(), place), end; match != end; ++match) {
    result.append(begin, (*match)[1].first);
    std::istringstream numbers((*match)[1].str());
    std::string separator;
    for (double number = 0.0; numbers >> number; separator = " ") {
      std::array<char, 32> digits{};
      std::snprintf(digits.data(), digits.size(), "%.17g", factor * number);
      result += separator + digits.data();
    }
    begin = (*match)[1].second;
  }
  return result.append(begin, text.cend());
}

/// ANYmal B of `size` times its length, of the same density.
std::string write_anymal_b(const test::TemporaryFolder& folder, double size) {
  std::string urdf = test::contents(config::load_robot("anymal_b").urdf_path);
  for (const char* length : {"<origin[^>]*xyz", "length", "radius", "size"})
    urdf = multiplied(urdf, length, size);
  urdf = multiplied(urdf, "<mass value", std::pow(size, 3.0));
  for (const char* inertia : {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"})
    urdf = multiplied(urdf, inertia, std::pow(size, 5.0));
  test::write_file(folder / "robot.urdf", urdf);
  std::array<char, 800> file{};
  std::snprintf(file.data(), file.size(),
                "name: anymal_b\nurdf: robot.urdf\n"
                "legs: {LF: {foot: LF_FOOT}, RF: {foot: RF_FOOT}, LH: {foot: LH_FOOT},"
                " RH: {foot: RH_FOOT}}\n"
                "foot: {radius: %.17g, center: [0, 0, %.17g]}\n"
                "limits: {torque: %.17g, velocity: %.17g, position_min: [-1.2, -2.6, -2.9],"
                " position_max: [1.2, 2.6, 2.9]}\n"
                "drives: {stall_torque: %.17g, no_load_speed: %.17g}\n"
                "posture: {nominal: [0, 0.4, -0.8]}\n",
                0.031 * size, 0.02325 * size, 40.0 * std::pow(size, 4.0), 15.0 / std::sqrt(size),
                40.0 * std::pow(size, 4.0), 12.0 / std::sqrt(size));
  test::write_file(folder / "robot.yaml", file.data());
  return folder / "robot.yaml";
}

constexpr double kMidSwing = 12.3;  // 0.3 s from touchdowns: a tick's delay changes no count [s]

/// With the true state and ideal drives, and the times of clock and contacts to size: no noise, no
/// tick is left that differs.
TEST(Sizes, WalkTheSameWalkAtEachTick) {
  const evaluation::Metrics one =
      walked("walk_flat_ideal", "anymal_b", {"duration=" + std::to_string(kMidSwing)});
  for (const double size : {0.5, 2.0}) {
    const test::TemporaryFolder folder;
    const double time = std::sqrt(size);
    const auto scaled = [](const char* key, double number) {
      std::array<char, 80> text{};
      std::snprintf(text.data(), text.size(), "%s=%.17g", key, number);
      return std::string(text.data());
    };
    const evaluation::Metrics other = walked(
        "walk_flat_ideal", write_anymal_b(folder, size),
        {scaled("duration", kMidSwing * time), scaled("period", 0.0025 * time),
         scaled("timestep", 0.0005 * time), scaled("foot_contact.solref_time", 0.005 * time)});
    const auto expect_same = [size](double here, double there, double share, const char* what) {
      EXPECT_NEAR(here, there, share * there) << what << " at size " << size;
    };
    EXPECT_EQ(other.steps_taken, one.steps_taken) << size;
    expect_same(other.speed_mps / time, one.speed_mps, 0.01, "speed");
    expect_same(other.com_lateral_sway_m / size, one.com_lateral_sway_m, 0.01, "sway");
    expect_same(other.torque_max_nm / std::pow(size, 4.0), one.torque_max_nm, 0.02, "torque");
    expect_same(other.com_error_max_m / size, one.com_error_max_m, 0.1, "COM error");
  }
}

TEST(Sizes, WalkTheSameWalk) {
  const evaluation::Metrics one = walked("walk_flat", "anymal_b");
  for (const double size : {0.5, 2.0}) {
    const test::TemporaryFolder folder;
    const std::string robot = write_anymal_b(folder, size);
    const Scale scale = config::load_robot(robot).scale;
    EXPECT_NEAR(scale.length, size, 1e-9);
    EXPECT_NEAR(scale.mass, std::pow(size, 3.0), 1e-9);
    const evaluation::Metrics other = walked("walk_flat", robot);
    EXPECT_EQ(other.succeeded, true) << size << ": " << other.reason;
    EXPECT_NEAR(other.steps_taken, one.steps_taken, 1) << size;
    EXPECT_NEAR(other.speed_mps / std::sqrt(size), one.speed_mps, 0.02 * one.speed_mps) << size;
    EXPECT_NEAR(other.com_lateral_sway_m / size, one.com_lateral_sway_m,
                0.05 * one.com_lateral_sway_m)
        << size;
    EXPECT_NEAR(other.torque_max_nm / std::pow(size, 4.0), one.torque_max_nm,
                0.15 * one.torque_max_nm)
        << size;
    const double grown = std::max(1.0, size);  // the sensors' noise does not shrink
    EXPECT_LT(other.com_error_max_m, 1.5 * grown * one.com_error_max_m) << size;
    EXPECT_EQ(other.false_touchdowns, 0) << size;
  }
}

}  // namespace
}  // namespace surefoot
