#include "surefoot/estimation/reading_guard_options.hpp"

#include "surefoot/base/fields.hpp"
#include "surefoot/estimation/sensor_consistency_options.hpp"

namespace surefoot::estimation {
namespace {

constexpr NumberRange kPatienceRange{.min = 0.0,
                                     .max = ReadingGuardOptions::kLongestPatience,
                                     .min_included = false,
                                     .words = "a number above 0, at most 0.02 s"};
constexpr NumberRange kWindowRange{
    .min = 0.0, .max = 1.0, .min_included = false, .words = "above 0 and at most 1 s"};
constexpr NumberRange kSettle{.min = 0.0, .max = 1.0, .words = "from 0 to 1 s"};

Group fields(ImuCheckOptions& o) {
  return {
      {"window", &o.window, kWindowRange, "s", "longest span over which IMU and legs are compared"},
      {"position_margin", &o.position_margin, kPositive, "m",
       "of encoders, rolling, samples out of step"},
      {"velocity_margin", &o.velocity_margin, kPositive, "m/s",
       "of feet that give way, biases, wrong legs"},
      {"turn_margin", &o.turn_margin, kPositive, "rad", "of the turn over the span"},
      {"rate_margin", &o.rate_margin, kPositive, "rad/s", "of the turn, times the span"},
      {"doubt", &o.doubt, kNotNegative, "", "times the feet's disagreement is allowed, too"},
      {"force", &o.force, kNotNegative, "N", "a foot that carries less is not used"},
      {"settle", &o.settle, kSettle, "s", "nor one that does so for less"},
      {"max_acceleration", &o.max_acceleration, kPositive, "m/s²",
       "nor any while contacts accelerate it by more"},
      {"tumbling", &o.tumbling, kPositive, "rad/s", "nor any while it turns faster …"},
      {"shaking", &o.shaking, kPositive, "m/s²", "… and feels more or less than g by this"}};
}

Group fields(FrozenJointOptions& o) {
  return {{"motion", &o.motion, kPositive, "rad", "asked of a joint whose encoder stands still"},
          {"torque", &o.torque, kPositive, "N·m", "change of the command, its sensor stands still"},
          {"duration", &o.duration, kNotNegative, "s", "of either"}};
}

Group fields(TorqueCheckOptions& o) {
  return {
      {"max_error", &o.max_error, kPositive, "N·m", "of a torque against its command, one-sided"},
      {"duration", &o.duration, kNotNegative, "s",
       "of that error; drives at limits are off for less"},
      {"max_force", &o.max_force, kPositive, "N", "outer force that the torques claim"},
      {"max_moment", &o.max_moment, kPositive, "N·m", "outer moment that they claim"},
      {"time_constant", &o.time_constant, kTimeConstant, "s", "of both"}};
}

}  // namespace

Group fields(SensorConsistencyOptions& o) {
  return {{"enabled", &o.enabled, "whether sensors are held against each other"},
          {"imu", fields(o.imu), "when IMU and legs disagree about the base's motion"},
          {"frozen", fields(o.frozen), "joints whose sensor stands still though they move"},
          {"torques", fields(o.torques), "joint torques that are not those of the command"}};
}

Group fields(ReadingGuardOptions& o) {
  return {
      {"patience", &o.patience, kPatienceRange, "s", "oldest sample that is made up for",
       Sizing::none},
      {"max_encoder_delay", &o.max_encoder_delay, kNotNegative, "s", "samples may be so late",
       Sizing::none},
      {"max_torque_delay", &o.max_torque_delay, kNotNegative, "s", "samples may be so late",
       Sizing::none},
      {"max_imu_delay", &o.max_imu_delay, kNotNegative, "s", "samples may be so late",
       Sizing::none},
      {"max_angle", &o.max_angle, kPositive, "rad", "no joint turns further"},
      {"angle_margin", &o.angle_margin, kPositive, "rad",
       "from where the joint's velocity led, beside what its velocity limit allows"},
      {"velocity_margin", &o.velocity_margin, kNotNegative, "rad/s", "of a joint without samples"},
      {"sure_angles", &o.sure_angles, kPositive, "rad",
       "half of the joints so far off: with the next sample"},
      {"max_angles", &o.max_angles, kPositive, "rad",
       "half of them so far off: only of a robot that is hit"},
      {"max_torque", &o.max_torque, kPositive, "",
       "of the joint's limit; impacts load springs further"},
      {"max_torque_step", &o.max_torque_step, kPositive, "", "of the joint's limit, in a tick"},
      {"sure_torque_step", &o.sure_torque_step, kPositive, "",
       "of the limit; a larger one with the next sample"},
      {"max_gyro", &o.max_gyro, kPositive, "rad/s", "range of common gyroscopes, 2000 °/s",
       Sizing::none},
      {"max_gyro_step", &o.max_gyro_step, kPositive, "rad/s", "in a tick"},
      {"sure_gyro_step", &o.sure_gyro_step, kPositive, "rad/s",
       "a larger step is believed with the next sample and a step of the accelerometer"},
      {"max_acceleration", &o.max_acceleration, kPositive, "m/s²", "30 g"},
      {"max_acceleration_step", &o.max_acceleration_step, kPositive, "m/s²", "in a tick"},
      {"sure_acceleration_step", &o.sure_acceleration_step, kPositive, "m/s²",
       "a larger step is believed with the next sample and a step of the gyroscope"},
      {"repeats", &o.repeats, {.min = 1}, "", "of a sample, bit by bit: no measurement any more"}};
}

}  // namespace surefoot::estimation
