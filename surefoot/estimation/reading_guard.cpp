#include "surefoot/estimation/reading_guard.hpp"

#include "surefoot/math/numbers.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace surefoot::estimation {
namespace {

constexpr double kLostFactor = 5.0;   // times patience, until any value is accepted
constexpr double kStillTime = 0.2;    // of all angles at once, in a live robot [s]
constexpr double kSurePeriods = 4.5;  // largest unquestioned step of the clock
constexpr double kOtherStep = 0.5;    // share of a step that confirms the other instrument's

JointVector limited(const JointVector& velocity, const JointVector& limit) {
  JointVector result = limit;
  for (Eigen::Index i = 0; i < limit.size(); ++i) {
    const double v = std::isfinite(velocity[i]) ? velocity[i] : 0.0;
    result[i] = std::clamp(v, -limit[i], limit[i]);
  }
  return result;
}

/// Reports samples that are good, but too late.
void report_delay(const SampleWatch& watch, GroupHealth& health) {
  if (watch.delayed_for() == 0.0 || health.fault != SampleFault::none) return;
  health = {.fault = SampleFault::late, .age = std::fmax(health.age, watch.delayed_for())};
}

/// False for NaN.
bool within(const Vec3& value, double range) { return (value.cwiseAbs().array() <= range).all(); }

/// NaN equals NaN.
bool are_same(const JointVector& a, const JointVector& b) {
  return (a.array() == b.array() || (a.array().isNaN() && b.array().isNaN())).all();
}

}  // namespace

ReadingGuard::ReadingGuard(const ReadingGuardOptions& options, const model::RobotDescription& robot,
                           double period)
    : options_(options),
      period_(period),
      velocity_limit_(robot.velocity_limit),
      torque_limit_(robot.torque_limit),
      encoder_watch_(period, options.patience, options.max_encoder_delay),
      torque_watch_(period, options.patience, options.max_torque_delay),
      imu_watch_(period, options.patience, options.max_imu_delay),
      angles_(robot.num_joints()),
      torques_(robot.num_joints()),
      given_q_(JointVector::Constant(robot.num_joints(), kNaN)) {
  repaired_.q = repaired_.torque = given_q_;
  measured_ = offered_ = repaired_;
}

void ReadingGuard::update(const SensorReading& reading, const JointVector& joint_velocity,
                          const SensorReading& given) noexcept {
  clock_is_right_ = accepts_clock(reading.time);
  if (!clock_is_right_) {
    miss(reading, given.q);
    return;
  }
  const double dt = std::isnan(time_) ? 0.0 : reading.time - time_;
  time_ = reading.time;
  missed_ = 0;
  given_q_ = given.q;
  repaired_ = measured_ = reading;
  encoder_watch_.update(time_, reading.encoder_time);
  torque_watch_.update(time_, reading.torque_time);
  imu_watch_.update(time_, reading.imu_time);
  // After a gap the past is unknown.
  lost_ = dt > options_.patience ? 0.0 : kLostFactor * options_.patience;
  take_joints(reading, joint_velocity, dt);
  take_imu(reading, given);
  describe(reading);
}

// A dead driver repeats its last reading. One wrong time must not discredit all later ones.
bool ReadingGuard::accepts_clock(double time) noexcept {
  if (!std::isfinite(time)) return false;
  if (std::isnan(time_)) return true;
  const double dt = time - time_, since_leap = time - leapt_to_;
  const double sure = kSurePeriods * period_;
  const double as_before = std::max(sure, 1.5 * (leapt_to_ - time_));  // not NaN
  const bool is_confirmed = since_leap > 0.0 && since_leap <= as_before;
  const bool is_right = dt > 0.0 && (dt <= sure || (is_confirmed && dt <= kLongestReadingGap));
  leapt_to_ = is_right ? kNaN : time;
  return is_right;
}

// Without a valid clock no angle counts as measured, until the last good ones are too old. Then
// angles that changed recently are used.
void ReadingGuard::miss(const SensorReading& reading, const JointVector& given_q) noexcept {
  const bool stays = are_same(given_q, given_q_);
  still_ = stays && missed_ > 0 ? still_ + 1 : 0;
  moves_ = !stays || (missed_ > 0 && moves_ && still_ * period_ < kStillTime);
  given_q_ = given_q;
  ++missed_;
  measured_ = repaired_;
  measured_.time = kNaN;
  if (moves_ && missed_ * period_ > options_.patience) {
    const JointVector unseen = encoder_age().cwiseMax(0.0).array() + missed_ * period_;
    measured_.q = angles_.plausible(reading.q, angle_limits(unseen));
  } else {
    measured_.q.setConstant(kNaN);
  }
  for (GroupHealth* group : {&health_.encoders, &health_.joint_torques, &health_.imu}) {
    const double silent = missed_ * period_;
    const bool is_older = !(group->age < silent);  // also one that never came
    *group = {.fault = SampleFault::silent, .age = is_older ? group->age : silent};
  }
  if (moves_) health_.encoders.fault = SampleFault::late;
}

bool ReadingGuard::imu_is_shaken() const {
  const double lately = time_ - options_.patience;
  return gyro_.values.is_shaken_since(lately) || accelerometer_.values.is_shaken_since(lately);
}

bool ReadingGuard::is_shaken() const {
  return imu_is_shaken() || angles_.all_are_shaken_since(time_ - options_.patience);
}

bool ReadingGuard::is_impact() const {
  const double lately = time_ - options_.patience;
  return gyro_.stepped >= lately && accelerometer_.stepped >= lately;
}

// An impact can reverse several joints at once.
GuardedValues<JointVector>::Limits ReadingGuard::angle_limits(const JointVector& unseen) const {
  const double share = imu_is_shaken() ? kUnlimited : 1.0;
  const JointVector margin = JointVector::Constant(unseen.size(), options_.angle_margin);
  return {.range = JointVector::Constant(unseen.size(), options_.max_angle),
          .tolerance = 2.0 * period_ * velocity_limit_ + options_.velocity_margin * unseen + margin,
          .sure = share * (period_ * velocity_limit_ + margin),
          .group_step = share * options_.sure_angles,
          .max_group_step = is_loose_ || is_impact() ? kUnlimited : options_.max_angles};
}

void ReadingGuard::take_joints(const SensorReading& reading, const JointVector& joint_velocity,
                               double dt) {
  angles_.move(dt * limited(joint_velocity, velocity_limit_));
  angles_.take(reading.q, encoder_watch_.fault(), encoder_watch_,
               angle_limits(encoder_age().cwiseMax(0.0)), lost_);
  torques_.take(reading.torque, torque_watch_.fault(), torque_watch_,
                {.range = options_.max_torque * torque_limit_,
                 .tolerance = options_.max_torque_step * torque_limit_,
                 .sure = options_.sure_torque_step * torque_limit_},
                lost_);
}

// The legs show a step of this size before the decision is due.
bool ReadingGuard::accepts_imu_step() {
  const ImuStep step = std::exchange(imu_step_, ImuStep::not_judged);
  const bool is_due = health_.imu.age + period_ >= options_.patience - kTimeRounding;
  return step == ImuStep::confirmed || step == ImuStep::no_witness ||
         (step == ImuStep::undecided && is_due);
}

// Both instruments sense an impact, or the legs confirm it.
void ReadingGuard::take_imu(const SensorReading& reading, const SensorReading& given) {
  const Vec3 turn = Vec3::Constant(options_.sure_gyro_step);
  const Vec3 force = Vec3::Constant(options_.sure_acceleration_step);
  if (imu_watch_.is_new()) {
    note_step(gyro_, reading.gyro, kOtherStep * turn, options_.max_gyro);
    note_step(accelerometer_, reading.accelerometer, kOtherStep * force, options_.max_acceleration);
  }
  const double lately = imu_watch_.sample_time() - options_.patience;
  const bool accepts_step = accepts_imu_step();
  const auto most = [&](double step) { return Vec3::Constant(accepts_step ? kUnlimited : step); };
  take(gyro_, reading.gyro, given.gyro,
       {.range = Vec3::Constant(options_.max_gyro),
        .tolerance = most(options_.max_gyro_step),
        .sure = turn,
        .sure_only = !accepts_step && !(accelerometer_.stepped >= lately)});
  take(accelerometer_, reading.accelerometer, given.accelerometer,
       {.range = Vec3::Constant(options_.max_acceleration),
        .tolerance = most(options_.max_acceleration_step),
        .sure = force,
        .sure_only = !accepts_step && !(gyro_.stepped >= lately)});
}

void ReadingGuard::note_step(Instrument& instrument, const Vec3& value, const Vec3& large,
                             double range) const {
  if (!within(value, range)) return;
  const double now = imu_watch_.sample_time();
  const double periods = std::max(1.0, (now - instrument.last_time) / period_);  // not NaN
  const Vec3 step = value - instrument.last;
  if ((step.cwiseAbs().array() > periods * large.array()).any()) instrument.stepped = now;
  instrument.last = value;
  instrument.last_time = now;
}

void ReadingGuard::take(Instrument& instrument, const Vec3& value, const Vec3& given,
                        const GuardedValues<Vec3>::Limits& limits) {
  if (imu_watch_.is_new()) {
    const bool is_same = given == instrument.given;
    instrument.repeats = is_same ? instrument.repeats + 1 : 0;
    if (!is_same) instrument.given_since = imu_watch_.sample_time();
    instrument.given = given;
  }
  SampleFault fault = imu_watch_.fault();
  if (fault == SampleFault::none && instrument.repeats >= options_.repeats) {
    fault = SampleFault::repeats;
    instrument.values.forget_since(instrument.given_since);
  }
  instrument.values.take(value, fault, imu_watch_, limits, lost_);
}

void ReadingGuard::describe(const SensorReading& reading) {
  repaired_.encoder_time = encoder_watch_.given_time();
  repaired_.torque_time = torque_watch_.given_time();
  repaired_.imu_time = imu_watch_.given_time();
  repaired_.q = angles_.repaired();
  repaired_.torque = torques_.repaired();
  repaired_.gyro = gyro_.values.repaired();
  repaired_.accelerometer = accelerometer_.values.repaired();
  offered_ = repaired_;
  if (within(reading.gyro, options_.max_gyro)) offered_.gyro = reading.gyro;
  if (within(reading.accelerometer, options_.max_acceleration))
    offered_.accelerometer = reading.accelerometer;
  measured_ = repaired_;
  measured_.q = angles_.measured();
  if (!encoder_watch_.is_punctual()) measured_.q.setConstant(kNaN);
  health_.encoders = angles_.health(reading.time);
  health_.joint_torques = torques_.health(reading.time);
  const GroupHealth gyro = gyro_.values.health(reading.time);
  health_.imu = accelerometer_.values.health(reading.time);
  if (gyro.fault != SampleFault::none) health_.imu.fault = gyro.fault;
  const bool both_came = std::isfinite(gyro.age) && std::isfinite(health_.imu.age);
  health_.imu.age = both_came ? std::max(health_.imu.age, gyro.age) : kNaN;
  health_.imu.joint = -1;
  report_delay(encoder_watch_, health_.encoders);
  report_delay(torque_watch_, health_.joint_torques);
  report_delay(imu_watch_, health_.imu);
}

JointVector ReadingGuard::encoder_age() const {
  return JointVector::Constant(angles_.seen().size(), time_) - angles_.seen();
}

}  // namespace surefoot::estimation
