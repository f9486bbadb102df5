#include "surefoot/config/sensor_section.hpp"

#include "surefoot/config/nearest_name.hpp"
#include "surefoot/config/plant_vectors.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace surefoot {
namespace {

void read_encoders(Section& section, EncoderOptions& encoders) {
  section.number("resolution", encoders.resolution, kNotNegative);
  section.number("noise", encoders.noise, kNotNegative);
  section.elements("offset", encoders.offset.data(), joint_elements());
  section.number("rate_hz", encoders.rate_hz, kPositive);
  section.integer("delay_ticks", encoders.delay_ticks, 0, kMaxDelayTicks);
}

void read_joint_torques(Section& section, JointTorqueSensorOptions& torques) {
  section.number("noise", torques.noise, kNotNegative);
  section.number("rate_hz", torques.rate_hz, kPositive);
  section.integer("delay_ticks", torques.delay_ticks, 0, kMaxDelayTicks);
}

void read_imu(Section& section, ImuOptions& imu) {
  section.number("gyro_noise", imu.gyro_noise, kNotNegative);
  section.number("gyro_bias", imu.gyro_bias, kNotNegative);
  section.number("gyro_drift", imu.gyro_drift, kNotNegative);
  section.number("gyro_drift_time", imu.gyro_drift_time, kPositive);
  section.number("accelerometer_noise", imu.accelerometer_noise, kNotNegative);
  section.number("accelerometer_bias", imu.accelerometer_bias, kNotNegative);
  section.number("accelerometer_drift", imu.accelerometer_drift, kNotNegative);
  section.number("accelerometer_drift_time", imu.accelerometer_drift_time, kPositive);
  section.elements("tilt", imu.tilt.data(), angle_elements());
  section.number("rate_hz", imu.rate_hz, kPositive);
  section.integer("delay_ticks", imu.delay_ticks, 0, kMaxDelayTicks);
}

void read_foot_force(Section& section, FootForceSensorOptions& feet) {
  section.flag("present", feet.present);
  section.number("noise", feet.noise, kNotNegative);
  section.number("rate_hz", feet.rate_hz, kPositive);
  section.integer("delay_ticks", feet.delay_ticks, 0, kMaxDelayTicks);
}

void read_joint(Section& section, SensorFault& fault) {
  std::string name;
  section.text("joint", name);
  if (name.empty()) return;
  if (fault.sensor != FaultySensor::encoders && fault.sensor != FaultySensor::joint_torques)
    section.fail("joint", "only encoders and joint_torques have joints");
  const std::vector<std::string>& joints = joint_elements();
  const auto found = std::ranges::find(joints, name);
  if (found == joints.end())
    section.fail("joint", "unknown joint \"" + name + "\"; " + valid_names(name, joints));
  fault.joint = static_cast<int>(found - joints.begin());
}

void read_leg(Section& section, SensorFault& fault) {
  std::string name;
  section.text("leg", name);
  if (name.empty()) return;
  if (fault.sensor != FaultySensor::foot_force) section.fail("leg", "only foot_force has legs");
  const auto found = std::ranges::find(kLegNames, name);
  if (found == kLegNames.end()) {
    section.fail("leg", "unknown leg \"" + name + "\"; " +
                            valid_names(name, {kLegNames.begin(), kLegNames.end()}));
  }
  fault.leg = static_cast<int>(found - kLegNames.begin());
}

/// Jumps and spikes are told in the sensor's unit, lateness in ticks, a scale as a factor; the
/// others have no size.
void check_size(Section& section, const SensorFault& fault) {
  const bool late = fault.kind == FaultKind::late;
  const bool off = fault.kind == FaultKind::jump || fault.kind == FaultKind::spike;
  if (!late && !off && fault.kind != FaultKind::scaled) {
    if (section.node("size") != nullptr)
      section.fail("size", "only jump, spike, scaled and late have one");
    return;
  }
  section.require("size");
  if (off && fault.sensor == FaultySensor::imu)
    section.fail("sensor",
                 "a jump or spike is of the gyro or of the accelerometer, which have "
                 "different units");
  const bool whole =
      fault.size == std::floor(fault.size) && fault.size >= 1.0 && fault.size <= kMaxDelayTicks;
  if (late && section.node("size") != nullptr && !whole)
    section.fail("size",
                 "must be a whole number of ticks from 1 to " + std::to_string(kMaxDelayTicks));
}

void read_fault(Section& section, bool has_foot_sensors, SensorFault& fault) {
  for (const char* key : {"sensor", "kind", "time"}) section.require(key);
  section.choice<FaultySensor>("sensor", fault.sensor,
                               {{"imu", FaultySensor::imu},
                                {"gyro", FaultySensor::gyro},
                                {"accelerometer", FaultySensor::accelerometer},
                                {"encoders", FaultySensor::encoders},
                                {"joint_torques", FaultySensor::joint_torques},
                                {"foot_force", FaultySensor::foot_force}});
  if (fault.sensor == FaultySensor::foot_force && !has_foot_sensors)
    section.fail("sensor", "the robot has none; sensors.foot_force.present: true gives it one");
  section.choice<FaultKind>("kind", fault.kind,
                            {{"stops", FaultKind::stops},
                             {"repeats", FaultKind::repeats},
                             {"nan", FaultKind::nan},
                             {"jump", FaultKind::jump},
                             {"late", FaultKind::late},
                             {"spike", FaultKind::spike},
                             {"scaled", FaultKind::scaled}});
  section.number("time", fault.time, kNotNegative);
  section.number("duration", fault.duration, kPositive);
  if (fault.kind == FaultKind::spike && section.node("duration") != nullptr)
    section.fail("duration", "a spike is one sample and has none; a jump has");
  section.number("size", fault.size);
  read_joint(section, fault);
  read_leg(section, fault);
  check_size(section, fault);
}

/// Faults have names, so that another file or --set can change one.
void read_faults(Section& section, bool has_foot_sensors, std::vector<SensorFault>& faults) {
  for (const std::string& name : section.keys()) {
    if (section.node(name.c_str())->kind == ConfigNode::Kind::null) continue;
    section.section(name.c_str(),
                    [&](Section& s) { read_fault(s, has_foot_sensors, faults.emplace_back()); });
  }
}

}  // namespace

void read_sensors(Section& section, SensorOptions& sensors) {
  section.section("encoders", [&](Section& s) { read_encoders(s, sensors.encoders); });
  section.section("joint_torques",
                  [&](Section& s) { read_joint_torques(s, sensors.joint_torques); });
  section.section("imu", [&](Section& s) { read_imu(s, sensors.imu); });
  section.section("foot_force", [&](Section& s) { read_foot_force(s, sensors.foot_force); });
  section.section("faults",
                  [&](Section& s) { read_faults(s, sensors.foot_force.present, sensors.faults); });
}

}  // namespace surefoot
