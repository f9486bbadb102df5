// Your robot: a file that names its URDF, frames and limits (docs/robots.md), and a RobotPort that
// talks to its drives. Here the port drives a simulated one.
//
//     03_own_robot my_robot.yaml
#include "surefoot/controller.hpp"
#include "surefoot/robot.hpp"
#include "surefoot/scenario.hpp"
#include "surefoot/simulation.hpp"

#include <cstdio>
#include <memory>
#include <string>

using surefoot::JointCommand, surefoot::SensorReading, surefoot::config::Scenario;

/// Yours reads the bus in read() and writes to it in write().
class MyDriver final : public surefoot::robot::RobotPort {
 public:
  explicit MyDriver(const Scenario& scenario) : bus_(scenario.robot, scenario.plant) {}

  const SensorReading& read() override {
    reading_ = bus_.read();  // joints in the order of the robot file, all in SI units, and their
    return reading_;         // times by one clock; NaN for what your robot does not measure
  }
  void write(const JointCommand& command) override {
    bus_.write(command);  // [N·m]; finite and within the limits of the robot file
  }

 private:
  surefoot::simulation::Plant bus_;
  SensorReading reading_;
};

int main(int argc, char** argv) {
  const std::string robot = argc > 1 ? argv[1] : "hexapod";
  try {
    const Scenario scenario = surefoot::config::load_scenario(
        {.name_or_path = "walk_flat", .seed = 0, .assignments = {"robot=" + robot}});
    MyDriver driver(scenario);
    surefoot::control::Controller controller(
        scenario.robot, scenario.controller,
        std::make_unique<surefoot::estimation::LegInertialEstimator>(
            scenario.robot, scenario.estimator, scenario.controller.period));
    for (const std::string& note : controller.notes()) std::printf("note: %s\n", note.c_str());
    for (int tick = 0; tick * scenario.controller.period < 15.0; ++tick) {
      const SensorReading& reading = driver.read();
      driver.write(controller.step(reading, scenario.user(reading.time)));
    }
    const surefoot::TickRecord& last = controller.record();
    std::printf("%s: %d steps, %.2f m\n", robot.c_str(), controller.steps_taken(),
                last.state.p_WB.x());
    return last.command.mode == surefoot::CommandMode::optimal ? 0 : 1;
  } catch (const surefoot::Error& error) {  // names the file, its line and what would be valid
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
