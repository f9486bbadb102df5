#include "surefoot/evaluation/effort_judge.hpp"

#include <cmath>

namespace surefoot::evaluation {

void EffortJudge::add(const simulation::GroundTruth& truth, const JointVector& command) {
  torque_ = std::fmax(torque_, truth.torque.cwiseAbs().maxCoeff());
  torque_command_ = std::fmax(torque_command_, command.cwiseAbs().maxCoeff());
  speed_ = std::fmax(speed_, truth.qd.cwiseAbs().maxCoeff());
  if (command_.size() == command.size())
    torque_step_ = std::fmax(torque_step_, (command - command_).cwiseAbs().maxCoeff());
  command_ = command;
}

void EffortJudge::add_walk(const simulation::GroundTruth& truth) {
  work_ += period_ * truth.torque.cwiseProduct(truth.qd).cwiseMax(0.0).sum();
}

void EffortJudge::write(double way, Metrics& metrics) const {
  metrics.torque_max_nm = torque_;
  metrics.torque_command_max_nm = torque_command_;
  metrics.torque_step_max_nm = torque_step_;
  metrics.joint_speed_max_radps = speed_;
  if (way >= shortest_) metrics.cost_of_transport = work_ / (mass_ * kGravity * way);
}

}  // namespace surefoot::evaluation
