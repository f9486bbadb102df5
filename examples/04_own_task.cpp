// A task of your own: the robot keeps its front hips equally high, in a stack that names the task
// as any other. If it threw, or wrote NaN, the robot would sit down, and `fault()` name the task.
#include "surefoot/closed_loop.hpp"
#include "surefoot/scenario.hpp"
#include "surefoot/stack.hpp"

#include <cstdio>

namespace tasks = surefoot::tasks;

/// (J_L − J_R) u̇ = kp (p_R − p_L) + kd (v_R − v_L) − (J̇_L − J̇_R) u, all along z, of the front hips.
class LevelHips final : public tasks::Task {
 public:
  struct Options {
    double kp = 200.0, kd = 28.0;  // [1/s²], [1/s]
  };
  explicit LevelHips(const Options& options) : options_(options) {}

  void write(const tasks::TaskInput& input, surefoot::solver::Level& level) const override {
    const surefoot::model::PointKinematics& l = input.dynamics.hip[0];
    const surefoot::model::PointKinematics& r = input.dynamics.hip[1];
    surefoot::solver::Rows rows = level.add(1, first_id());  // over x = (u̇, τ), zero so far
    rows.A.leftCols(input.dynamics.num_velocities()) = l.J.row(2) - r.J.row(2);
    rows.set_equal(0, options_.kp * (r.p - l.p).z() + options_.kd * (r.v - l.v).z() -
                          (l.Jdot_u - r.Jdot_u).z());
  }
  int max_rows() const override { return 1; }
  std::string_view name() const override { return "level_hips"; }
  std::string row_name(int) const override { return "left above right"; }

 private:
  Options options_;
};

int main() {
  tasks::OwnTasks own;
  tasks::TaskEntry<LevelHips>("level_hips", "front hips are equally high", "–", "m/s²")
      .number("kp", &LevelHips::Options::kp, "1/s²", "position gain")
      .number("kd", &LevelHips::Options::kd, "1/s", "velocity gain")
      .add_to(own);
  auto scenario = surefoot::config::load_scenario({"walk_flat", 0, {"duration=14"}, own});
  const auto faults = tasks::check_task("level_hips", scenario.robot, own);  // in your tests
  for (const std::string& fault : faults) std::printf("%s\n", fault.c_str());
  scenario.controller.stack = surefoot::config::parse_stack(R"(
name: level_hips
base: terrain_adaptation
levels: [equations_of_motion, no_contact_motion, torque_limits, friction_cone, com_xy, swing_foot,
         torso_yaw, torso_height, {task: level_hips, kp: 300}, torso_roll_pitch,
         contact_force_minimisation]
)",
                                                            "04_own_task.cpp", {}, own);
  const auto result = surefoot::closed_loop::run_closed_loop(scenario, {});
  std::printf("%s; it walked %.2f m\n", result.metrics.reason.c_str(), result.metrics.distance_m);
  return faults.empty() && !result.safety_stop && result.metrics.distance_m > 0.1 ? 0 : 1;
}
