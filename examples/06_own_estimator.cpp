// A state estimator of your own: motion capture sees the base 200 times a second with
// 0.5 mm of noise; between its samples accelerometer and gyroscope go on.
#include "surefoot/controller.hpp"
#include "surefoot/scenario.hpp"
#include "surefoot/simulation.hpp"

#include <cstdio>
#include <memory>
#include <random>

class MotionCapture final : public surefoot::estimation::StateEstimator {
 public:
  MotionCapture(const surefoot::simulation::Plant& plant, double period)
      : plant_(plant), period_(period) {}

  const surefoot::RobotState& update(const surefoot::SensorReading& reading,
                                     const surefoot::TickContext& context) override {
    if (++tick_ % 2 == 0 || std::isnan(state_.time)) take_sample();
    state_.v_WB += period_ * (state_.q_WB * reading.accelerometer - surefoot::Vec3(0, 0, 9.81));
    state_.p_WB += period_ * state_.v_WB;
    state_.time = reading.time;
    state_.w_WB_B = reading.gyro;
    state_.q = reading.q;
    state_.qd = context.joint_velocity;  // observed from encoders and torques
    state_.torque = reading.torque;
    return state_;
  }
  void restart() override { state_ = {}; }

 private:
  void take_sample() {                                               // of an α-β filter
    const surefoot::simulation::GroundTruth& seen = plant_.truth();  // what the cameras see: W = S
    if (std::isnan(state_.time)) state_.p_WB = seen.p_SB, state_.v_WB.setZero();
    surefoot::Vec3 residual = seen.p_SB - state_.p_WB;
    for (double& axis : residual) axis += noise_(random_);
    state_.p_WB += 0.1 * residual;
    state_.v_WB += 0.01 / (2.0 * period_) * residual;
    state_.q_WB = seen.q_SB;
  }

  const surefoot::simulation::Plant& plant_;
  double period_;  // of the control loop [s]
  int tick_ = 0;
  std::mt19937 random_{1};
  std::normal_distribution<double> noise_{0.0, 0.0005};  // [m]
  surefoot::RobotState state_;
};

int main() {
  const auto scenario =
      surefoot::config::load_scenario({"walk_flat", 0, {"planner.calibration.duration=0"}});
  surefoot::simulation::Plant plant(scenario.robot, scenario.plant);
  surefoot::control::Controller controller(
      scenario.robot, scenario.controller,
      std::make_unique<MotionCapture>(plant, scenario.controller.period));
  while (plant.time() < 12.0)
    plant.write(controller.step(plant.read(), scenario.user(plant.time())));
  std::printf("%d steps, %.2f m\n", controller.steps_taken(), plant.truth().p_SB.x());
  return controller.steps_taken() > 4 ? 0 : 1;
}
