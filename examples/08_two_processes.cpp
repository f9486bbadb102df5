// Robot and controller in two processes, by UDP at 400 Hz. The robot's process has a watchdog:
// after 50 ms without a command it damps its joints. Here the controller ends after 4 s.
#include "examples/wire.hpp"
#include "surefoot/controller.hpp"
#include "surefoot/scenario.hpp"
#include "surefoot/simulation.hpp"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

using surefoot::config::Scenario, surefoot::SensorReading;

int run_robot(const Scenario& scenario, int udp) {
  surefoot::simulation::Plant plant(scenario.robot, scenario.plant);
  surefoot::JointVector q_before = plant.read().q;
  bool is_driven = false;  // until the controller is ready
  int ticks_driven = 0;
  for (auto next = std::chrono::steady_clock::now(); plant.time() < 4.25;) {
    const SensorReading& reading = plant.read();
    Command got;
    const bool is_there = exchange(udp, reading, got);  // waits for it for up to 50 ms
    if (is_there != is_driven)
      std::printf("%.3f s: %s\n", reading.time, is_there ? "driven" : "damped");
    ticks_driven += (is_driven = is_there) ? 1 : 0;
    surefoot::JointCommand command;
    const surefoot::JointVector qd = (reading.q - q_before) / scenario.controller.period;
    command.torque = -scenario.robot.damping_kd * qd;
    if (is_there) command.torque = got.tail<12>();
    q_before = reading.q;
    plant.write(command);
    std::this_thread::sleep_until(next += std::chrono::microseconds(2500));
  }
  return is_driven || ticks_driven < 800 ? 1 : 0;
}

void run_controller(const Scenario& scenario, int udp) {
  surefoot::control::Controller controller(
      scenario.robot, scenario.controller,
      std::make_unique<surefoot::estimation::LegInertialEstimator>(
          scenario.robot, scenario.estimator, scenario.controller.period));
  for (Sensors got = Sensors::Zero(); got[0] < 4.0;) {
    if (recv(udp, got.data(), sizeof got, 0) <= 0) continue;
    Command sent;
    sent << got[0], controller.step(unpacked(got), scenario.user(got[0])).torque;
    send(udp, sent.data(), sizeof sent, 0);
  }
}

int main() {
  const Scenario scenario = surefoot::config::load_scenario({"walk_flat", 0, {}});
  const std::array<int, 2> ends = udp_pair();
  if (fork() != 0) return run_robot(scenario, ends[0]);
  run_controller(scenario, ends[1]);
}
