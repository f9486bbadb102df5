#include "surefoot/control/safety.hpp"

#include "surefoot/control/ease.hpp"
#include "surefoot/control/lost_sensor.hpp"
#include "surefoot/math/rotation.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::control {
namespace {

constexpr double kMaxAngle = 2.0 * kPi;  // of a joint [rad]
constexpr double kFadeTime = 0.5;        // of torques without encoders [s]
constexpr double kBearingTime = 0.4;     // of the change to the bearing torques, sitting down [s]
// Shares of `sit_duration`: end of the leg motion; stance legs soften; torques and springs fade.
constexpr double kArrived = 0.75;
constexpr double kSoftFrom = 0.2, kSoft = 0.6, kUnloadBegin = 0.6;
constexpr double kLastSpring = 0.1;  // share of the spring at the end
// Shares of the PD gains for a swing leg: `hold` fits a quarter of the robot's inertia, which would
// make a free leg oscillate with delayed drives.
constexpr double kSoftSpring = 0.4, kSoftDamping = 0.175;
constexpr double kFastestLight = 25.0;  // damping of a light joint over its inertia [1/s]
constexpr double kOnGround = 4.0;       // times as fast where the ground holds the foot
constexpr double kFastestRoll = 60.0;   // damping of all HAA over the torso's inertia [1/s]
constexpr double kStiffestRoll = 50.0;  // natural frequency of the torso on their springs [rad/s]
constexpr double kSettleTime = 2.0;     // of `hold` before the first good tick [s]
constexpr double kDampFadeTime =
    1.0;  // of the damping gain, in which a falling robot comes to lie [s]
constexpr double kTiltConfirmTime = 0.03;  // in which the first readings may be wrong [s]
constexpr double kTiltHorizon = 0.2;       // prediction horizon of a tilt [s]
constexpr double kLateStartTime = 0.5;     // of limited changes after a late start [s]

JointVector finite_or_zero(const JointVector& v) {
  JointVector result = v;
  for (double& value : result) value = std::isfinite(value) ? value : 0.0;
  return result;
}

/// Of the legs: wrists may turn further.
bool is_posture(const JointVector& q, int num_leg_joints) {
  return (q.head(num_leg_joints).array().abs() <= kMaxAngle).all();  // false for NaN
}

double uprightness(const RobotState& state) {
  return is_rotation(state.q_WB) ? state.R_WB()(2, 2) : 1.0;
}

/// Is a sample replaced? False for a sensor that the robot lacks.
bool is_bridged(const GroupHealth& group) {
  return group.fault != SampleFault::none && std::isfinite(group.age);
}

/// The faulty sensor whose values are missing in the state.
StopCause missing_sensor(const RobotState& state, const SensorHealth& health) {
  const auto lacks = [](const GroupHealth& group, const auto& values) {
    return group.fault != SampleFault::none && !values.allFinite();
  };
  if (lacks(health.encoders, state.q)) return StopCause::encoders;
  if (lacks(health.imu, state.q_WB.coeffs())) return StopCause::imu;
  return lacks(health.joint_torques, state.torque) ? StopCause::joint_torques : StopCause::failures;
}

/// Progress of `share` from one value to another, 0 to 1.
double progress(double share, double from, double to) {
  return std::clamp((share - from) / (to - from), 0.0, 1.0);
}

}  // namespace

Safety::Safety(const SafetyOptions& options, const model::RobotDescription& robot,
               int first_free_level, const JointVector& lying, double period)
    : options_(options),
      torque_limit_(robot.torque_limit),
      hold_kp_(robot.hold_kp),
      hold_kd_(robot.hold_kd),
      damping_kd_(robot.damping_kd),
      scale_(robot.scale),
      num_leg_joints_(robot.num_leg_joints()),
      period_(period),
      first_free_level_(first_free_level),
      lying_q_(lying) {
  const JointVector unknown = JointVector::Constant(robot.num_joints(), kNaN);
  stopped_q_ = good_q_ = bearing_torque_ = unknown;
  command_.torque = fading_torque_ = good_torque_ = JointVector::Zero(robot.num_joints());
  spring_ = JointVector::Ones(robot.num_joints());
  const double strongest = torque_limit_.head(num_leg_joints_).maxCoeff();
  for (Eigen::Index i = num_leg_joints_; i < spring_.size(); ++i)
    spring_[i] = std::min(1.0, torque_limit_[i] / strongest);
  damper_ = spring_;
  in_air_ = JointVector::Ones(robot.num_joints());
  stands_now_ = stands_ = PerLeg<bool>(robot.num_legs(), true);
  legs_.resize(robot.num_legs());
  further_.resize(robot.num_legs());
  for (const Leg leg : legs_.legs()) {
    legs_[index(leg)] = robot.leg_joints(leg);
    further_[index(leg)] = robot.further_joints(leg);
  }
}

void Safety::soften_light(const JointVector& inertia) {
  const auto share = [&](Eigen::Index i) { return kFastestLight * inertia[i] / hold_kd_[i]; };
  for (Eigen::Index i = num_leg_joints_; i < spring_.size(); ++i)
    spring_[i] = damper_[i] = std::min(spring_[i], share(i));
  for (const auto& [first, count] : further_) {
    for (Eigen::Index i = first; i < first + count; ++i) in_air_[i] = std::min(1.0, share(i));
  }
}

void Safety::soften_roll(double inertia) {
  const double each = inertia / static_cast<double>(legs_.size());
  for (const auto& [haa, count] : legs_) {
    spring_[haa] = std::min(1.0, kStiffestRoll * kStiffestRoll * each / hold_kp_[haa]);
    damper_[haa] = std::min(1.0, kFastestRoll * each / hold_kd_[haa]);
  }
}

const JointCommand& Safety::command(const RobotState& state, const solver::Solution* solution,
                                    const SensorHealth& health) noexcept {
  const JointVector before = command_.torque;
  command_.time = std::isfinite(state.time) ? state.time : command_.time + period_;
  const bool good = is_good(state, solution);
  if (!has_begun_ && failures_ > 0) {
    late_start_ticks_ = static_cast<int>(std::lround(scale_.time() * kLateStartTime / period_));
  }
  failures_ = good ? 0 : failures_ + 1;
  if (pose_mode_) failures_ = std::min(failures_, 1 + static_cast<int>(kTiltConfirmTime / period_));
  has_begun_ = has_begun_ || good;
  check_for_stop(state, health);
  if (damping_) {
    damp(state);
  } else if (sitting_) {
    sit(state);
  } else if (pose_mode_) {
    take_posture(state);
  } else if (good) {
    follow(state, *solution);
  } else {
    hold(state);
  }
  limit();
  const bool bridges =
      is_bridged(health.encoders) || is_bridged(health.joint_torques) || is_bridged(health.imu);
  const bool is_new = !has_begun_ || late_start_ticks_ > 0 || pose_mode_;
  if (has_begun_ && late_start_ticks_ > 0) --late_start_ticks_;
  limit_change(before, has_stopped() || bridges || is_new || limits_change_);
  limits_change_ = own_part_failed_ = false;
  if ((good || pose_mode_) && !has_stopped()) good_torque_ = command_.torque;
  pose_mode_.reset();
  return command_;
}

void Safety::restart() noexcept {
  has_begun_ = false;
  late_start_ticks_ = static_cast<int>(std::lround(scale_.time() * kLateStartTime / period_));
  good_q_.setConstant(kNaN);
  bearing_torque_.setConstant(kNaN);
  stands_.fill(true);
}

bool Safety::is_tilted(const RobotState& state) const {
  return uprightness(state) < std::cos(options_.max_tilt);
}

bool Safety::will_tilt(const RobotState& state) const {
  if (!is_rotation(state.q_WB) || !state.w_WB_B.allFinite()) return false;
  const Quat soon = state.q_WB * exp_rotation(scale_.time() * kTiltHorizon * state.w_WB_B);
  return soon.toRotationMatrix()(2, 2) < std::cos(options_.max_tilt);
}

bool Safety::is_good(const RobotState& state, const solver::Solution* solution) const {
  if (solution == nullptr || is_tilted(state)) return false;
  const bool usable = solution->status == solver::SolveStatus::optimal ||
                      (solution->status == solver::SolveStatus::iteration_cap &&
                       solution->failed_level >= first_free_level_);
  return usable && solution->x.allFinite() && solution->x.size() == 6 + 2 * torque_limit_.size();
}

void Safety::check_for_stop(const RobotState& state, const SensorHealth& health) {
  if (damping_) return;
  const StopCause lost = lost_sensor(health, options_.bridge_time);
  if (lost == StopCause::encoders) note_lame_joints(state, health);
  // Ignores the tilt of an IMU that caused the sit, or that the stance legs contradict.
  const bool imu_is_doubted = (sitting_ && command_.cause == StopCause::imu) ||
                              (!has_begun_ && health.imu.fault == SampleFault::contradicts);
  const bool is_sure = !imu_is_doubted && pose_mode_ != CommandMode::lifted &&
                       (has_begun_ || failures_ * period_ > kTiltConfirmTime);
  const bool lost_joints =
      !sitting_ && (lost == StopCause::encoders || lost == StopCause::joint_torques);
  if (is_sure && (is_tilted(state) || (lost_joints && will_tilt(state)))) {
    stop(CommandMode::damping, StopCause::tilt, health);
  } else if (given_up_ != StopCause::none) {
    stop(CommandMode::damping, given_up_, health);
  } else if ((lost == StopCause::encoders || sitting_) && !can_sit(state)) {
    stop(CommandMode::damping, StopCause::encoders, health);
  } else if (lost != StopCause::none && !sitting_) {
    stopped_q_ = state.q;
    stop(can_sit(state) ? CommandMode::sit : CommandMode::damping, lost, health);
  } else if (!sitting_ && !pose_mode_ && failures_ > max_failures(state, health)) {
    stop_after_failures(state, health);
  } else if (sitting_ && command_.time - stopped_at_ >= options_.sit_duration) {
    damping_ = true;
    damped_ticks_ = static_cast<int>(std::lround(scale_.time() * kDampFadeTime / period_));
  }
}

// A robot that has not begun, but has all its sensors, gets time to settle.
double Safety::max_failures(const RobotState& state, const SensorHealth& health) const {
  const bool has_torques =
      health.joint_torques.fault == SampleFault::none || state.torque.allFinite();
  const bool has_all =
      are_all_there(health, options_.bridge_time) && state.q.allFinite() && has_torques;
  return has_all && !has_begun_ ? scale_.time() * kSettleTime / period_
                                : options_.damp_after_failures;
}

// The health names a single faulty joint only; of several, the angles are NaN. Angles that are only
// late suffice for sitting down.
void Safety::note_lame_joints(const RobotState& state, const SensorHealth& health) {
  const int reported = health.encoders.joint;
  bool is_known = false;
  for (int i = 0; i < torque_limit_.size(); ++i) {
    bool& lame = lame_[static_cast<std::size_t>(i)];
    lame = lame || i == reported || !std::isfinite(state.q[i]);
    is_known = is_known || lame;
  }
  if (!is_known && health.encoders.fault != SampleFault::late) lame_.fill(true);
}

bool Safety::can_sit(const RobotState& state) const {
  int lame_legs = 0;
  for (const Leg leg : stands_.legs()) {
    bool is_lame = false;
    const auto [first, count] = legs_[index(leg)];
    for (int i = first; i < first + count; ++i) {
      const bool lame = lame_[static_cast<std::size_t>(i)];
      is_lame = is_lame || lame;
      if (!lame && !(std::abs(state.q[i]) <= kMaxAngle)) return false;  // also if NaN
    }
    lame_legs += is_lame ? 1 : 0;
  }
  return lame_legs <= 1;
}

// Of sensors, those that never had a sample; others count as lost earlier.
void Safety::stop_after_failures(const RobotState& state, const SensorHealth& health) {
  const StopCause cause = own_part_failed_ ? StopCause::own_part : missing_sensor(state, health);
  const bool sits = cause != StopCause::failures && is_posture(state.q, num_leg_joints_);
  stopped_q_ = is_posture(good_q_, num_leg_joints_) ? good_q_ : state.q;  // the held posture
  stop(sits ? CommandMode::sit : CommandMode::damping, cause, health);
}

void Safety::stop(CommandMode mode, StopCause cause, const SensorHealth& health) {
  if (mode == CommandMode::damping && cause == StopCause::encoders) {
    fading_torque_ = sitting_ ? command_.torque : good_torque_;
    fade_begin_ = command_.time;
  }
  sitting_ = mode == CommandMode::sit;
  damping_ = mode == CommandMode::damping;
  if (command_.cause != StopCause::none) return;
  command_.cause = cause;
  if (const GroupHealth* group = group_of(health, cause)) {
    command_.fault = group->fault;
    command_.joint = group->joint;
  }
  stopped_at_ = command_.time;
}

void Safety::follow(const RobotState& state, const solver::Solution& solution) {
  const bool solved = solution.status == solver::SolveStatus::optimal;
  command_.mode = solved ? CommandMode::optimal : CommandMode::degraded;
  command_.torque = solution.x.tail(torque_limit_.size());
  good_q_ = state.q;
  stands_ = stands_now_;
  bearing_torque_.setConstant(kNaN);
}

void Safety::hold(const RobotState& state) {
  command_.mode = CommandMode::hold;
  if (!good_q_.allFinite() && is_posture(state.q, num_leg_joints_)) good_q_ = state.q;
  command_.torque = good_torque_ + pull(state, good_q_, JointVector::Zero(good_q_.size()));
}

JointVector Safety::pull(const RobotState& state, const JointVector& q, const JointVector& qd,
                         double softness, double spring) const {
  JointVector kp = hold_kp_.cwiseProduct(spring_), kd = hold_kd_.cwiseProduct(damper_);
  for (const Leg leg : stands_.legs()) {
    const double soft = stands_[index(leg)] ? softness : 1.0;
    const auto [first, count] = legs_[index(leg)];
    kp.segment(first, count) *= 1.0 - soft * (1.0 - kSoftSpring);
    kd.segment(first, count) *= 1.0 - soft * (1.0 - kSoftDamping);
    const auto [further, num_further] = further_[index(leg)];
    const double firmer = stands_[index(leg)] ? kOnGround : 1.0;
    for (Eigen::Index i = further; i < further + num_further; ++i) {
      const double share = std::min(1.0, firmer * in_air_[i]);
      kp[i] *= share;
      kd[i] *= share;
    }
  }
  // Separate terms: if q is unknown the damping still works, and vice versa.
  return spring * finite_or_zero(kp.cwiseProduct(q - state.q)) +
         finite_or_zero(kd.cwiseProduct(qd - state.qd));
}

void Safety::sit(const RobotState& state) {
  command_.mode = CommandMode::sit;
  const double time = command_.time - stopped_at_, duration = options_.sit_duration;
  const double share = std::clamp(time / duration, 0.0, 1.0);
  const double arrived = progress(share, 0.0, kArrived);
  const JointVector way = lying_q_ - stopped_q_;
  const JointVector q = stopped_q_ + ease(arrived) * way;
  const JointVector qd = ease_slope(arrived) / (kArrived * duration) * way;
  const double unloaded = ease(progress(share, kUnloadBegin, 1.0));
  if (bearing_torque_.allFinite())
    borne_ = std::min(1.0, borne_ + period_ / (scale_.time() * kBearingTime));
  const double bears = ease(borne_);
  JointVector carried = (1.0 - bears) * good_torque_ + bears * finite_or_zero(bearing_torque_);
  JointVector pulled = pull(state, q, qd, ease(progress(share, kSoftFrom, kSoft)),
                            1.0 - unloaded * (1.0 - kLastSpring));
  for (int i = 0; i < torque_limit_.size(); ++i) {
    if (!lame_[static_cast<std::size_t>(i)]) continue;
    carried[i] = good_torque_[i];
    pulled[i] = 0.0;
  }
  command_.torque = (1.0 - unloaded) * carried + pulled;
}

void Safety::take_posture(const RobotState& state) {
  command_.mode = *pose_mode_;
  good_q_ = state.q;
  stands_ = posture_.stands;
  command_.torque = pull(state, posture_.q, posture_.qd, posture_.softness);
  if (bearing_torque_.allFinite()) command_.torque += posture_.bears * bearing_torque_;
}

void Safety::damp(const RobotState& state) {
  command_.mode = CommandMode::damping;
  const double faded = std::min(1.0, damped_ticks_ * period_ / (scale_.time() * kDampFadeTime));
  const JointVector soft_kd = damping_kd_.cwiseMin(kSoftDamping * hold_kd_);
  const JointVector kd = damping_kd_ + faded * (soft_kd - damping_kd_);
  if (faded < 1.0) ++damped_ticks_;
  command_.torque =
      -kd.cwiseProduct(finite_or_zero(damper_.cwiseProduct(in_air_).cwiseProduct(state.qd)));
  if (!std::isfinite(fade_begin_)) return;
  const double share = (command_.time - fade_begin_) / (scale_.time() * kFadeTime);
  command_.torque += std::clamp(1.0 - share, 0.0, 1.0) * fading_torque_;
}

void Safety::limit() {
  command_.torque =
      finite_or_zero(command_.torque).cwiseMax(-torque_limit_).cwiseMin(torque_limit_);
}

void Safety::limit_change(const JointVector& before, bool wanted) {
  if (!wanted && !change_is_limited_) return;
  const JointVector step = JointVector::Constant(before.size(), options_.max_torque_change);
  const JointVector limited = command_.torque.cwiseMax(before - step).cwiseMin(before + step);
  change_is_limited_ = limited != command_.torque;
  command_.torque = limited;
}

}  // namespace surefoot::control
