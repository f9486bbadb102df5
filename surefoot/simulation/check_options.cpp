#include "surefoot/simulation/check_options.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/simulation/text.hpp"

#include <cmath>

namespace surefoot::simulation {

namespace {

// Larger grids take minutes to compile and gigabytes of memory.
constexpr int kMaxGridPoints = 4'000'000;
constexpr double kMaxRandomBoxes = 20'000.0;

void require(bool valid, const std::string& name, double given, const std::string& expected) {
  if (!valid) throw Error(text(name, " is ", given, "; it must be ", expected));
}

void require_finite(const std::string& name, double value) {
  require(std::isfinite(value), name, value, "a finite number");
}

template <typename Vector>
void require_all_finite(const std::string& name, const Vector& value) {
  for (Eigen::Index i = 0; i < value.size(); ++i) require_finite(text(name, "[", i, "]"), value[i]);
}

void require_positive(const std::string& name, double value) {
  require(std::isfinite(value) && value > 0.0, name, value, "a finite number above 0");
}

void require_not_negative(const std::string& name, double value) {
  require(std::isfinite(value) && value >= 0.0, name, value, "0 or a finite number above");
}

void require_delay(const std::string& name, int ticks) {
  require(ticks >= 0 && ticks <= kMaxDelayTicks, name, ticks,
          text("between 0 and ", kMaxDelayTicks));
}

void check(const std::string& name, const TerrainBox& box) {
  require_all_finite(name + ".position", box.position);
  for (Eigen::Index i = 0; i < 3; ++i) require_positive(text(name, ".size[", i, "]"), box.size[i]);
  require_all_finite(name + ".rpy", box.rpy);
  require_finite(name + ".friction", box.friction);
}

void check(const std::string& name, const TerrainLevel& plane) {
  require_all_finite(name + ".position", plane.position);
  require_all_finite(name + ".rpy", plane.rpy);
  require_finite(name + ".friction", plane.friction);
}

void check_grid(const std::string& name, const TerrainHeightField& field) {
  const bool automatic = field.heights.empty() && field.columns == 0 && field.rows == 0;
  if (automatic) return;
  require(field.columns >= 2, name + ".columns", field.columns, "at least 2");
  require(field.rows >= 2, name + ".rows", field.rows, "at least 2");
  require(field.columns <= kMaxGridPoints / field.rows, name + ".columns", field.columns,
          text("at most ", kMaxGridPoints, " points with rows"));
  const std::size_t points =
      static_cast<std::size_t>(field.columns) * static_cast<std::size_t>(field.rows);
  if (!field.heights.empty() && field.heights.size() != points) {
    throw Error(text(name, ".heights has ", field.heights.size(), " numbers; rows × columns is ",
                     field.rows, " × ", field.columns, " = ", points));
  }
}

void check(const std::string& name, const TerrainHeightField& field) {
  require_all_finite(name + ".position", field.position);
  require_positive(name + ".size_x", field.size_x);
  require_positive(name + ".size_y", field.size_y);
  require_not_negative(name + ".amplitude", field.amplitude);
  require_positive(name + ".wavelength", field.wavelength);
  require_finite(name + ".friction", field.friction);
  check_grid(name, field);
  for (std::size_t i = 0; i < field.heights.size(); ++i) {
    require_finite(text(name, ".heights[", i, "]"), field.heights[i]);
  }
}

void check(const std::string& name, const TerrainRandomBoxes& boxes) {
  require_all_finite(name + ".position", boxes.position);
  require_positive(name + ".size_x", boxes.size_x);
  require_positive(name + ".size_y", boxes.size_y);
  require_positive(name + ".cell", boxes.cell);
  const double count = (boxes.size_x / boxes.cell) * (boxes.size_y / boxes.cell);
  require(count <= kMaxRandomBoxes, name + ".cell", boxes.cell,
          text("large enough for at most ", kMaxRandomBoxes, " boxes"));
  require_not_negative(name + ".max_height", boxes.max_height);
  require_finite(name + ".friction", boxes.friction);
}

void check(const TerrainOptions& terrain) {
  require_not_negative("terrain.friction", terrain.friction);
  for (std::size_t i = 0; i < terrain.elements.size(); ++i) {
    const std::string name = text("terrain.elements[", i, "]");
    std::visit([&name](const auto& element) { check(name, element); }, terrain.elements[i]);
  }
}

void check(const ContactOptions& contact, double timestep) {
  require(std::isfinite(contact.solref_time) && contact.solref_time >= 2.0 * timestep,
          "contact.solref_time", contact.solref_time,
          text("at least two timesteps, ", 2.0 * timestep, " s"));
  require_positive("contact.solref_damping", contact.solref_damping);
  require(contact.solimp_min > 0.0 && contact.solimp_min < 1.0, "contact.solimp_min",
          contact.solimp_min, "between 0 and 1");
  require(contact.solimp_max >= contact.solimp_min && contact.solimp_max < 1.0,
          "contact.solimp_max", contact.solimp_max, "between solimp_min and 1");
  require_positive("contact.solimp_width", contact.solimp_width);
  require_positive("contact.impratio", contact.impratio);
}

void check(const ActuatorOptions& actuators) {
  require_delay("actuators.delay_ticks", actuators.delay_ticks);
  require_positive("actuators.bandwidth_hz", actuators.bandwidth_hz);
  require_positive("actuators.stall_torque", actuators.stall_torque);
  require_positive("actuators.no_load_speed", actuators.no_load_speed);
  require_not_negative("actuators.quantisation", actuators.quantisation);
  require_positive("actuators.torque_gain", actuators.torque_gain);
  for (Eigen::Index i = 0; i < kNumJoints; ++i) {
    require_positive(text("actuators.joint_torque_gain[", i, "]"), actuators.joint_torque_gain[i]);
  }
  require(actuators.level == 1 || actuators.level == 2, "actuators.level", actuators.level,
          "1 or 2");
  require_positive("actuators.spring.stiffness", actuators.spring.stiffness);
  require_positive("actuators.rotor.inertia", actuators.rotor.inertia);
  require_positive("actuators.rotor.gear_ratio", actuators.rotor.gear_ratio);
  require_not_negative("actuators.rotor.viscous", actuators.rotor.viscous);
  require_not_negative("actuators.rotor.coulomb", actuators.rotor.coulomb);
  require_positive("actuators.rotor.coulomb_speed", actuators.rotor.coulomb_speed);
  require_positive("actuators.torque_loop.damping", actuators.torque_loop.damping);
  require_positive("actuators.torque_loop.integral_time", actuators.torque_loop.integral_time);
}

void check(const std::string& name, const SensorFault& fault) {
  require_not_negative(name + ".time", fault.time);
  require(fault.duration > 0.0, name + ".duration", fault.duration, "above 0");
  require_finite(name + ".size", fault.size);
  require(fault.joint >= -1 && fault.joint < kNumJoints, name + ".joint", fault.joint,
          "between 0 and 11, or -1 for all");
  require(fault.leg >= -1 && fault.leg < kNumLegs, name + ".leg", fault.leg,
          "between 0 and 3, or -1 for all");
  const bool is_of_joints =
      fault.sensor == FaultySensor::encoders || fault.sensor == FaultySensor::joint_torques;
  require(is_of_joints || fault.joint == -1, name + ".joint", fault.joint,
          "-1, as only encoders and joint torques have joints");
  const bool is_of_feet = fault.sensor == FaultySensor::foot_force;
  require(is_of_feet || fault.leg == -1, name + ".leg", fault.leg,
          "-1, as only foot sensors have legs");
  if (fault.kind != FaultKind::late) return;
  require(fault.size >= 1.0 && fault.size <= kMaxDelayTicks && fault.size == std::floor(fault.size),
          name + ".size", fault.size,
          text("a whole number of ticks between 1 and ", kMaxDelayTicks));
}

void check(const ImuOptions& imu) {
  require_not_negative("sensors.imu.gyro_noise", imu.gyro_noise);
  require_not_negative("sensors.imu.gyro_bias", imu.gyro_bias);
  require_not_negative("sensors.imu.gyro_drift", imu.gyro_drift);
  require_positive("sensors.imu.gyro_drift_time", imu.gyro_drift_time);
  require_not_negative("sensors.imu.accelerometer_noise", imu.accelerometer_noise);
  require_not_negative("sensors.imu.accelerometer_bias", imu.accelerometer_bias);
  require_not_negative("sensors.imu.accelerometer_drift", imu.accelerometer_drift);
  require_positive("sensors.imu.accelerometer_drift_time", imu.accelerometer_drift_time);
  require_all_finite("sensors.imu.tilt", imu.tilt);
  require_positive("sensors.imu.rate_hz", imu.rate_hz);
  require_delay("sensors.imu.delay_ticks", imu.delay_ticks);
}

void check(const SensorOptions& sensors) {
  require_not_negative("sensors.encoders.resolution", sensors.encoders.resolution);
  require_not_negative("sensors.encoders.noise", sensors.encoders.noise);
  require_positive("sensors.encoders.rate_hz", sensors.encoders.rate_hz);
  require_not_negative("sensors.joint_torques.noise", sensors.joint_torques.noise);
  require_positive("sensors.joint_torques.rate_hz", sensors.joint_torques.rate_hz);
  require_all_finite("sensors.encoders.offset", sensors.encoders.offset);
  require_delay("sensors.encoders.delay_ticks", sensors.encoders.delay_ticks);
  require_delay("sensors.joint_torques.delay_ticks", sensors.joint_torques.delay_ticks);
  check(sensors.imu);
  require_not_negative("sensors.foot_force.noise", sensors.foot_force.noise);
  require_positive("sensors.foot_force.rate_hz", sensors.foot_force.rate_hz);
  require_delay("sensors.foot_force.delay_ticks", sensors.foot_force.delay_ticks);
  for (std::size_t i = 0; i < sensors.faults.size(); ++i) {
    check(text("sensors.faults[", i, "]"), sensors.faults[i]);
    if (sensors.faults[i].sensor == FaultySensor::foot_force && !sensors.foot_force.present) {
      throw Error(text("sensors.faults[", i, "].sensor is foot_force; the robot has none"));
    }
  }
}

void require_length_offset(const char* link, std::size_t leg, double offset) {
  require(std::abs(offset) <= kMaxLengthOffset,
          text("disturbances.", link, "_length_offset[", leg, "]"), offset,
          text("between -", kMaxLengthOffset, " and ", kMaxLengthOffset, " m"));
}

void require_mass_scale(const std::string& name, double scale) {
  require(scale >= 1.0 / kMaxMassScale && scale <= kMaxMassScale, name, scale,
          text("between ", 1.0 / kMaxMassScale, " and ", kMaxMassScale));
}

void check(const std::string& name, const Lift& lift) {
  require_not_negative(name + ".time", lift.time);
  require_positive(name + ".height", lift.height);
  require_positive(name + ".duration", lift.duration);
  require_not_negative(name + ".hold", lift.hold);
  require_all_finite(name + ".point", lift.point);
}

void check(const DisturbanceOptions& disturbances) {
  for (std::size_t i = 0; i < disturbances.pushes.size(); ++i) {
    const Push& push = disturbances.pushes[i];
    const std::string name = text("disturbances.pushes[", i, "]");
    require_not_negative(name + ".time", push.time);
    require_positive(name + ".duration", push.duration);
    require_all_finite(name + ".force", push.force);
  }
  for (std::size_t i = 0; i < disturbances.lifts.size(); ++i) {
    check(text("disturbances.lifts[", i, "]"), disturbances.lifts[i]);
  }
  const double payload = disturbances.payload.mass;
  require(payload >= 0.0 && payload <= kMaxPayload, "disturbances.payload.mass", payload,
          text("between 0 and ", kMaxPayload, " kg"));
  require_all_finite("disturbances.payload.position", disturbances.payload.position);
  require_mass_scale("disturbances.base_mass_scale", disturbances.base_mass_scale);
  require_mass_scale("disturbances.leg_mass_scale", disturbances.leg_mass_scale);
  require_all_finite("disturbances.base_com_offset", disturbances.base_com_offset);
  for (Eigen::Index i = 0; i < kNumJoints; ++i) {
    require_mass_scale(text("disturbances.link_mass_scale[", i, "]"),
                       disturbances.link_mass_scale[i]);
  }
  for (std::size_t leg = 0; leg < kNumLegs; ++leg) {
    require_length_offset("thigh", leg, disturbances.thigh_length_offset[leg]);
    require_length_offset("shank", leg, disturbances.shank_length_offset[leg]);
  }
}

void check(const InitialState& initial) {
  require_finite("initial.position[0]", initial.position.x());
  require_finite("initial.position[1]", initial.position.y());
  require(!std::isinf(initial.position.z()), "initial.position[2]", initial.position.z(),
          "finite, or NaN for feet on the terrain");
  require_finite("initial.yaw", initial.yaw);
  require_all_finite("initial.q", initial.q);
}

}  // namespace

int steps_per_period(const PlantOptions& options) {
  const double steps = std::round(options.control_period / options.timestep);
  const bool whole =
      steps >= 1.0 && steps <= 1e6 &&
      std::abs(steps * options.timestep - options.control_period) <= 1e-6 * options.timestep;
  require(whole, "control_period", options.control_period,
          text("a whole multiple of the timestep, ", options.timestep, " s"));
  return static_cast<int>(steps);
}

void check_options(const PlantOptions& options) {
  require_positive("timestep", options.timestep);
  require_positive("control_period", options.control_period);
  static_cast<void>(steps_per_period(options));
  check(options.terrain);
  check(options.contact, options.timestep);
  check(options.actuators);
  check(options.sensors);
  check(options.disturbances);
  check(options.initial);
}

}  // namespace surefoot::simulation
