#include "surefoot/estimation/contact_force_estimator.hpp"

#include "surefoot/base/fields.hpp"
#include "surefoot/model/leg_jacobian.hpp"
#include "surefoot/model/limb_dynamics.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace surefoot::estimation {
namespace {

constexpr double kBaseCutoffHz = 40.0;  // of the base's acceleration
constexpr double kMaxPeriods = 1e6;

int leg_rows(Leg leg) { return 6 + first_joint(leg); }

}  // namespace

ContactForceEstimator::ContactForceEstimator(const ContactForceOptions& options, double period,
                                             const Scale& scale, int num_joints, int num_legs)
    : options_(options),
      period_(period),
      force_observer_(2.0 * kPi * options.bandwidth_hz, period, num_joints),
      velocity_observer_(force_observer_),
      tare_(options.tare, 2.0 * kPi * options.bandwidth_hz, period, scale, num_legs),
      foot_sensors_(num_legs, FootSensorTrust(period, scale)) {}

// Whole periods, so that a rounded clock changes nothing; 1 if a time is NaN.
int ContactForceEstimator::periods_until(double time) const {
  const double periods = std::round((time - time_) / period_);
  return periods > 1.0 ? static_cast<int>(std::min(periods, kMaxPeriods)) : 1;
}

void ContactForceEstimator::Recent::add(const JointVector& value) {
  std::shift_right(values.begin(), values.end(), 1);
  values.front() = value;
}

const JointVector& ContactForceEstimator::Recent::ago(int ticks) const {
  return values[static_cast<std::size_t>(std::clamp(ticks, 0, static_cast<int>(kNumRecent) - 1))];
}

int ContactForceEstimator::ticks_in(double delay) const {
  const double ticks = std::round(delay / period_);
  return std::abs(ticks) < kNumRecent ? static_cast<int>(ticks) : 0;  // 0 if NaN, too
}

void ContactForceEstimator::set_delays(const JointDelays& delays) {
  const int angle_delay = ticks_in(delays.encoders), torque_delay = ticks_in(delays.torques);
  const int force_delay = std::max(angle_delay, torque_delay);
  velocity_observer_.go_back(angle_delay - angle_delay_);
  force_observer_.go_back(force_delay - force_delay_);
  torque_lag_ = torque_delay - angle_delay;
  angle_delay_ = angle_delay;
  force_delay_ = force_delay;
}

const JointVector& ContactForceEstimator::observe(const SensorReading& reading,
                                                  const JointDelays& delays) noexcept {
  const bool is_first = periods_ == 0 || !force_observer_.q().allFinite();
  begins_ = begins_ || is_first;
  periods_ = periods_until(reading.time);
  periods_of_base_ += periods_;
  time_ = std::isfinite(reading.time) ? reading.time : time_ + period_;
  set_delays(delays);
  if (is_first || !torques_.ago(0).allFinite()) {
    torques_.start(reading.torque);
  } else {
    torques_.add(reading.torque);
  }
  if (is_first) {
    angles_.start(reading.q);
    force_observer_.start(reading.q);
  } else {
    angles_.add(reading.q);
    force_observer_.update(angles_.ago(torque_lag_), periods_);
  }
  velocity_observer_.update(reading.q, periods_);
  return velocity_observer_.velocity();
}

void ContactForceEstimator::update(const model::Dynamics& dynamics, const PerLeg<bool>& stands,
                                   const Vec3& terrain_normal_W, const SensorReading& reading,
                                   RobotState& state) noexcept {
  update_base_acceleration(dynamics);
  if (dynamics.has_flat_feet()) {
    update_flat_feet(dynamics, stands, state);
    return;
  }
  const JointVector& torque = torques_.ago(-torque_lag_);
  // Torques say little of the light bodies of arms: these are expected to move on.
  JointVector free = JointVector::Zero(torque.size()), constrained = free;
  for (const Leg leg : foot_sensors_.legs()) {
    const Vec3 a = free_acceleration(dynamics, leg, torque);
    free.segment<3>(first_joint(leg)) = a;
    constrained.segment<3>(first_joint(leg)) =
        stands[index(leg)] ? stance_acceleration(dynamics, leg) : a;
  }
  force_observer_.expect(free);
  velocity_observer_.expect(constrained);
  if (begins_) force_observer_.balance();
  begins_ = false;
  const LegJointVector missing = missing_torque(dynamics);
  tare_.update(stands, missing, torque, force_observer_.velocity(),
               free + force_observer_.disturbance());
  const LegJointVector by_ground = missing - tare_.tare();
  for (const Leg leg : foot_sensors_.legs()) {
    const std::size_t k = index(leg);
    Vec3& force = state.foot_force[k];
    force = model::damped_inverse(model::leg_jacobian(dynamics.contact[k], leg), dynamics.scale)
                .transpose() *
            by_ground.segment<3>(first_joint(leg));
    if (!options_.use_foot_sensor) continue;
    const double by_joints = terrain_normal_W.dot(force);
    const double believed = foot_sensors_[k].force(reading.foot_force[k], by_joints);
    force += (believed - by_joints) * terrain_normal_W;
  }
}

/// As `update`, with six rows a foot and without tare and foot sensors.
void ContactForceEstimator::update_flat_feet(const model::Dynamics& dynamics,
                                             const PerLeg<bool>& stands, RobotState& state) {
  const JointVector& torque = torques_.ago(-torque_lag_);
  JointVector free = JointVector::Zero(torque.size()), constrained = free;
  for (const Leg leg : stands.legs()) {
    const model::LimbDynamics limb(dynamics, leg);
    const auto [first, count] = dynamics.leg_joints[index(leg)];
    free.segment(first, count) = limb.free_acceleration(torque, base_acceleration_);
    constrained.segment(first, count) = stands[index(leg)]
                                            ? limb.stance_acceleration(base_acceleration_)
                                            : limb.free_acceleration(torque, base_acceleration_);
  }
  force_observer_.expect(free);
  velocity_observer_.expect(constrained);
  if (begins_) force_observer_.balance();
  begins_ = false;
  for (const Leg leg : stands.legs())
    state.foot_force[index(leg)] =
        model::LimbDynamics(dynamics, leg).wrench(force_observer_.disturbance()).head<3>();
}

void ContactForceEstimator::update_base_acceleration(const model::Dynamics& dynamics) {
  const BaseVector velocity = dynamics.u.head<6>();
  const double cutoff = dynamics.scale.rate() * kBaseCutoffHz;
  const double dt = periods_of_base_ * period_;
  periods_of_base_ = 0.0;
  const double gain = begins_ ? 0.0 : 1.0 - std::exp(-2.0 * kPi * cutoff * dt);
  base_acceleration_ += gain * ((velocity - base_velocity_) / dt - base_acceleration_);
  base_velocity_ = velocity;
}

Vec3 ContactForceEstimator::free_acceleration(const model::Dynamics& dynamics, Leg leg,
                                              const JointVector& torque) const {
  const int first = leg_rows(leg);
  const Vec3 left = torque.segment<3>(first_joint(leg)) - dynamics.h.segment<3>(first) -
                    dynamics.M.block<3, 6>(first, 0) * base_acceleration_;
  return dynamics.M.block<3, 3>(first, first).llt().solve(left);
}

Vec3 ContactForceEstimator::stance_acceleration(const model::Dynamics& dynamics, Leg leg) const {
  const model::PointKinematics& contact = dynamics.contact[index(leg)];
  const Vec3 rest = contact.J.leftCols<6>() * base_acceleration_ + contact.Jdot_u;
  return -model::damped_inverse(model::leg_jacobian(contact, leg), dynamics.scale) * rest;
}

LegJointVector ContactForceEstimator::missing_torque(const model::Dynamics& dynamics) const {
  LegJointVector result(kJointsPerLeg * dynamics.num_legs());
  for (const Leg leg : dynamics.foot.legs()) {
    const int first = leg_rows(leg);
    result.segment<3>(first_joint(leg)) =
        dynamics.M.block<3, 3>(first, first) *
        force_observer_.disturbance().segment<3>(first_joint(leg));
  }
  return result;
}

Group fields(ContactForceOptions& o) {
  return {{"bandwidth_hz", &o.bandwidth_hz, kPositive, "Hz", "of the observers' poles, ω / 2π"},
          {"use_foot_sensor", &o.use_foot_sensor, "for normal forces, where it fits the joints"},
          {"tare", &o.tare.enabled, "whether legs in the air are weighed"}};
}

}  // namespace surefoot::estimation
