#include "surefoot/config/estimator_section.hpp"

namespace surefoot {
namespace {

void read_start(Section& section, InvariantFilterOptions& filter) {
  section.number("tilt", filter.initial_tilt, kPositive);
  section.number("velocity", filter.initial_velocity, kPositive);
  section.number("gyro_bias", filter.initial_gyro_bias, kPositive);
  section.number("accelerometer_bias", filter.initial_accelerometer_bias, kPositive);
}

}  // namespace

void read_estimator(Section& section, LegInertialOptions& options) {
  section.number("gyro_noise", options.filter.gyro_noise, kPositive);
  section.number("accelerometer_noise", options.filter.accelerometer_noise, kPositive);
  section.number("gyro_bias_walk", options.filter.gyro_bias_walk, kNotNegative);
  section.number("accelerometer_bias_walk", options.filter.accelerometer_bias_walk, kNotNegative);
  section.number("encoder_noise", options.filter.encoder_noise, kPositive);
  section.number("foot_position_noise", options.filter.foot_position_noise, kPositive);
  section.number("gate", options.filter.gate, kPositive);
  section.number("foot_walk", options.foot_walk, kPositive);
  section.number("loose_foot_walk", options.loose_foot_walk, kPositive);
  section.number("stance_turn", options.stance_turn, kNotNegative);
  section.number("trust_time", options.trust_time, kPositive);
  section.number("trust_force", options.trust_force, kPositive);
  section.flag("predict", options.predict);
  section.section("start", [&](Section& s) { read_start(s, options.filter); });
}

}  // namespace surefoot
