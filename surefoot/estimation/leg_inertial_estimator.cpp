#include "surefoot/estimation/leg_inertial_estimator.hpp"

#include "surefoot/base/checked_period.hpp"
#include "surefoot/base/fields.hpp"
#include "surefoot/math/rotation.hpp"
#include "surefoot/model/body_tree.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <string>

namespace surefoot::estimation {
namespace {

constexpr double kLongAgo = 1e3;              // [s]
constexpr double kRestartMemory = 0.1;        // of the readings used by a restart [s]
constexpr double kLevelMemory = 1.0;          // of the tilt without feet [s]
constexpr double kAccelerationMemory = 0.01;  // of the predicted acceleration [s]

Vec3 angles(const JointVector& q, Leg leg) { return q.segment<kJointsPerLeg>(first_joint(leg)); }

}  // namespace

LegInertialEstimator::LegInertialEstimator(const model::RobotDescription& robot,
                                           const LegInertialOptions& options, double period)
    : options_(options),
      period_(checked_period(period)),
      num_joints_(robot.num_joints()),
      errors_(no_errors(robot.num_legs())),
      filter_(options.filter, robot.num_legs()),
      feet_(robot.num_legs(), Foot{}),
      standing_start_(period, robot.num_leg_joints(), robot.scale),
      tree_(model::make_body_tree(robot, model::read_urdf(robot))) {
  described_.resize(static_cast<int>(tree_.legs.size()));
  for (const Leg leg : feet_.legs()) {
    const std::size_t k = index(leg);
    feet_[k].radius = robot.legs[k].foot_radius;
    if (robot.can_walk()) {
      described_[k] = tree_.legs[k].chain;
    } else {
      limbs_.push_back(model::limb_chain(tree_, leg, robot.leg_joints(leg)));
    }
  }
  chains_ = described_;
  state_.size_legs(robot.num_legs());
}

// Further joints give way a little.
void LegInertialEstimator::take_further_joints(const JointVector& q) noexcept {
  for (const Leg leg : described_.legs()) {
    const std::size_t k = index(leg);
    if (tree_.legs[k].bodies.size() == kJointsPerLeg) continue;
    described_[k] = model::leg_chain(tree_, leg, q);
    chains_[k] = described_[k].lengthened(errors_.thigh[k], errors_.shank[k]);
  }
}

const RobotState& LegInertialEstimator::update(const SensorReading& reading,
                                               const TickContext& context) noexcept {
  if (reading.q.size() != num_joints_) {  // of another robot
    state_.q = state_.qd = state_.torque = JointVector::Constant(num_joints_, kNaN);
    return state_;
  }
  if (reading.q.allFinite()) take_further_joints(reading.q);
  const bool is_complete =
      reading.q.allFinite() && reading.gyro.allFinite() && reading.accelerometer.allFinite();
  const bool hangs = context.off_its_feet && is_complete;
  if (!started_ && !hangs && !stands(reading, context.joint_velocity)) {
    write_joints(reading, context);
    return state_;
  }
  const Vec3 p_before = filter_.p_WB();
  const double dt = period_ * std::max(1.0, std::round((reading.time - state_.time) / period_));
  if (hangs) {
    take_over(context.kinematics, reading.q);
    hang(reading, dt);
  } else if (!started_) {
    start(reading, standing_start_.state(), 0.0);
    gyro_before_ = reading.gyro;
    stand_at({0.0, 0.0, height_over_feet()});
  } else if (context.restarts && is_complete) {
    start(reading, state_at_restart(), yaw(filter_.R_WB()));
    stand_at(p_before);
  } else {
    take_over(context.kinematics, reading.q);
    advance(reading, dt, is_complete);
    add_turn_uncertainty();
    has_stood_ = true;
    for (const Leg leg : feet_.legs()) update_foot(leg, context.contacts[index(leg)], dt);
  }
  hung_ = hangs;
  write_joints(reading, context);
  write_base(reading, context.kinematics);
  if (options_.predict) predict(context);
  return state_;
}

void LegInertialEstimator::restart() noexcept {
  started_ = hung_ = has_stood_ = false;
  standing_start_.restart();
  chains_ = described_;
  const auto num_legs = static_cast<int>(feet_.size());
  errors_ = no_errors(num_legs);
  state_ = {};
  state_.size_legs(num_legs);
}

// Uses the lowest points of the spheres, where the shanks roll on the ground.
bool LegInertialEstimator::stands(const SensorReading& reading,
                                  const JointVector& joint_velocity) noexcept {
  PerLeg<Vec3> p_BC, v_BC;
  for (PerLeg<Vec3>* vectors : {&p_BC, &v_BC}) vectors->resize(static_cast<int>(feet_.size()));
  for (const Leg leg : feet_.legs()) {
    if (!limbs_.empty()) {
      const model::LimbChain& limb = limbs_[index(leg)];
      const model::LimbChain::Pose pose = limb.foot_in_base(reading.q);
      p_BC[index(leg)] = pose.p;
      v_BC[index(leg)] = pose.J * joint_velocity.segment(limb.joints.first, limb.joints.count);
      continue;
    }
    const Vec3 q = angles(reading.q, leg);
    model::LegChain chain = chains_[index(leg)];
    chain.foot -= chain.shank_in_base(q).transpose() * (feet_[index(leg)].radius * Vec3::UnitZ());
    Mat3 J;
    p_BC[index(leg)] = chain.foot_in_base(q, &J);
    v_BC[index(leg)] = J * angles(joint_velocity, leg);
  }
  return standing_start_.stands(reading, joint_velocity, p_BC, v_BC);
}

// Its velocity is unknown, so its position stays. Its tilt follows the gyroscope, and the
// accelerometer slowly: it is carried about and set down.
void LegInertialEstimator::hang(const SensorReading& reading, double dt) {
  if (!started_) {
    start(reading, {.specific_force = reading.accelerometer}, 0.0);
    stand_at({0.0, 0.0, height_over_feet()});
  }
  Vec3 p_WB = filter_.p_WB();
  const double ground = p_WB.z() - height_over_feet();
  advance(reading, dt, true);
  Vec3 level = kGravity * filter_.R_WB().row(2);
  level += std::min(1.0, dt / kLevelMemory) * (reading.accelerometer - level);
  filter_.start(level, filter_.gyro_bias(), yaw(filter_.R_WB()));
  update_kinematics(reading);
  p_WB.z() = ground + height_over_feet();
  stand_at(p_WB);
}

// A robot that has just stood up still sways: its turning is no bias, and its acceleration no tilt.
StandingStart::State LegInertialEstimator::state_at_restart() const {
  StandingStart::State result{.gyro_bias = mean_gyro_, .specific_force = mean_force_};
  if (!hung_) return result;
  result.specific_force = kGravity * filter_.R_WB().row(2);
  if (has_stood_) result.gyro_bias = filter_.gyro_bias();
  return result;
}

void LegInertialEstimator::start(const SensorReading& reading, const StandingStart::State& standing,
                                 double heading) {
  started_ = true;
  gyro_before_ = mean_gyro_ = standing.gyro_bias;
  mean_force_ = recent_force_ = standing.specific_force;
  filter_.start(standing.specific_force, standing.gyro_bias, heading, standing.v_WB_B,
                standing.doubt);
  update_kinematics(reading);
}

double LegInertialEstimator::height_over_feet() const {
  const auto count = static_cast<double>(feet_.size());
  const double first = feet_[0].radius;  // with equal feet the mean is it to the bit
  double lowest = 0.0, larger = 0.0;
  for (const Foot& foot : feet_) {
    lowest += (filter_.R_WB() * foot.p_BF).z() / count;
    larger += (foot.radius - first) / count;
  }
  return first + larger - lowest;
}

void LegInertialEstimator::stand_at(const Vec3& p_WB) {
  filter_.place(p_WB);
  for (const Leg leg : feet_.legs()) {
    Foot& foot = feet_[index(leg)];
    foot.stands_for = kLongAgo;
    filter_.plant(leg, foot.p_BF, foot.J);
  }
  reset_distance();
}

void LegInertialEstimator::reset_distance() {
  p_WB_planted_ = filter_.p_WB();
  farthest_ = 0.0;
}

// Feet of legs with errors seem to turn as the base passes over them. The effect depends on the
// base's position: it cancels on the way back.
void LegInertialEstimator::add_turn_uncertainty() {
  const double distance = (filter_.p_WB() - p_WB_planted_).head<2>().norm();
  if (!(distance > farthest_)) return;
  filter_.turn_feet(options_.stance_turn * std::sqrt(distance * distance - farthest_ * farthest_));
  farthest_ = distance;
}

void LegInertialEstimator::advance(const SensorReading& reading, double dt, bool is_finite) {
  R_WB_before_ = filter_.R_WB();
  filter_.propagate(0.5 * (gyro_before_ + reading.gyro), reading.accelerometer, dt);
  gyro_before_ = reading.gyro;
  if (is_finite) {
    const double share = std::min(1.0, dt / kRestartMemory);
    mean_gyro_ += share * (reading.gyro - mean_gyro_);
    mean_force_ += share * (reading.accelerometer - mean_force_);
    recent_force_ +=
        std::min(1.0, dt / kAccelerationMemory) * (reading.accelerometer - recent_force_);
  }
  update_kinematics(reading);
}

// Corrected leg lengths or IMU mounting must not move the robot: its feet shift instead.
void LegInertialEstimator::take_over(const KinematicErrors& errors, const JointVector& q) {
  for (Foot& foot : feet_) foot.shift.setZero();
  if (errors == errors_) return;
  JointVector q_before = q;
  q_before.head(errors.zero.size()) =
      q_before.head(errors.zero.size()) + errors.zero - errors_.zero;
  const Mat3 R_before = filter_.R_WB();
  const Quat turn = exp_rotation(errors.imu) * exp_rotation(errors_.imu).conjugate();
  filter_.turn_imu(turn.toRotationMatrix());
  gyro_before_ = turn * gyro_before_;
  mean_gyro_ = turn * mean_gyro_;
  mean_force_ = turn * mean_force_;
  recent_force_ = turn * recent_force_;
  errors_ = errors;
  for (const Leg leg : feet_.legs()) {
    const std::size_t k = index(leg);
    const Vec3 before = chains_[k].foot_in_base(angles(q_before, leg));
    chains_[k] = described_[k].lengthened(errors.thigh[k], errors.shank[k]);
    const Vec3 now = chains_[k].foot_in_base(angles(q, leg));
    feet_[k].shift = filter_.R_WB() * now - R_before * before;
  }
}

void LegInertialEstimator::update_kinematics(const SensorReading& reading) {
  for (const Leg leg : feet_.legs()) {
    Foot& foot = feet_[index(leg)];
    const Mat3 R_WK_before = R_WB_before_ * foot.R_BK;
    place(leg, reading.q, foot);
    const Mat3 R_WK = filter_.R_WB() * foot.R_BK;
    const Vec3 turn = log_rotation(Quat(Mat3(R_WK * R_WK_before.transpose())));
    foot.roll = turn.cross(foot.radius * Vec3::UnitZ());
  }
}

void LegInertialEstimator::place(Leg leg, const JointVector& q, Foot& foot) const {
  if (limbs_.empty()) {
    const model::LegChain& chain = chains_[index(leg)];
    const Vec3 q_leg = angles(q, leg);
    foot.p_BF = chain.foot_in_base(q_leg, &foot.J);
    foot.R_BK = chain.shank_in_base(q_leg);
    return;
  }
  constexpr double kLeast = 1e-6;  // of J Jᵀ, for legs that are straight [m²]
  const model::LimbChain::Pose pose = limbs_[index(leg)].foot_in_base(q);
  const Mat3 squared = pose.J * pose.J.transpose() + kLeast * Mat3::Identity();
  foot.p_BF = pose.p;
  foot.J = squared.llt().matrixL();
  foot.R_BK = pose.R;
}

void LegInertialEstimator::update_foot(Leg leg, const FootContact& contact, double dt) {
  Foot& foot = feet_[index(leg)];
  if (!contact.carries) {
    if (filter_.stands(leg)) filter_.release(leg);
    return;
  }
  if (!filter_.stands(leg)) {
    foot.stands_for = 0.0;
    filter_.plant(leg, foot.p_BF, foot.J);
    reset_distance();
    return;
  }
  foot.stands_for += dt;
  filter_.move(leg, foot.roll + foot.shift, walk(foot, contact) * std::sqrt(dt));
  filter_.correct(leg, foot.p_BF, foot.J);
}

double LegInertialEstimator::walk(const Foot& foot, const FootContact& contact) const {
  const bool is_felt = std::isfinite(contact.normal_force);  // false after a refused tick
  if (contact.slips || !is_felt) return options_.loose_foot_walk;
  const double trust = std::min(1.0, foot.stands_for / options_.trust_time) *
                       std::clamp(contact.normal_force / options_.trust_force, 0.0, 1.0);
  return options_.foot_walk + options_.loose_foot_walk * (1.0 - trust) * (1.0 - trust);
}

void LegInertialEstimator::write_joints(const SensorReading& reading, const TickContext& context) {
  state_.time = reading.time;
  state_.q = reading.q;
  state_.qd = context.joint_velocity;
  state_.torque = reading.torque;
}

void LegInertialEstimator::write_base(const SensorReading& reading, const KinematicErrors& errors) {
  state_.p_WB = filter_.p_WB();
  state_.q_WB = Quat(filter_.R_WB());
  state_.v_WB = filter_.v_WB();
  state_.w_WB_B = reading.gyro - filter_.gyro_bias();
  // By the filter's error ξ: R̂ᵀ v̂ = Rᵀ v + R̂ᵀ ξ_v, and R̂ = exp(θ) R. The filter knows the IMU's
  // orientation, and B is as far off it as the mounting. The heading counts from the start, so its
  // variance is a little too large.
  using Filter = InvariantFilter;
  const Mat3 R_BW = filter_.R_WB().transpose();
  const auto& P = filter_.covariance();
  state_.velocity_covariance.noalias() =
      R_BW * P.block<3, 3>(Filter::kVelocity, Filter::kVelocity) * filter_.R_WB();
  state_.orientation_covariance = P.block<3, 3>(Filter::kTheta, Filter::kTheta);
  state_.orientation_covariance.noalias() += R_BW.transpose() * errors.imu_covariance * R_BW;
}

void LegInertialEstimator::predict(const TickContext& context) {
  const Vec3 a_WB =
      filter_.R_WB() * (recent_force_ - filter_.accelerometer_bias()) - kGravity * Vec3::UnitZ();
  state_.q += context.joint_lag * state_.qd;
  state_.p_WB += context.imu_lag * state_.v_WB;
  state_.v_WB += context.imu_lag * a_WB;
  state_.q_WB = (state_.q_WB * exp_rotation(context.imu_lag * state_.w_WB_B)).normalized();
}

Group fields(LegInertialOptions& o) {
  InvariantFilterOptions& filter = o.filter;
  return {
      {"gyro_noise", &filter.gyro_noise, kPositive, "rad/s/√Hz", "standard deviation",
       Sizing::none},
      {"accelerometer_noise", &filter.accelerometer_noise, kPositive, "m/s²/√Hz", "deviation",
       Sizing::none},
      {"gyro_bias_walk", &filter.gyro_bias_walk, kNotNegative, "rad/s²/√Hz", "of the bias",
       Sizing::none},
      {"accelerometer_bias_walk", &filter.accelerometer_bias_walk, kNotNegative, "m/s³/√Hz",
       "of the bias", Sizing::none},
      {"encoder_noise", &filter.encoder_noise, kPositive, "rad", "standard deviation"},
      {"foot_position_noise", &filter.foot_position_noise, kPositive, "m",
       "of the leg's kinematics, each axis: wrong joint zeros and lengths, IMU out of step"},
      {"gate", &filter.gate, kPositive, "", "squared Mahalanobis distance of outliers: 99.9 %"},
      {"foot_walk", &o.foot_walk, kPositive, "m/√s", "of a foot that stands firmly"},
      {"loose_foot_walk", &o.loose_foot_walk, kPositive, "m/√s", "of one that slides or lifts"},
      {"stance_turn", &o.stance_turn, kNotNegative, "rad/m",
       "apparent turn of the standing feet about the vertical between two footholds"},
      {"trust_time", &o.trust_time, kPositive, "s", "after a touchdown until a foot counts fully"},
      {"trust_force", &o.trust_force, kPositive, "N", "normal force from which on it does"},
      {"predict", &o.predict, "the state is of now, or else of when the samples were taken"},
      {"start",
       Group{{"tilt", &filter.initial_tilt, kPositive, "rad", ""},
             {"velocity", &filter.initial_velocity, kPositive, "m/s", ""},
             {"gyro_bias", &filter.initial_gyro_bias, kPositive, "rad/s", "", Sizing::none},
             {"accelerometer_bias", &filter.initial_accelerometer_bias, kPositive, "m/s²", ""}},
       "standard deviations at the start"}};
}

}  // namespace surefoot::estimation
