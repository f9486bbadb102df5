#include "surefoot/evaluation/command_judge.hpp"

#include "surefoot/math/rotation.hpp"

#include <cmath>

namespace surefoot::evaluation {

void CommandJudge::add(const simulation::GroundTruth& truth, const UserCommand& user) {
  const bool is_same = user.velocity == command_.velocity && user.yaw_rate == command_.yaw_rate;
  command_ = user;
  steady_for_ = is_same ? steady_for_ + period_ : 0.0;
  if (steady_for_ < settled_) return;
  const Mat3 R_SB = truth.q_SB.toRotationMatrix();
  const Vec3 v = rotation_about_z(-yaw(R_SB)) * truth.v_SCom;
  velocity_squares_ += (v.head<2>() - user.velocity).squaredNorm();
  const double turn = (R_SB * truth.w_SB_B).z() - user.yaw_rate;
  turn_squares_ += turn * turn;
  ++ticks_;
}

void CommandJudge::write(Metrics& metrics) const {
  if (ticks_ == 0) return;
  const auto n = static_cast<double>(ticks_);
  metrics.command_error_rms_mps = std::sqrt(velocity_squares_ / n);
  metrics.turn_error_rms_radps = std::sqrt(turn_squares_ / n);
}

}  // namespace surefoot::evaluation
