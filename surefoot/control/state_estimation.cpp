#include "surefoot/control/state_estimation.hpp"

#include "surefoot/control/lost_sensor.hpp"
#include "surefoot/control/standing_torque.hpp"
#include "surefoot/math/rotation.hpp"

#include <cmath>
#include <string_view>

namespace surefoot::control {
namespace {

// Beyond any robot's values; a single larger number would stay in the filters for long.
constexpr double kMaxDistance = 1e6;  // [m]
constexpr double kMaxSpeed = 1e3;     // [m/s] and [rad/s]
constexpr double kMaxAngle = 1e3;     // [rad]
constexpr double kMaxTorque = 1e4;    // [N·m]

constexpr double kMaxGap = 1.0;  // between two states, as the plan uses their time [s]

/// What can be no state of a robot, NaN too; empty if all can be.
std::string_view what_is_wrong(const RobotState& state) {
  const auto within = [](const auto& v, double limit) { return (v.array().abs() <= limit).all(); };
  if (!std::isfinite(state.time)) return "time";
  if (!within(state.p_WB, kMaxDistance)) return "p_WB";
  if (!is_rotation(state.q_WB)) return "q_WB";
  if (!within(state.v_WB, kMaxSpeed)) return "v_WB";
  if (!within(state.w_WB_B, kMaxSpeed)) return "w_WB_B";
  if (!within(state.q, kMaxAngle)) return "q";
  if (!within(state.qd, kMaxSpeed)) return "qd";
  return within(state.torque, kMaxTorque) ? "" : "torque";
}

/// An estimator that waits for a robot that stands says nothing of the base.
bool is_unknown(const RobotState& state) {
  return std::isfinite(state.time) && state.p_WB.array().isNaN().all() &&
         state.q_WB.coeffs().array().isNaN().all() && state.v_WB.array().isNaN().all() &&
         state.w_WB_B.array().isNaN().all();
}

/// An estimator that got NaN is not to blame for NaN.
bool has_numbers(const SensorReading& reading) {
  return reading.q.allFinite() && reading.torque.allFinite() && reading.gyro.allFinite() &&
         reading.accelerometer.allFinite();
}

bool has_size(const RobotState& state, Eigen::Index num_joints) {
  return state.q.size() == num_joints && state.qd.size() == num_joints &&
         state.torque.size() == num_joints;
}

TickContext context(const estimation::ReadingGuard& seen, const LastTick& last,
                    const RobotMode& mode, const JointVector& joint_velocity) {
  TickContext result{.joint_velocity = joint_velocity,
                     .joint_lag = seen.joint_lag(),
                     .imu_lag = seen.imu_lag(),
                     .kinematics = last.kinematics,
                     .restarts = last.restarts,
                     .off_its_feet = !mode.stands};
  result.contacts.resize(static_cast<int>(last.plan.feet.size()));
  for (const Leg leg : result.contacts.legs()) {
    const std::size_t k = index(leg);
    result.contacts[k] = {.carries = last.plan.contact(leg),
                          .normal_force = last.terrain_normal_W.dot(last.foot_force[k]),
                          .slips = last.slips[k]};
  }
  return result;
}

}  // namespace

StateEstimation::StateEstimation(const ControllerOptions& options,
                                 estimation::StateEstimator& estimator, model::RobotModel& model)
    : estimator_(&estimator),
      model_(&model),
      bridge_time_(options.safety.bridge_time),
      rest_check_(options.period, model.description().scale, model.description().num_legs()),
      contact_force_(options.contact_force, options.period, model.description().scale,
                     model.description().num_joints(), model.description().num_legs()),
      slip_(options.slip, options.period),
      external_force_(options.external_force),
      consistency_(options.consistency, options.period,
                   {.min = model.description().q_min, .max = model.description().q_max},
                   model.description().num_legs(), model.description().scale),
      lift_(options.period, model.description().scale),
      joint_velocity_(JointVector::Zero(model.description().num_joints())),
      kinematics_before_(no_errors(model.description().num_legs())) {
  state_.size_legs(model.description().num_legs());
  state_.q = state_.qd = state_.torque =
      JointVector::Constant(model.description().num_joints(), kNaN);
}

bool StateEstimation::has_begun() const { return std::isfinite(time_); }

bool StateEstimation::estimate_motion(const estimation::ReadingGuard& seen, const LastTick& last,
                                      const RobotMode& mode, SensorHealth& health) noexcept {
  imu_step_.reset();
  fault_.clear();
  observe_joints(seen);
  if (!seen.clock_is_right()) {
    state_.time = kNaN;
    state_.q = seen.measured().q;  // for the safe commands
    state_.qd = joint_velocity_;
    return false;
  }
  if (!ask_estimator(seen, last, mode)) return false;
  const bool is_at_rest =
      model_->description().can_walk() && mode.stands && !mode.has_begun && !mode.has_stopped;
  const bool fits = !is_at_rest || fits_at_rest(seen, health);
  forget_lost_joints(seen, health);
  const std::string_view wrong = what_is_wrong(state_);
  const bool plausible = wrong.empty() && !(std::abs(state_.time - time_) > kMaxGap);
  if (plausible) time_ = state_.time;
  if (!wrong.empty() && !is_unknown(state_) && are_all_there(health, bridge_time_) &&
      has_numbers(seen.repaired())) {
    fault_.set("the state estimator gave NaN, infinity or an impossible value in ", wrong);
    take_joints_alone(seen);
  }
  return plausible && fits && !mode.has_stopped &&
         lost_sensor(health, bridge_time_) == StopCause::none;
}

/// False after a fault: the state is then that of the joints alone.
bool StateEstimation::ask_estimator(const estimation::ReadingGuard& seen, const LastTick& last,
                                    const RobotMode& mode) noexcept {
  const RobotState* state = nullptr;
  const auto update = [&] {
    state = &estimator_->update(seen.repaired(), context(seen, last, mode, joint_velocity_));
  };
  if (runs(update, fault_, "the state estimator") && !has_size(*state, joint_velocity_.size()))
    fault_.set("the state estimator gave q, qd or torque that don't have the robot's joints");
  if (!fault_.is_set()) {
    state_ = *state;
    state_.size_legs(model_->description().num_legs());
    return true;
  }
  take_joints_alone(seen);
  return false;
}

void StateEstimation::take_joints_alone(const estimation::ReadingGuard& seen) noexcept {
  state_.time = seen.repaired().time;
  state_.q = seen.repaired().q;
  state_.qd = joint_velocity_;
  state_.q_WB.coeffs().setConstant(kNaN);
}

void StateEstimation::observe_joints(const estimation::ReadingGuard& seen) noexcept {
  joint_velocity_ = contact_force_.observe(
      seen.measured(), {.encoders = seen.encoder_delay(), .torques = seen.torque_delay()});
}

// Otherwise an IMU that is upside down or has another unit would cause a tilt stop, or no start.
bool StateEstimation::fits_at_rest(const estimation::ReadingGuard& seen,
                                   SensorHealth& health) noexcept {
  const SensorReading& reading = seen.repaired();
  const Vec3 force = borne_force(*model_, reading.q, reading.torque);
  rest_check_.update(reading, joint_velocity_, force, model_->dynamics().mass);
  if (!(rest_check_.wrong_for() > 0.0)) return true;
  GroupHealth& wrong = rest_check_.torques_pull() ? health.joint_torques : health.imu;
  if (wrong.fault == SampleFault::none)
    wrong = {.fault = SampleFault::contradicts, .age = rest_check_.wrong_for()};
  return false;
}

// Replaced angles are valid for a short time only.
void StateEstimation::forget_lost_joints(const estimation::ReadingGuard& seen,
                                         const SensorHealth& health) noexcept {
  if (lost_sensor(health, bridge_time_) != StopCause::encoders) return;
  const JointVector age = seen.encoder_age();
  for (Eigen::Index i = 0; i < age.size(); ++i) {
    if (!is_lost(age[i], bridge_time_)) continue;
    state_.q[i] = kNaN;
    state_.qd[i] = kNaN;
  }
}

void StateEstimation::estimate_forces(const estimation::ReadingGuard& seen,
                                      const model::Dynamics& dynamics, const LastTick& last,
                                      const RobotMode& mode, SensorHealth& health) noexcept {
  const PerLeg<bool> stands = last.plan.standing();
  contact_force_.update(dynamics, stands, last.terrain_normal_W, seen.repaired(), state_);
  if (dynamics.has_flat_feet()) return;  // what follows knows only legs of three joints
  lift_.update(kGravity * dynamics.mass, state_.foot_force, seen.repaired().accelerometer);
  if (!mode.stands) {
    imu_step_ = estimation::ImuStep::no_witness;
    return;
  }
  slip_.update(dynamics, stands, last.terrain_normal_W, state_);
  external_force_.update(dynamics, stands, state_);
  compare_sensors(seen, dynamics, last, health);
}

// A changed calibration is no motion of the legs, and feet without load give no reference.
void StateEstimation::compare_sensors(const estimation::ReadingGuard& seen,
                                      const model::Dynamics& dynamics, const LastTick& last,
                                      SensorHealth& health) noexcept {
  if (last.kinematics != kinematics_before_) consistency_.legs_have_changed();
  kinematics_before_ = last.kinematics;
  if (lift_.seems_lifted()) {
    consistency_.forget();
    return;
  }
  const PerLeg<bool> stands = last.plan.standing();
  PerLeg<Vec3> v_WF(static_cast<int>(stands.size()), Vec3::Zero());
  for (std::size_t k = 0; k < v_WF.size(); ++k) v_WF[k] = last.plan.feet[k].v_WF;
  consistency_.update(seen.repaired(), seen.offered(),
                      {.state = state_,
                       .dynamics = dynamics,
                       .stands = stands,
                       .v_WF = v_WF,
                       .normal_W = last.terrain_normal_W,
                       .command = last.torque},
                      health);
  imu_step_ = consistency_.imu_step();
}

void StateEstimation::restart_standing(const StateEstimation& at_start) noexcept {
  contact_force_ = at_start.contact_force_;
  slip_ = at_start.slip_;
  external_force_ = at_start.external_force_;
  rest_check_ = at_start.rest_check_;
}

}  // namespace surefoot::control
