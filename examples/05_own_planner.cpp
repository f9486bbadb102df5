// A planner of your own with our tasks: the robot stands, moves its centre of mass in a circle and
// bows. The tasks follow the MotionPlan, whoever made it.
#include "surefoot/closed_loop.hpp"
#include "surefoot/controller.hpp"
#include "surefoot/scenario.hpp"

#include <cmath>
#include <cstdio>
#include <memory>

class Dance final : public surefoot::gaits::MotionPlanner {
 public:
  const surefoot::MotionPlan& update(const surefoot::UserCommand&,
                                     const surefoot::RobotState& state,
                                     const surefoot::model::Dynamics& dynamics,
                                     const surefoot::HierarchyOutcome&) override {
    if (!has_begun_) begin(state, dynamics);
    const double t = state.time - begin_, ramp = 1.0 - std::exp(-t), w = 2.0;  // [s], [rad/s]
    const surefoot::Vec2 out(std::cos(w * t), std::sin(w * t)), along(-out.y(), out.x());
    constexpr double kRadius = 0.03;  // [m]
    plan_.com.p = centre_ + ramp * kRadius * out;
    plan_.com.v = ramp * kRadius * w * along;
    plan_.com.a = -ramp * kRadius * w * w * out;
    plan_.torso.height = height_ - ramp * 0.02 * (1.0 - std::cos(t));
    const double bow = ramp * 0.1 * std::sin(t);  // [rad]
    plan_.torso.q_WB = heading_ * Eigen::AngleAxisd(bow, surefoot::Vec3::UnitY());
    return plan_;
  }
  void restart() override { has_begun_ = false; }

 private:
  /// Feet stay where they are, and may carry the robot.
  void begin(const surefoot::RobotState& state, const surefoot::model::Dynamics& dynamics) {
    has_begun_ = true;
    begin_ = state.time;
    centre_ = dynamics.com.p.head<2>();
    height_ = state.p_WB.z();
    heading_ = Eigen::AngleAxisd(std::atan2(state.R_WB()(1, 0), state.R_WB()(0, 0)),
                                 surefoot::Vec3::UnitZ());
    plan_.feet.resize(dynamics.num_legs());
    for (const surefoot::Leg leg : plan_.feet.legs())
      plan_.feet[index(leg)] = {.p_WF = dynamics.foot[index(leg)].p, .force_max = 400.0};
  }

  surefoot::MotionPlan plan_;
  bool has_begun_ = false;
  double begin_ = 0.0, height_ = 0.0;
  surefoot::Vec2 centre_{0.0, 0.0};
  surefoot::Quat heading_ = surefoot::Quat::Identity();
};

int main() {
  const auto scenario = surefoot::config::load_scenario({"walk_flat", 0, {"duration=8"}});
  const auto result = surefoot::closed_loop::run_closed_loop(
      scenario, {.make_planner = [] { return std::make_unique<Dance>(); }});
  const double error = 1e3 * result.metrics.com_error_rms_m;
  std::printf("%s; off the circle by %.1f mm rms\n", result.metrics.reason.c_str(), error);
  return !result.safety_stop && error < 10.0 ? 0 : 1;
}
