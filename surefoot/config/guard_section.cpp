#include "surefoot/config/guard_section.hpp"

namespace surefoot {

void read_guard(Section& section, ReadingGuardOptions& options) {
  section.number("patience", options.patience, kPositive);
  section.number("max_angle", options.max_angle, kPositive);
  section.number("angle_margin", options.angle_margin, kPositive);
  section.number("velocity_margin", options.velocity_margin, kNotNegative);
  section.number("max_torque", options.max_torque, kPositive);
  section.number("max_torque_step", options.max_torque_step, kPositive);
  section.number("max_gyro", options.max_gyro, kPositive);
  section.number("max_gyro_step", options.max_gyro_step, kPositive);
  section.number("max_acceleration", options.max_acceleration, kPositive);
  section.number("max_acceleration_step", options.max_acceleration_step, kPositive);
  section.integer("repeats", options.repeats, 1);
}

}  // namespace surefoot
