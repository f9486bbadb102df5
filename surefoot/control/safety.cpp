#include "surefoot/control/safety.hpp"

#include "surefoot/control/ease.hpp"
#include "surefoot/control/lost_sensor.hpp"
#include "surefoot/math/rotation.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::control {
namespace {

constexpr double kFullTurn = 2.0 * kPi;  // no joint is turned further [rad]
constexpr double kFadeTime = 0.5;        // of torques that nothing holds any more [s]
// Of the way down: the last torques turn into those that bear the robot, the posture arrives, legs
// become as soft as one that bears nothing, torques and springs fade.
constexpr double kBearingTime = 0.4;                   // [s]
constexpr double kArrived = 0.75;                      // share of `sit_duration` …
constexpr double kSoftFrom = 0.2, kSoft = 0.6;         // … here, too …
constexpr double kLightFrom = 0.6, kLastSpring = 0.1;  // … and of the spring
// Shares of spring and damping with which a leg that bears nothing does not swing behind drives
// that are late: they fit its inertia, `hold` fits a quarter of the robot.
constexpr double kSoftSpring = 0.4, kSoftDamping = 0.175;
constexpr double kToStand = 2.0;      // for which a robot that has not begun is held [s]
constexpr double kDampFade = 1.0;     // of the damping: what falls lies by then [s]
constexpr double kUnsureTilt = 0.03;  // of a robot that has not begun [s]
constexpr double kTipTime = 0.2;      // for which a robot that tips goes on turning [s]
constexpr double kUnsteady = 0.5;  // for which little is known of a robot that has begun late [s]

JointVector finite_or_zero(const JointVector& v) {
  JointVector result = v;
  for (double& value : result) value = std::isfinite(value) ? value : 0.0;
  return result;
}

bool is_posture(const JointVector& q) {
  return (q.array().abs() <= kFullTurn).all();  // not if it is NaN
}

double uprightness(const RobotState& state) {
  return is_rotation(state.q_WB) ? state.R_WB()(2, 2) : 1.0;
}

/// Is something filled in? Not for a sensor that the robot does not have.
bool is_bridged(const GroupHealth& group) {
  return group.fault != SampleFault::none && std::isfinite(group.age);
}

/// The sensor at fault whose samples the state lacks.
StopCause missing_sensor(const RobotState& state, const SensorHealth& health) {
  const auto lacks = [](const GroupHealth& group, const auto& values) {
    return group.fault != SampleFault::none && !values.allFinite();
  };
  if (lacks(health.encoders, state.q)) return StopCause::encoders;
  if (lacks(health.imu, state.q_WB.coeffs())) return StopCause::imu;
  return lacks(health.joint_torques, state.torque) ? StopCause::joint_torques : StopCause::failures;
}

/// How far from one share of the way to another, 0 to 1.
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
      period_(period),
      first_free_level_(first_free_level),
      lying_q_(lying) {
  stands_now_.fill(true);
  stands_.fill(true);
}

const JointCommand& Safety::command(const RobotState& state, const solver::Solution* solution,
                                    const SensorHealth& health) noexcept {
  const JointVector before = command_.torque;
  command_.time = std::isfinite(state.time) ? state.time : command_.time + period_;
  const bool good = is_good(state, solution);
  if (!has_begun_ && failures_ > 0) {
    unsteady_ticks_ = static_cast<int>(std::lround(scale_.time() * kUnsteady / period_));
  }
  failures_ = good ? 0 : failures_ + 1;
  if (posed_) failures_ = std::min(failures_, 1 + static_cast<int>(kUnsureTilt / period_));
  has_begun_ = has_begun_ || good;
  look_for_a_stop(state, health);
  if (damping_) {
    damp(state);
  } else if (sitting_) {
    sit(state);
  } else if (posed_) {
    take_posture(state);
  } else if (good) {
    follow(state, *solution);
  } else {
    hold(state);
  }
  limit();
  const bool bridges =
      is_bridged(health.encoders) || is_bridged(health.joint_torques) || is_bridged(health.imu);
  const bool is_new = !has_begun_ || unsteady_ticks_ > 0 || posed_;
  if (has_begun_ && unsteady_ticks_ > 0) --unsteady_ticks_;
  limit_change(before, has_stopped() || bridges || is_new || is_careful_);
  is_careful_ = false;
  if ((good || posed_) && !has_stopped()) good_torque_ = command_.torque;
  posed_.reset();
  return command_;
}

void Safety::begin_anew() noexcept {
  has_begun_ = false;
  unsteady_ticks_ = static_cast<int>(std::lround(scale_.time() * kUnsteady / period_));
  good_q_.setConstant(kNaN);
  bearing_torque_.setConstant(kNaN);
  stands_.fill(true);
}

bool Safety::is_tilted(const RobotState& state) const {
  return uprightness(state) < std::cos(options_.max_tilt);
}

bool Safety::tips(const RobotState& state) const {
  if (!is_rotation(state.q_WB) || !state.w_WB_B.allFinite()) return false;
  const Quat soon = state.q_WB * exp_rotation(scale_.time() * kTipTime * state.w_WB_B);
  return soon.toRotationMatrix()(2, 2) < std::cos(options_.max_tilt);
}

bool Safety::is_good(const RobotState& state, const solver::Solution* solution) const {
  if (solution == nullptr || is_tilted(state)) return false;
  const bool usable = solution->status == solver::SolveStatus::optimal ||
                      (solution->status == solver::SolveStatus::iteration_cap &&
                       solution->failed_level >= first_free_level_);
  return usable && solution->x.allFinite() && solution->x.size() == kNumUnknowns;
}

void Safety::look_for_a_stop(const RobotState& state, const SensorHealth& health) {
  if (damping_) return;
  const StopCause lost = lost_sensor(health, options_.bridge_time);
  if (lost == StopCause::encoders) note_lame_joints(state, health);
  // An IMU that made the robot sit down is not believed, nor one that the standing legs contradict.
  const bool lies = (sitting_ && command_.cause == StopCause::imu) ||
                    (!has_begun_ && health.imu.fault == SampleFault::contradicts);
  const bool is_sure =
      !lies && posed_ != CommandMode::lifted && (has_begun_ || failures_ * period_ > kUnsureTilt);
  const bool lost_joints =
      !sitting_ && (lost == StopCause::encoders || lost == StopCause::joint_torques);
  if (is_sure && (is_tilted(state) || (lost_joints && tips(state)))) {
    stop(CommandMode::damping, StopCause::tilt, health);
  } else if (given_up_ != StopCause::none) {
    stop(CommandMode::damping, given_up_, health);
  } else if ((lost == StopCause::encoders || sitting_) && !can_sit(state)) {
    stop(CommandMode::damping, StopCause::encoders, health);
  } else if (lost != StopCause::none && !sitting_) {
    stopped_q_ = state.q;
    stop(can_sit(state) ? CommandMode::sit : CommandMode::damping, lost, health);
  } else if (!sitting_ && !posed_ && failures_ > patience(state, health)) {
    stop_after_failures(state, health);
  } else if (sitting_ && command_.time - stopped_at_ >= options_.sit_duration) {
    damping_ = true;
    damped_ticks_ = static_cast<int>(std::lround(scale_.time() * kDampFade / period_));
  }
}

// A robot that has all its sensors, be one of them bridged, but has not begun, is to stand first.
double Safety::patience(const RobotState& state, const SensorHealth& health) const {
  const auto is_well = [](const GroupHealth& group) { return group.fault == SampleFault::none; };
  const auto is_there = [&](const GroupHealth& group) {
    return is_well(group) ||
           (std::isfinite(group.age) && !is_lost(group.age, options_.bridge_time));
  };
  const bool has_torques = is_well(health.joint_torques) || state.torque.allFinite();
  const bool has_all = is_there(health.encoders) && is_there(health.joint_torques) &&
                       is_there(health.imu) && state.q.allFinite() && has_torques;
  return has_all && !has_begun_ ? scale_.time() * kToStand / period_ : options_.damp_after_failures;
}

// Of several joints at fault the health does not say which: those whose angles are unknown are.
// Angles that only come late are good enough to sit down by.
void Safety::note_lame_joints(const RobotState& state, const SensorHealth& health) {
  const int one = health.encoders.joint;
  bool is_known = false;
  for (int i = 0; i < kNumJoints; ++i) {
    bool& lame = lame_[static_cast<std::size_t>(i)];
    lame = lame || i == one || !std::isfinite(state.q[i]);
    is_known = is_known || lame;
  }
  if (!is_known && health.encoders.fault != SampleFault::late) lame_.fill(true);
}

bool Safety::can_sit(const RobotState& state) const {
  int lame_legs = 0;
  for (const Leg leg : kLegs) {
    bool is_lame = false;
    for (int i = first_joint(leg); i < first_joint(leg) + kJointsPerLeg; ++i) {
      const bool lame = lame_[static_cast<std::size_t>(i)];
      is_lame = is_lame || lame;
      if (!lame && !(std::abs(state.q[i]) <= kFullTurn)) return false;  // nor if it is NaN
    }
    lame_legs += is_lame ? 1 : 0;
  }
  return lame_legs <= 1;
}

// A sensor that is there from the start has been lost before; one that never came is missed here.
void Safety::stop_after_failures(const RobotState& state, const SensorHealth& health) {
  const StopCause cause = missing_sensor(state, health);
  const bool sits = is_sensor(cause) && is_posture(state.q);
  stopped_q_ = is_posture(good_q_) ? good_q_ : state.q;  // what is held
  stop(sits ? CommandMode::sit : CommandMode::damping, cause, health);
}

void Safety::stop(CommandMode mode, StopCause cause, const SensorHealth& health) {
  if (mode == CommandMode::damping && cause == StopCause::encoders) {
    fading_torque_ = sitting_ ? command_.torque : good_torque_;
    damped_at_ = command_.time;
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
  command_.torque = solution.x.tail<kNumJoints>();
  good_q_ = state.q;
  stands_ = stands_now_;
  bearing_torque_.setConstant(kNaN);  // of another posture
}

void Safety::hold(const RobotState& state) {
  command_.mode = CommandMode::hold;
  if (!good_q_.allFinite() && is_posture(state.q)) good_q_ = state.q;
  command_.torque = good_torque_ + pull(state, good_q_, JointVector::Zero());
}

JointVector Safety::pull(const RobotState& state, const JointVector& q, const JointVector& qd,
                         double softness, double spring) const {
  JointVector kp, kd;
  for (const Leg leg : kLegs) {
    const double soft = stands_[index(leg)] ? softness : 1.0;
    kp.segment<3>(first_joint(leg)).setConstant(hold_kp_ * (1.0 - soft * (1.0 - kSoftSpring)));
    kd.segment<3>(first_joint(leg)).setConstant(hold_kd_ * (1.0 - soft * (1.0 - kSoftDamping)));
  }
  // Apart, for where the position is not known the damping still works, and the other way round.
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
  const double light = ease(progress(share, kLightFrom, 1.0));
  if (bearing_torque_.allFinite())
    borne_ = std::min(1.0, borne_ + period_ / (scale_.time() * kBearingTime));
  const double bears = ease(borne_);
  JointVector carried = (1.0 - bears) * good_torque_ + bears * finite_or_zero(bearing_torque_);
  JointVector pulled = pull(state, q, qd, ease(progress(share, kSoftFrom, kSoft)),
                            1.0 - light * (1.0 - kLastSpring));
  for (int i = 0; i < kNumJoints; ++i) {
    if (!lame_[static_cast<std::size_t>(i)]) continue;
    carried[i] = good_torque_[i];
    pulled[i] = 0.0;
  }
  command_.torque = (1.0 - light) * carried + pulled;
}

void Safety::take_posture(const RobotState& state) {
  command_.mode = *posed_;
  good_q_ = state.q;
  stands_ = posture_.stands;
  command_.torque = pull(state, posture_.q, posture_.qd, posture_.softness);
  if (bearing_torque_.allFinite()) command_.torque += posture_.bears * bearing_torque_;
}

void Safety::damp(const RobotState& state) {
  command_.mode = CommandMode::damping;
  const double gone = std::min(1.0, damped_ticks_ * period_ / (scale_.time() * kDampFade));
  const double last = std::min(damping_kd_, kSoftDamping * hold_kd_);
  const double kd = damping_kd_ + gone * (last - damping_kd_);
  if (gone < 1.0) ++damped_ticks_;
  command_.torque = -kd * finite_or_zero(state.qd);
  if (!std::isfinite(damped_at_)) return;
  const double share = (command_.time - damped_at_) / (scale_.time() * kFadeTime);
  command_.torque += std::clamp(1.0 - share, 0.0, 1.0) * fading_torque_;
}

void Safety::limit() {
  command_.torque =
      finite_or_zero(command_.torque).cwiseMax(-torque_limit_).cwiseMin(torque_limit_);
}

void Safety::limit_change(const JointVector& before, bool wanted) {
  if (!wanted && !catching_up_) return;
  const JointVector step = JointVector::Constant(options_.max_torque_change);
  const JointVector limited = command_.torque.cwiseMax(before - step).cwiseMin(before + step);
  catching_up_ = limited != command_.torque;
  command_.torque = limited;
}

}  // namespace surefoot::control
