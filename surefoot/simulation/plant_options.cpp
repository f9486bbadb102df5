#include "surefoot/simulation/plant_options.hpp"

#include "surefoot/base/fields.hpp"
#include "surefoot/simulation/plant_elements.hpp"

#include <algorithm>

namespace surefoot::simulation {
namespace {

constexpr NumberRange kDelay{.min = 0.0, .max = kMaxDelayTicks};
constexpr NumberRange kFriction{.min = 0.0, .words = "a number of at least 0", .none = -1.0};
constexpr NumberRange kImpedance{.min = 1e-4, .max = 0.9999, .words = "a number between 0 and 1"};
constexpr NumberRange kStiffnessRange{
    .min = 0.0, .max = 1e5, .min_included = false, .words = "above 0, at most 1e5 N·m/rad"};
constexpr NumberRange kMass{.min = 0.0, .max = kMaxPayload, .words = "a number from 0 to 200 kg"};
constexpr NumberRange kScale{
    .min = 1.0 / kMaxMassScale, .max = kMaxMassScale, .words = "a number from 0.1 to 10"};
constexpr NumberRange kLength{
    .min = -kMaxLengthOffset, .max = kMaxLengthOffset, .words = "a number between -0.1 and 0.1 m"};
constexpr NumberRange kLiftHeight{
    .min = 0.0, .max = 2.0, .min_included = false, .words = "above 0, at most 2 m"};
constexpr NumberRange kDuration{.min = 0.0,
                                .min_included = false,
                                .words = "a number above 0",
                                .none = std::numeric_limits<double>::infinity()};

Numbers axes(Vec3& value) { return {value.data(), axis_elements()}; }
Numbers angles(Vec3& value) { return {value.data(), angle_elements()}; }
/// How many legs have these joints? Those of arms may follow.
int num_legs_of(const JointVector& joints) {
  return joints.size() < kJointsPerLeg * kMaxLegs ? kNumLegs : kMaxLegs;
}
Numbers joints(JointVector& value) { return {value.data(), joint_elements(num_legs_of(value))}; }
Numbers one_or_joints(JointVector& value) {
  return {value.data(), joint_elements(num_legs_of(value)), true};
}
Numbers legs(PerLeg<double>& value) {
  return {value.data(), leg_elements(static_cast<int>(value.size()))};
}

Field place_of(Vec3& position, const char* help) {
  return {"position", axes(position), kAnyNumber, "m", help};
}
Field orientation_of(Vec3& rpy) {
  return {"rpy", axes(rpy), kAnyNumber, "rad", "roll, pitch, yaw about fixed axes"};
}
Field friction_of(double& friction) {
  return {"friction", &friction, kFriction, "", "coefficient; without it that of the terrain"};
}
Field size_of(const char* key, double& size) { return {key, &size, kPositive, "m", "extent"}; }
Field rate_of(double& rate) {
  return {"rate_hz",   &rate, kPositive, "Hz", "of the samples, at most the control rate",
          Sizing::none};
}
Field delay_of(int& ticks) {
  return {"delay_ticks", &ticks, kDelay, "ticks", "on the way to the controller"};
}

Group fields(EncoderOptions& o) {
  return {{"resolution", &o.resolution, kNotNegative, "rad", "0.025°; 0: exact"},
          {"noise", &o.noise, kNotNegative, "rad", "white, before it is rounded"},
          {"offset", joints(o.offset), kAnyNumber, "rad", "by which each joint's zero is wrong"},
          rate_of(o.rate_hz),
          delay_of(o.delay_ticks)};
}

Group fields(JointTorqueSensorOptions& o) {
  return {{"noise", &o.noise, kNotNegative, "N·m", "white"},
          rate_of(o.rate_hz),
          delay_of(o.delay_ticks)};
}

Group fields(ImuOptions& o) {
  return {{"gyro_noise", &o.gyro_noise, kNotNegative, "rad/s", "white", Sizing::none},
          {"gyro_bias", &o.gyro_bias, kNotNegative, "rad/s", "constant", Sizing::none},
          {"gyro_drift", &o.gyro_drift, kNotNegative, "rad/s", "in the long run", Sizing::none},
          {"gyro_drift_time", &o.gyro_drift_time, kPositive, "s", "correlation time", Sizing::none},
          {"accelerometer_noise", &o.accelerometer_noise, kNotNegative, "m/s²", "white"},
          {"accelerometer_bias", &o.accelerometer_bias, kNotNegative, "m/s²", "constant"},
          {"accelerometer_drift", &o.accelerometer_drift, kNotNegative, "m/s²", "in the long run"},
          {"accelerometer_drift_time", &o.accelerometer_drift_time, kPositive, "s",
           "correlation time", Sizing::none},
          {"tilt", angles(o.tilt), kAnyNumber, "rad", "of the IMU in B, which counts as B itself"},
          rate_of(o.rate_hz),
          delay_of(o.delay_ticks)};
}

Group fields(FootForceSensorOptions& o) {
  return {{"present", &o.present, "ANYmal B has none"},
          {"noise", &o.noise, kNotNegative, "N", "white"},
          rate_of(o.rate_hz),
          delay_of(o.delay_ticks)};
}

Group fields(RotorOptions& o) {
  return {{"inertia", &o.inertia, kPositive, "kg·m²", "of the rotor itself; 0.06 at the joint"},
          {"gear_ratio", &o.gear_ratio, kPositive, "", "turns of the rotor per turn of the joint"},
          {"viscous", &o.viscous, kNotNegative, "N·m·s/rad", "friction, at the joint"},
          {"coulomb", &o.coulomb, kNotNegative, "N·m", "friction, at the joint"},
          {"coulomb_speed", &o.coulomb_speed, kPositive, "rad/s",
           "friction is coulomb tanh(ω / speed)"}};
}

/// Further numbers are as this one.
void resize(JointVector& values, Eigen::Index size, double value) {
  const Eigen::Index known = std::min(values.size(), size);
  values.conservativeResize(size);
  values.tail(size - known).setConstant(value);
}

}  // namespace

void set_num_legs(DisturbanceOptions& options, int num_legs) {
  resize(options.link_mass_scale, kJointsPerLeg * num_legs, 1.0);
  options.thigh_length_offset.resize(num_legs);
  options.shank_length_offset.resize(num_legs);
}

void set_num_legs(PlantOptions& options, int num_legs) {
  const Eigen::Index n = kJointsPerLeg * num_legs;
  resize(options.actuators.stall_torque, n, options.actuators.stall_torque[0]);
  resize(options.actuators.no_load_speed, n, options.actuators.no_load_speed[0]);
  resize(options.actuators.joint_torque_gain, n, 1.0);
  resize(options.sensors.encoders.offset, n, 0.0);
  resize(options.initial.q, n, 0.0);
  set_num_legs(options.disturbances, num_legs);
}

Group fields(TerrainBox& o) {
  return {place_of(o.position, "of its centre"),
          Field{"size", axes(o.size), kPositive, "m", "full edge lengths"}.required(),
          orientation_of(o.rpy), friction_of(o.friction)};
}

Group fields(TerrainLevel& o) {
  return {place_of(o.position, "a point of it"), orientation_of(o.rpy), friction_of(o.friction)};
}

Group fields(TerrainHeightField& o) {
  return {place_of(o.position, "of its centre"),
          size_of("size_x", o.size_x).required(),
          size_of("size_y", o.size_y).required(),
          {"columns", &o.columns, {.min = 0}, "", "grid points along x"},
          {"rows", &o.rows, {.min = 0}, "", "grid points along y"},
          {"heights", &o.heights, kAnyNumber, "m", "rows × columns, row by row along y"},
          {"amplitude", &o.amplitude, kNotNegative, "m", "instead of heights: of smooth noise"},
          {"wavelength", &o.wavelength, kPositive, "m", "of that noise"},
          {"seed", &o.seed, "of that noise"},
          friction_of(o.friction)};
}

Group fields(TerrainRandomBoxes& o) {
  return {
      place_of(o.position, "centre of the field, z of the lowest top face"),
      size_of("size_x", o.size_x).required(),
      size_of("size_y", o.size_y).required(),
      {"cell", &o.cell, kPositive, "m", "edge of a box"},
      Field{"max_height", &o.max_height, kNotNegative, "m", "top faces from 0 to this"}.required(),
      {"seed", &o.seed, "of the heights"},
      friction_of(o.friction)};
}

Group fields(ContactOptions& o) {
  return Group{{"solref_time", &o.solref_time, kPositive, "s", "at least two timesteps"},
               {"solref_damping", &o.solref_damping, kPositive, "", "damping ratio"},
               {"solimp_min", &o.solimp_min, kImpedance, "", "impedance at no penetration"},
               {"solimp_max", &o.solimp_max, kImpedance, "", "impedance at solimp_width"},
               {"solimp_width", &o.solimp_width, kPositive, "m", "penetration"},
               {"impratio", &o.impratio, kPositive, "", "of friction to normal impedance"}}
      .with([&o](const Given& given) {
        given.require_order("solimp_min", o.solimp_min, "solimp_max", o.solimp_max);
      });
}

Group fields(ActuatorOptions& o) {
  return {
      {"model", choice(o.model, {"ideal", "sea"}), "ideal: the command, in the robot's limits"},
      {"level",
       &o.level,
       {.min = 1, .max = 2},
       "",
       "of sea; 1: delay and lag, 2: motor, spring and torque loop"},
      {"delay_ticks", &o.delay_ticks, kDelay, "ticks", "between command and motor"},
      {"bandwidth_hz", &o.bandwidth_hz, kPositive, "Hz",
       "of the lag, at level 2 of the torque loop", Sizing::none},
      {"stall_torque", one_or_joints(o.stall_torque), kPositive, "N·m",
       "torque–speed line: at rest; without it the robot's", Sizing::none},
      {"no_load_speed", one_or_joints(o.no_load_speed), kPositive, "rad/s",
       "torque–speed line: no torque, at level 2 the rotor's speed over the gear ratio; without it "
       "the robot's",
       Sizing::none},
      {"quantisation", &o.quantisation, kNotNegative, "N·m",
       "of the torque, at level 2 as measured"},
      {"torque_gain", &o.torque_gain, kPositive, "", "true torque per commanded, of all joints"},
      {"joint_torque_gain", joints(o.joint_torque_gain), kPositive, "", "of each joint, on top"},
      {"spring",
       Group{
           {"stiffness", &o.spring.stiffness, kStiffnessRange, "N·m/rad", "of ANYmal B's drives"}},
       "between motor and joint, at level 2"},
      {"rotor", fields(o.rotor), "motor and gear, at level 2"},
      {"torque_loop",
       Group{{"damping", &o.torque_loop.damping, kPositive, "", "ratio of the closed loop"},
             {"integral_time", &o.torque_loop.integral_time, kPositive, "s", "", Sizing::none}},
       "on the spring's torque, at level 2"}};
}

Group sensor_fields(SensorOptions& o) {
  return {{"encoders", fields(o.encoders), "joint angles"},
          {"joint_torques", fields(o.joint_torques), "torques that act at the joints"},
          {"imu", fields(o.imu), "gyroscope and accelerometer"},
          {"foot_force", fields(o.foot_force), "normal forces of the feet"}};
}

Group fields(SensorFault& o) {
  return {
      Field{"sensor",
            choice(o.sensor,
                   {"imu", "gyro", "accelerometer", "encoders", "joint_torques", "foot_force"}),
            "that fails"}
          .required(),
      Field{"kind", choice(o.kind, {"stops", "repeats", "nan", "jump", "late", "spike", "scaled"}),
            "see docs/simulation.md, Sensor faults"}
          .required(),
      Field{"time", &o.time, kNotNegative, "s", "start"}.required(),
      {"duration", &o.duration, kDuration, "s", "without it the fault stays"},
      {"size", &o.size, kAnyNumber, "", "in the sensor's unit; of late ticks, of scaled a factor"},
      {"joint", place(o.joint, joint_elements(o.num_legs), "joint"),
       "of encoders and joint_torques"},
      {"leg", place(o.leg, leg_elements(o.num_legs), "leg"), "of foot_force"}};
}

Group fields(Push& o) {
  return {{"body", &o.body, "link of the URDF; without it the base"},
          Field{"time", &o.time, kNotNegative, "s", "start"}.required(),
          {"duration", &o.duration, kPositive, "s", ""},
          {"force", axes(o.force), kAnyNumber, "N", "in S"}};
}

Group fields(Lift& o) {
  return {Field{"time", &o.time, kNotNegative, "s", "start"}.required(),
          {"height", &o.height, kLiftHeight, "m", "of the hand's way"},
          {"duration", &o.duration, kPositive, "s", "of the way up, and of the way down"},
          {"hold", &o.hold, kNotNegative, "s", "between them"},
          {"point", axes(o.point), kAnyNumber, "m", "of the base, in B"}};
}

Group disturbance_fields(DisturbanceOptions& o) {
  return {
      {"payload",
       Group{Field{"mass", &o.payload.mass, kMass, "kg", "point mass fixed to the base"}.required(),
             {"position", axes(o.payload.position), kAnyNumber, "m", "in B"}},
       "that the controller does not know of"},
      {"base_mass_scale", &o.base_mass_scale, kScale, "", "of the base and what is fixed to it"},
      {"leg_mass_scale", &o.leg_mass_scale, kScale, "", "of all links of the legs"},
      {"link_mass_scale",
       Numbers{o.link_mass_scale.data(), link_elements(num_legs_of(o.link_mass_scale))}, kScale, "",
       "of each link, on top"},
      {"base_com_offset", axes(o.base_com_offset), kAnyNumber, "m", "in B"},
      {"thigh_length_offset", legs(o.thigh_length_offset), kLength, "m", "HFE to KFE axis"},
      {"shank_length_offset", legs(o.shank_length_offset), kLength, "m",
       "KFE axis to foot centre"}};
}

}  // namespace surefoot::simulation
