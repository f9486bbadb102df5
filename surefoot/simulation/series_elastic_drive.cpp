#include "surefoot/simulation/series_elastic_drive.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace surefoot::simulation {

double limited_by_speed(double torque, double speed, double stall, double no_load) {
  const double share = speed / no_load;
  const double highest = stall * std::clamp(1.0 - share, 0.0, 1.0);
  const double lowest = -stall * std::clamp(1.0 + share, 0.0, 1.0);
  return std::clamp(torque, lowest, highest);
}

double quantised(double torque, double quantum, double limit) {
  constexpr double kRounding = 1e-9;  // 40 / 0.2 may be just below 200
  if (quantum <= 0.0) return std::clamp(torque, -limit, limit);
  const double most = std::floor(limit / quantum + kRounding);
  return quantum * std::clamp(std::round(torque / quantum), -most, most);
}

SeriesElasticDrive::SeriesElasticDrive(const ActuatorOptions& options, double timestep,
                                       Eigen::Index joint)
    : options_(options),
      timestep_(timestep),
      stiffness_(options.spring.stiffness),
      inertia_(options.rotor.gear_ratio * options.rotor.gear_ratio * options.rotor.inertia),
      stall_torque_(options.stall_torque[joint]),
      no_load_speed_(options.no_load_speed[joint]) {
  const double bandwidth = 2.0 * kPi * options.bandwidth_hz;
  kp_ = std::max(0.0, inertia_ * bandwidth * bandwidth / stiffness_ - 1.0);
  kd_ = std::max(0.0,
                 2.0 * options.torque_loop.damping * bandwidth * inertia_ - options.rotor.viscous);
}

void SeriesElasticDrive::rest_at(double q, double torque) noexcept {
  joint_angle_ = q;
  angle_ = q + torque / stiffness_;
  speed_ = joint_speed_ = integral_ = 0.0;
}

/// The motor's torque; at its limit the integral stands still.
double SeriesElasticDrive::controlled(double reference) noexcept {
  constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  const double measured = quantised(torque(joint_angle_), options_.quantisation, kNoLimit);
  const double error = reference - measured;
  const double grown = integral_ + kp_ * error * timestep_ / options_.torque_loop.integral_time;
  const double wanted = reference + kp_ * error + grown - kd_ * (speed_ - joint_speed_);
  const double given = limited_by_speed(wanted, speed_, stall_torque_, no_load_speed_);
  if (given == wanted) integral_ = grown;
  return given;
}

/// Friction at this speed, as a damping.
double SeriesElasticDrive::friction_damping() const noexcept {
  const RotorOptions& rotor = options_.rotor;
  const double ratio = std::abs(speed_) / rotor.coulomb_speed;
  const double slope = ratio > 1e-6 ? std::tanh(ratio) / ratio : 1.0;
  return rotor.viscous + rotor.coulomb / rotor.coulomb_speed * slope;
}

void SeriesElasticDrive::advance(double reference, double q) noexcept {
  const double torque_before = torque(joint_angle_);
  const double motor_torque = controlled(reference);
  joint_speed_ = (q - joint_angle_) / timestep_;
  joint_angle_ = q;

  const double momentum = 2.0 * inertia_ / timestep_;
  const double stiffening = 0.5 * stiffness_ * timestep_;
  const double middle_speed =
      (momentum * speed_ + motor_torque - torque_before + stiffening * joint_speed_) /
      (momentum + stiffening + friction_damping());
  angle_ += timestep_ * middle_speed;
  speed_ = 2.0 * middle_speed - speed_;
}

}  // namespace surefoot::simulation
