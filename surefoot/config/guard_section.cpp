#include "surefoot/config/guard_section.hpp"

namespace surefoot {
namespace {

void read_imu_check(Section& section, ImuCheckOptions& options) {
  const NumberRange span{
      .min = 0.0, .max = 1.0, .min_included = false, .words = "above 0 and at most 1 s"};
  section.number("window", options.window, span);
  section.number("position_margin", options.position_margin, kPositive);
  section.number("velocity_margin", options.velocity_margin, kPositive);
  section.number("turn_margin", options.turn_margin, kPositive);
  section.number("rate_margin", options.rate_margin, kPositive);
  section.number("doubt", options.doubt, kNotNegative);
  section.number("force", options.force, kNotNegative);
  section.number("settle", options.settle, {.min = 0.0, .max = 1.0, .words = "from 0 to 1 s"});
  section.number("max_acceleration", options.max_acceleration, kPositive);
  section.number("tumbling", options.tumbling, kPositive);
  section.number("shaking", options.shaking, kPositive);
}

void read_frozen_joints(Section& section, FrozenJointOptions& options) {
  section.number("motion", options.motion, kPositive);
  section.number("torque", options.torque, kPositive);
  section.number("duration", options.duration, kNotNegative);
}

void read_torque_check(Section& section, TorqueCheckOptions& options) {
  section.number("max_error", options.max_error, kPositive);
  section.number("duration", options.duration, kNotNegative);
  section.number("max_force", options.max_force, kPositive);
  section.number("max_moment", options.max_moment, kPositive);
  section.number("time_constant", options.time_constant, kTimeConstant);
}

void read_consistency(Section& section, SensorConsistencyOptions& options) {
  section.flag("enabled", options.enabled);
  section.section("imu", [&](Section& s) { read_imu_check(s, options.imu); });
  section.section("frozen", [&](Section& s) { read_frozen_joints(s, options.frozen); });
  section.section("torques", [&](Section& s) { read_torque_check(s, options.torques); });
}

}  // namespace

void read_guard(Section& section, ReadingGuardOptions& options,
                SensorConsistencyOptions& consistency) {
  section.number("patience", options.patience,
                 {.min = 0.0,
                  .max = ReadingGuardOptions::kLongestPatience,
                  .min_included = false,
                  .words = "a number above 0, at most 0.02 s"});
  section.number("max_encoder_delay", options.max_encoder_delay, kNotNegative);
  section.number("max_torque_delay", options.max_torque_delay, kNotNegative);
  section.number("max_imu_delay", options.max_imu_delay, kNotNegative);
  section.number("max_angle", options.max_angle, kPositive);
  section.number("angle_margin", options.angle_margin, kPositive);
  section.number("velocity_margin", options.velocity_margin, kNotNegative);
  section.number("sure_angles", options.sure_angles, kPositive);
  section.number("max_angles", options.max_angles, kPositive);
  section.number("max_torque", options.max_torque, kPositive);
  section.number("max_torque_step", options.max_torque_step, kPositive);
  section.number("sure_torque_step", options.sure_torque_step, kPositive);
  section.number("max_gyro", options.max_gyro, kPositive);
  section.number("max_gyro_step", options.max_gyro_step, kPositive);
  section.number("sure_gyro_step", options.sure_gyro_step, kPositive);
  section.number("max_acceleration", options.max_acceleration, kPositive);
  section.number("max_acceleration_step", options.max_acceleration_step, kPositive);
  section.number("sure_acceleration_step", options.sure_acceleration_step, kPositive);
  section.integer("repeats", options.repeats, 1);
  section.section("consistency", [&](Section& s) { read_consistency(s, consistency); });
}

}  // namespace surefoot
