#include "surefoot/simulation/actuators.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::simulation {

Actuators::Actuators(const ActuatorOptions& options, const JointVector& torque_limit,
                     double timestep, Eigen::Index num_leg_joints)
    : options_(options),
      limit_(torque_limit),
      gain_(options.torque_gain * options.joint_torque_gain),
      quantum_(JointVector::Constant(torque_limit.size(), options.quantisation)),
      lag_(-std::expm1(-2.0 * kPi * options.bandwidth_hz * timestep)),
      delayed_(static_cast<std::size_t>(options.delay_ticks),
               JointVector::Zero(torque_limit.size())),
      commanded_(JointVector::Zero(torque_limit.size())),
      motor_(commanded_) {
  quantum_.tail(torque_limit.size() - num_leg_joints).setZero();
  if (options.model == ActuatorModel::sea && options.level == 2) {
    for (Eigen::Index joint = 0; joint < torque_limit.size(); ++joint)
      drives_.emplace_back(options, timestep, joint);
  }
}

void Actuators::rest_at(const JointVector& q, const JointVector& torque) noexcept {
  const bool is_ideal = options_.model == ActuatorModel::ideal;
  commanded_ = is_ideal ? torque : JointVector(torque.cwiseQuotient(gain_));
  std::ranges::fill(delayed_, commanded_);
  motor_ = torque;
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    const auto joint = static_cast<Eigen::Index>(i);
    drives_[i].rest_at(q[joint], torque[joint]);
  }
}

void Actuators::command(const JointVector& torque) noexcept {
  const JointVector clipped = torque.cwiseMin(limit_).cwiseMax(-limit_);
  if (options_.model == ActuatorModel::ideal || delayed_.empty()) {
    commanded_ = clipped;
    return;
  }
  commanded_ = delayed_[oldest_];
  delayed_[oldest_] = clipped;
  oldest_ = (oldest_ + 1) % delayed_.size();
}

JointVector Actuators::torque(const JointVector& q, const JointVector& qd) const noexcept {
  if (options_.model == ActuatorModel::ideal) return commanded_;
  JointVector result(q.size());
  for (Eigen::Index i = 0; i < result.size(); ++i) {
    if (!drives_.empty()) {
      result[i] = drives_[static_cast<std::size_t>(i)].torque(q[i]);
      continue;
    }
    const double limited =
        limited_by_speed(motor_[i], qd[i], options_.stall_torque[i], options_.no_load_speed[i]);
    result[i] = quantised(limited, quantum_[i], limit_[i]);
  }
  return result;
}

void Actuators::advance(const JointVector& q) noexcept {
  const JointVector reference = gain_.cwiseProduct(commanded_);
  motor_ += lag_ * (reference - motor_);
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    const auto joint = static_cast<Eigen::Index>(i);
    drives_[i].advance(reference[joint], q[joint]);
  }
}

}  // namespace surefoot::simulation
