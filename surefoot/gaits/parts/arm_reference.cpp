#include "surefoot/gaits/parts/arm_reference.hpp"

#include "surefoot/math/rotation.hpp"

namespace surefoot::gaits {
namespace {

constexpr double kRate = 3.0;  // ω [rad/s]
constexpr double kLongest =
    0.2;  // way that counts, which limits the speed to kRate / 3 times it [m]
constexpr double kFarthest = 0.6;  // the same of a turn [rad]

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

void follow(const Vec3& target, double most, double rate, double period, Motion<Vec3>& motion) {
  const Vec3 way = clip_norm<3>(target - motion.p, most);
  const Vec3 jerk = rate * rate * rate * way - 3.0 * rate * rate * motion.v - 3.0 * rate * motion.a;
  motion.a += period * jerk;
  motion.v += period * motion.a;
  motion.p += period * motion.v;
}

}  // namespace

ArmReference::ArmReference(double period, const Scale& scale)
    : period_(period), rate_(scale.rate() * kRate), longest_(scale.length * kLongest) {}

void ArmReference::begin(const ReachCommand& command, const RobotState& state,
                         const model::FrameKinematics& tip) {
  const Frame frame = frame_of(command, state);
  const Vec3 arm = tip.point.p - frame.p;
  position_ = {frame.R.transpose() * arm,
               frame.R.transpose() * (tip.point.v - frame.v - frame.w.cross(arm)), Vec3::Zero()};
  turn_ = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  first_ = Quat(frame.R.transpose() * tip.rotation.R);
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
  follow(command.position, longest_, rate_, period_, position_);
  const bool turns = command.orientation.allFinite();
  const Vec3 turn =
      turns ? box_minus(from_roll_pitch_yaw(command.orientation), first_) : Vec3(Vec3::Zero());
  follow(turn, kFarthest, rate_, period_, turn_);
  const Frame frame = frame_of(command, state);
  const Vec3 arm = frame.R * position_.p;
  return {.arm = command.arm,
          .p_WT = frame.p + arm,
          .v_WT = frame.v + frame.w.cross(arm) + frame.R * position_.v,
          .a_WT = frame.R * position_.a,
          .q_WT = Quat(frame.R) * (exp_rotation(turn_.p) * first_),
          .w_WT = frame.w + frame.R * turn_.v};
}

}  // namespace surefoot::gaits
