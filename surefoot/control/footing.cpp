#include "surefoot/control/footing.hpp"

#include "surefoot/control/ease.hpp"
#include "surefoot/control/standing_torque.hpp"
#include "surefoot/gaits/parts/leg_limits.hpp"
#include "surefoot/math/rotation.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::control {
namespace {

constexpr double kMaxLyingHeight = 0.6;   // share of the hips' height in the stance
constexpr double kMinFoldedHeight = 0.2;  // share of it
constexpr double kGuessHip = 1.0;         // initial guess of the inverse kinematics [rad]
constexpr double kGuessKnee = 1.8;        // initial guess of the inverse kinematics [rad]
constexpr double kMeanSpeed = 0.6;        // of the joints during a motion [rad/s]
constexpr double kMinDuration = 1.0;      // of a motion [s]
constexpr double kLoadTime = 0.5;         // in which the feet take over the weight [s]
constexpr double kStiffenTime = 0.5;      // of the joints, once the feet carry the robot [s]
constexpr double kStiffness = 0.8;        // share of the way from soft to stiff
constexpr double kSettleTime = 0.5;       // after the motion [s]
constexpr double kStandTimeout = 3.0;     // after the motion, until rising has failed [s]
constexpr double kMaxTilt = 0.5;          // of a standing torso [rad]
constexpr double kRighting = 5.0;         // ω of the righting moment [rad/s]
constexpr double kRightingDamping = 0.8;  // ζ of it
constexpr double kMaxError = 0.2;         // of a joint that has reached the posture [rad]
constexpr double kMaxSpeed = 0.3;         // of a joint at rest [rad/s]

}  // namespace

void Footing::look_at_start(const model::RobotModel& model, const JointVector& q) noexcept {
  if (!stands() || !q.allFinite()) return;
  const int num_legs = model.description().num_legs();
  knees_.resize(num_legs);
  double height = 0.0;
  for (const Leg leg : knees_.legs()) {
    const Vec3 q_leg = q.segment<3>(first_joint(leg));
    knees_[index(leg)] = std::copysign(1.0, q_leg.z());
    height -= model.foot_in_base(leg, q_leg).z() / num_legs;
  }
  if (!is_low(height)) return;
  const double folded = kMinFoldedHeight * gaits::hip_height(stance_, scale_) - scale_.hip_height;
  go(State::folds, q, posture_at(model, std::max(height, folded)));
}

PlanEvent Footing::update(const model::RobotModel& model, const RobotState& state,
                          const estimation::LiftDetector& lift) noexcept {
  const JointVector& q = state.q;
  restarts_ = false;
  time_ += period_;
  switch (state_) {
    case State::stands:
      if (!lift.is_lifted()) return PlanEvent::none;
      has_fallen_ = lies(model, state);
      return has_fallen_ ? PlanEvent::none : hang(model, q);
    case State::hangs:
      if (!lift.is_down()) return PlanEvent::none;
      rise(model, q, 1.0);
      return PlanEvent::stands_up;
    case State::folds:
      if (time_ < duration_) return PlanEvent::none;
      rise(model, q, 0.0);
      return PlanEvent::stands_up;
    case State::rises:
      return update_rise(model, state, lift);
  }
  return PlanEvent::none;
}

PlanEvent Footing::update_rise(const model::RobotModel& model, const RobotState& state,
                               const estimation::LiftDetector& lift) {
  if (lift.is_down()) stood_for_ += period_;
  const bool has_arrived = time_ > duration_ + scale_.time() * kSettleTime;
  if (lift.is_lifted() && (stood_for_ > 0.0 || has_arrived)) return hang(model, state.q);
  has_failed_ = state.R_WB()(2, 2) < std::cos(kMaxTilt);
  if (!has_arrived) return PlanEvent::none;
  const int n = model.description().num_leg_joints();
  const bool is_there = (state.q - to_).head(n).cwiseAbs().maxCoeff() < kMaxError;
  const bool is_at_rest = state.qd.head(n).cwiseAbs().maxCoeff() < scale_.rate() * kMaxSpeed;
  if (is_there && is_at_rest && lift.is_down() && !has_failed_) {
    state_ = State::stands;
    restarts_ = true;
  } else {
    has_failed_ = has_failed_ || time_ > duration_ + scale_.time() * kStandTimeout;
  }
  return PlanEvent::none;
}

bool Footing::is_low(double height) const {
  return height + scale_.hip_height < kMaxLyingHeight * gaits::hip_height(stance_, scale_);
}

bool Footing::lies(const model::RobotModel& model, const RobotState& state) const {
  const Mat3 R_WB = state.R_WB();
  double lowest = 0.0;
  for (const Leg leg : model.description().legs.legs()) {
    const Vec3 p_BF = model.foot_in_base(leg, state.q.segment<3>(first_joint(leg)));
    lowest = std::min(lowest, R_WB.row(2).dot(p_BF));
  }
  return R_WB(2, 2) < std::cos(kMaxTilt) || is_low(-lowest);
}

PlanEvent Footing::hang(const model::RobotModel& model, const JointVector& q) {
  go(State::hangs, q, posture_at(model, stance_.height));
  return PlanEvent::lifted;
}

void Footing::rise(const model::RobotModel& model, const JointVector& q, double borne) {
  go(State::rises, q, posture_at(model, stance_.height));
  borne_ = borne;
  stood_for_ = 0.0;
}

void Footing::go(State state, const JointVector& q, const JointVector& to) {
  state_ = state;
  from_ = q;
  to_ = to;
  time_ = 0.0;
  const double speed = scale_.rate() * kMeanSpeed;
  duration_ = std::max(scale_.time() * kMinDuration, (to - q).cwiseAbs().maxCoeff() / speed);
}

JointVector Footing::posture_at(const model::RobotModel& model, double height) const {
  const model::RobotDescription& robot = model.description();
  JointVector result = robot.q_nominal;
  for (const Leg leg : robot.legs.legs()) {
    const Vec3 nominal = robot.q_nominal.segment<3>(first_joint(leg));
    const double knee = kGuessKnee * knees_[index(leg)];
    const double hip = std::copysign(kGuessHip, nominal.y() * nominal.z() * knee);
    Vec3 p_BF, q_leg;
    p_BF << gaits::nominal_offset(stance_, leg, robot.num_legs()), -height;
    (void)model.inverse_kinematics(leg, p_BF, Vec3(nominal.x(), hip, knee), q_leg);
    result.segment<3>(first_joint(leg)) = q_leg;
  }
  return result.cwiseMax(robot.q_min).cwiseMin(robot.q_max);
}

LegPosture Footing::posture(const estimation::LiftDetector& lift) const {
  const double share = std::min(1.0, time_ / duration_);
  const JointVector way = to_ - from_;
  LegPosture result{.q = from_ + ease(share) * way, .qd = ease_slope(share) / duration_ * way};
  result.stands.resize(static_cast<int>(knees_.size()));
  for (const Leg leg : knees_.legs()) {
    result.stands[index(leg)] = state_ != State::folds && lift.bears(leg);
  }
  if (state_ == State::rises) {
    result.bears = std::max(borne_, ease(std::min(1.0, time_ / (scale_.time() * kLoadTime))));
    const double stiff = std::min(1.0, stood_for_ / (scale_.time() * kStiffenTime));
    result.softness = 1.0 - kStiffness * stiff;
  }
  return result;
}

Righting Footing::righting(const model::Dynamics& dynamics, const RobotState& state) const {
  if (state_ != State::rises || !is_rotation(state.q_WB) || !state.w_WB_B.allFinite()) return {};
  const Mat3 R_WB = state.R_WB();
  const double rate = scale_.rate() * kRighting;
  const Vec3 tilt_B = Vec3::UnitZ().cross(Vec3(R_WB.transpose().col(2)));
  const Vec3 acceleration_B = rate * rate * tilt_B - 2.0 * kRightingDamping * rate * state.w_WB_B;
  Vec3 moment = R_WB * limp_inertia(dynamics) * acceleration_B;
  moment.z() = 0.0;
  return {.q_WB = state.q_WB, .moment = moment};
}

}  // namespace surefoot::control
