#include "surefoot/explain/commanded_force.hpp"

#include "server/log_frames.hpp"
#include "surefoot/closed_loop/closed_loop.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/logging/log_reader.hpp"
#include "tests/logging/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>

namespace surefoot::explain {
namespace {

/// Of each leg the largest state of the rows of its friction pyramid: 0 inside, 1 at a face, more
/// beyond it.
PerLeg<int> friction_states(const TickRecord& tick, const std::vector<std::string>& levels) {
  PerLeg<int> states{};
  for (std::int32_t i = 0; i < tick.hierarchy.num_active; ++i) {
    const ActiveRow& row = tick.hierarchy.active[static_cast<std::size_t>(i)];
    if (levels.at(static_cast<std::size_t>(row.level)) != "friction_cone") continue;
    if (row.id % tasks::FrictionCone::kRowsPerLeg == tasks::FrictionCone::kRowsPerLeg - 1) continue;
    int& state = states[static_cast<std::size_t>(row.id / tasks::FrictionCone::kRowsPerLeg)];
    state = std::max(state, std::abs(row.state));
  }
  return states;
}

void expect_full_where_a_face_is_active(const std::vector<std::string>& assignments) {
  const test::TemporaryFolder folder;
  closed_loop::ClosedLoopOptions options;
  options.record_path = folder / "run.mcap";
  (void)closed_loop::run_closed_loop(config::load_scenario({"walk_flat_ideal", 0, assignments}),
                                     options);
  logging::LogReader log(folder / "run.mcap");
  server::LogFrames frames(folder / "run.mcap", log.header());
  const auto cone = friction_cone_of(log.header());
  ASSERT_TRUE(cone);
  const auto& channels = frames.channels().channels;
  const auto channel =
      std::ranges::find(channels, "commanded.friction_use.LF", &server::ViewChannel::name);
  ASSERT_NE(channel, channels.end());
  TickRecord tick;
  std::vector<double> at_a_face, inside, shown_otherwise;
  for (std::uint32_t number = 0; log.next(tick); ++number) {
    const CommandedForces forces = commanded_forces(cone, tick, log.header().robot.least_load());
    const PerLeg<int> states = friction_states(tick, log.header().level_names);
    for (std::size_t k = 0; k < states.size(); ++k) {
      const double use = forces.friction_use[k];
      if (std::isnan(use)) continue;
      if (states[k] == 1) at_a_face.push_back(std::abs(use - 1.0));
      if (states[k] == 0) inside.push_back(use);
    }
    const float shown = frames.frame(number)->floats.at(channel->offset);
    const auto own = static_cast<float>(forces.friction_use[0]);
    if (shown != own && !(std::isnan(shown) && std::isnan(own)))
      shown_otherwise.push_back(tick.reading.time);
  }
  ASSERT_GT(at_a_face.size(), 50u);
  ASSERT_GT(inside.size(), 50u);
  EXPECT_LT(*std::ranges::max_element(at_a_face), 1e-6);
  EXPECT_LT(*std::ranges::max_element(inside), 1.0 + 1e-6);
  EXPECT_TRUE(shown_otherwise.empty());
}

TEST(CommandedForces, use_all_of_their_pyramid_where_one_of_its_faces_is_active) {
  expect_full_where_a_face_is_active(
      {"duration=4", "planner.force.friction=0.1", "stack=terrain_adaptation"});
}

TEST(CommandedForces, also_of_pyramids_about_the_vertical_around_the_cone) {
  expect_full_where_a_face_is_active(
      {"duration=4", "planner.force.friction=0.08", "stack=terrain_adaptation",
       "tasks.friction_cone.axes=gravity", "tasks.friction_cone.pyramid=outer"});
}

/// A plan whose control frame leans by an angle about an axis in the plane, all feet down.
TickRecord leaning(double angle, double friction) {
  TickRecord tick;
  const Eigen::AngleAxisd lean(angle, Vec3(0.6, 0.8, 0.0));
  tick.plan.R_WC = (lean * Eigen::AngleAxisd(0.7, Vec3::UnitZ())).toRotationMatrix();
  for (FootPlan& foot : tick.plan.feet) {
    foot.phase = LegPhase::stance;
    foot.friction = friction;
  }
  for (Vec3& force : tick.model.force) force = Vec3(8.0, -5.0, 60.0);
  return tick;
}

TEST(CommandedForces, tell_the_pyramid_that_held_them) {
  for (const double angle : {0.0, 0.1, 0.3, 0.6}) {
    for (const auto axes :
         {tasks::FrictionCone::Axes::control, tasks::FrictionCone::Axes::gravity}) {
      const TickRecord tick = leaning(angle, 0.4);
      const tasks::FrictionCone cone(
          {.pyramid = tasks::FrictionCone::Pyramid::inner, .axes = axes});
      const CommandedForces forces = commanded_forces(cone, tick, 1.0);
      const tasks::FrictionPyramid pyramid = cone.pyramid(tick.plan, Leg::LF);
      EXPECT_EQ(forces.pyramid_friction[0], pyramid.mu);
      EXPECT_TRUE(forces.q_WP[0].toRotationMatrix().isApprox(pyramid.axes, 1e-12));
      const Vec3 force_P = forces.q_WP[0].conjugate() * tick.model.force[0];
      EXPECT_NEAR(force_P.z(), forces.normal[0], 1e-9);
      EXPECT_NEAR(force_P.head<2>().cwiseAbs().maxCoeff() / (pyramid.mu * force_P.z()),
                  forces.friction_use[0], 1e-9);
    }
  }
}

TEST(CommandedForces, are_those_of_the_log_also_where_no_temporary_file_can_be_made) {
  logging::LogHeader header;
  header.attachments.push_back({"resolved_stack.yaml", "",
                                "name: own\nlevels:\n  - {task: friction_cone, axes: gravity}\n"});
  const char* folder = std::getenv("TMPDIR");
  const std::optional<std::string> before = folder ? std::optional(folder) : std::nullopt;
  setenv("TMPDIR", "/nowhere", 1);
  std::optional<tasks::FrictionCone> cone;
  EXPECT_NO_THROW(cone = friction_cone_of(header));
  before ? setenv("TMPDIR", before->c_str(), 1) : unsetenv("TMPDIR");
  EXPECT_TRUE(cone);
}

TEST(CommandedForces, are_not_known_of_feet_that_do_not_carry) {
  TickRecord tick;
  for (FootPlan& foot : tick.plan.feet) foot.phase = LegPhase::stance;
  tick.plan.feet[1].phase = LegPhase::swing;
  for (Vec3& force : tick.model.force) force = Vec3(0.0, 0.0, 50.0);
  tick.model.force[2].z() = 0.5;
  const CommandedForces forces = commanded_forces(tasks::FrictionCone({}), tick, 1.0);
  EXPECT_EQ(forces.friction_use[0], 0.0);
  EXPECT_TRUE(std::isnan(forces.normal[1]) && std::isnan(forces.friction_use[1]));
  EXPECT_TRUE(forces.q_WP[1].coeffs().array().isNaN().all());
  EXPECT_TRUE(std::isnan(forces.pyramid_friction[1]));
  EXPECT_EQ(forces.normal[2], 0.5);
  EXPECT_TRUE(std::isnan(forces.friction_use[2]));
  EXPECT_TRUE(std::isnan(commanded_forces(std::nullopt, tick, 1.0).friction_use[0]));
}

TEST(CommandedForces, are_known_from_a_share_of_the_robots_weight_on) {
  TickRecord tick;
  for (FootPlan& foot : tick.plan.feet) foot.phase = LegPhase::stance;
  for (Vec3& force : tick.model.force) force = Vec3(0.0, 0.0, 0.5);
  const auto is_known = [&](double mass) {
    logging::LogRobot robot;
    robot.mass = mass;
    const double least = robot.least_load();
    return !std::isnan(commanded_forces(tasks::FrictionCone({}), tick, least).friction_use[0]);
  };
  EXPECT_FALSE(is_known(30.0));
  EXPECT_TRUE(is_known(3.0));
  EXPECT_FALSE(is_known(kNaN)) << "as of ANYmal B";
}

TEST(CommandedForces, are_beyond_their_limits_by_more_than_rounding) {
  MotionPlan plan;
  for (FootPlan& foot : plan.feet) foot.force_max = 400.0;
  const auto beyond = [&](double normal, double use) {
    CommandedForces forces;
    forces.least_load = 1.0;
    forces.normal[0] = normal;
    forces.friction_use[0] = use;
    return beyond_limits(forces, plan, Leg::LF);
  };
  for (const auto& [normal, use] : {std::pair(-0.5, kNaN), {400.5, 1.005}, {kNaN, kNaN}})
    EXPECT_EQ(beyond(normal, use), Beyond::nothing) << normal;
  EXPECT_EQ(beyond(-39.7, kNaN), Beyond::force);
  EXPECT_EQ(beyond(500.0, 1.3), Beyond::force);
  EXPECT_EQ(beyond(80.0, 1.3), Beyond::friction);
}

}  // namespace
}  // namespace surefoot::explain
