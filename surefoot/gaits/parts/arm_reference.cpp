#include "surefoot/gaits/parts/arm_reference.hpp"

#include "surefoot/math/rotation.hpp"

namespace surefoot::gaits {
namespace {

/// The frame that a command is given in.
struct Frame {
  Vec3 p = Vec3::Zero(), v = Vec3::Zero(), w = Vec3::Zero();  // in W
  Mat3 R = Mat3::Identity();
};

Frame frame_of(const ReachCommand& command, const RobotState& state) {
  if (command.in_world) return {};
  const Mat3 R = state.R_WB();
  return {state.p_WB, state.v_WB, R * state.w_WB_B, R};
}

}  // namespace

ArmReference::ArmReference(double period, const Scale& scale) : pose_(period, scale) {}

void ArmReference::begin(const ReachCommand& command, const RobotState& state,
                         const model::FrameKinematics& tip) {
  const Frame frame = frame_of(command, state);
  const Vec3 arm = tip.point.p - frame.p;
  pose_.begin(frame.R.transpose() * arm,
              frame.R.transpose() * (tip.point.v - frame.v - frame.w.cross(arm)),
              Quat(frame.R.transpose() * tip.rotation.R));
}

ArmPlan ArmReference::update(const ReachCommand& command, const RobotState& state,
                             const model::Dynamics& dynamics) noexcept {
  const bool reaches = command.arm >= 0 && command.position.allFinite() &&
                       command.arm < static_cast<int>(dynamics.arm_tips.size());
  if (!reaches) {
    command_ = {};
    return {};
  }
  const auto& tip = dynamics.arm_tips[static_cast<std::size_t>(command.arm)];
  if (command.arm != command_.arm || command.in_world != command_.in_world) {
    begin(command, state, tip);
  }
  command_ = command;
  pose_.update(command.position, command.orientation);
  const Frame frame = frame_of(command, state);
  const Mat3 to_X = frame.R.transpose();
  pose_.wait_for(to_X * (tip.point.p - frame.p), Quat(to_X * tip.rotation.R));
  const Vec3 arm = frame.R * pose_.position().p;
  return {.arm = command.arm,
          .p_WT = frame.p + arm,
          .v_WT = frame.v + frame.w.cross(arm) + frame.R * pose_.position().v,
          .a_WT = frame.R * pose_.position().a,
          .q_WT = Quat(frame.R) * pose_.orientation(),
          .w_WT = frame.w + frame.R * pose_.angular_velocity()};
}

}  // namespace surefoot::gaits
