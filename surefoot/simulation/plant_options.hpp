#pragma once

#include "surefoot/signals/sensor_reading.hpp"

#include <cstdint>
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace surefoot {

/// Limit of sensor and drive delays, in control ticks.
inline constexpr int kMaxDelayTicks = 1000;
/// Limit of a thigh's or shank's length error [m].
inline constexpr double kMaxLengthOffset = 0.1;
inline constexpr double kMaxPayload = 200.0;  ///< [kg]
/// Limit of mass scales and their inverses.
inline constexpr double kMaxMassScale = 10.0;

/// A box of terrain; `position` is its centre.
struct TerrainBox {
  Vec3 position = Vec3::Zero();  ///< [m]
  Vec3 size = Vec3::Ones();      ///< full edge lengths [m]
  Vec3 rpy = Vec3::Zero();       ///< roll, pitch, yaw [rad]
  double friction = -1.0;        ///< < 0: the terrain's default
};

/// An infinite plane through `position` with orientation `rpy`.
struct TerrainLevel {
  Vec3 position = Vec3::Zero();  ///< [m]
  Vec3 rpy = Vec3::Zero();       ///< roll, pitch, yaw [rad]
  double friction = -1.0;        ///< < 0: the terrain's default
};

/// A height field: heights [m] over a regular grid centred at `position`, row by row along y.
struct TerrainHeightField {
  Vec3 position = Vec3::Zero();
  double size_x = 1.0, size_y = 1.0;  ///< full extent [m]
  int columns = 0, rows = 0;          ///< grid points along x and y
  std::vector<double> heights;        ///< rows × columns; empty: generated
  double amplitude = 0.0;             ///< generated: smooth noise in ± amplitude [m]
  double wavelength = 0.5;            ///< generated: [m]
  std::uint64_t seed = 0;
  double friction = -1.0;
};

/// Random boxes on a grid, reproducible by seed.
struct TerrainRandomBoxes {
  Vec3 position = Vec3::Zero();       ///< centre of the field, z = lowest top face
  double size_x = 2.0, size_y = 2.0;  ///< [m]
  double cell = 0.3;                  ///< edge of a box [m]
  double max_height = 0.1;            ///< top faces uniformly in 0 … max [m]
  std::uint64_t seed = 0;
  double friction = -1.0;
};

using TerrainElement =
    std::variant<TerrainBox, TerrainLevel, TerrainHeightField, TerrainRandomBoxes>;

struct TerrainOptions {
  double friction = 0.8;  ///< default coefficient of all elements
  std::vector<TerrainElement> elements;
};

/// Foot contact of the simulator (MuJoCo's solref, solimp, impratio).
struct ContactOptions {
  double solref_time = 0.005;
  double solref_damping = 1.0;
  double solimp_min = 0.9, solimp_max = 0.995, solimp_width = 0.001;
  double impratio = 100.0;
};

enum class ActuatorModel { ideal, sea };

/// Spring between motor and joint, of `sea` at level 2.
struct SpringOptions {
  double stiffness = 180.9;  ///< [N·m/rad]
};

/// Motor and gear, of `sea` at level 2. Friction is at the joint's side of the gear.
struct RotorOptions {
  double inertia = 2.4e-5;     ///< of the rotor [kg·m²]; 0.06 at the joint
  double gear_ratio = 50.0;    ///< turns of the rotor per turn of the joint
  double viscous = 0.2;        ///< [N·m·s/rad]
  double coulomb = 1.0;        ///< [N·m]
  double coulomb_speed = 0.1;  ///< of the sign change, tanh(ω / speed) [rad/s]
};

/// Control loop of the spring's torque, of `sea` at level 2. Its gains follow from `bandwidth_hz`.
struct TorqueLoopOptions {
  double damping = 0.7;        ///< ratio of the closed loop
  double integral_time = 0.1;  ///< [s]
};

struct ActuatorOptions {
  ActuatorModel model = ActuatorModel::ideal;  ///< a scenario's default is sea
  // sea:
  int level = 1;                ///< 1: delay and lag; 2: motor, spring and torque loop
  int delay_ticks = 1;          ///< control ticks between command and motor
  double bandwidth_hz = 70.0;   ///< of the lag at level 1, of the torque loop at level 2
  double stall_torque = 40.0;   ///< torque limit at rest [N·m]
  double no_load_speed = 12.0;  ///< speed at which the torque limit is 0 [rad/s]
  double quantisation = 0.2;    ///< of the applied (level 1) or measured (2) torque [N·m]
  double torque_gain = 1.0;     ///< true torque per commanded, of all joints
  JointVector joint_torque_gain = JointVector::Ones();  ///< of each joint, on top
  SpringOptions spring;
  RotorOptions rotor;
  TorqueLoopOptions torque_loop;
};

// Sensors. Noise is white, with the standard deviation of a sample. A rate is that of samples, at
// most the control rate; below it a sample is held until the next. A delay is of the transmission,
// in control ticks.

struct EncoderOptions {
  double resolution = 4.4e-4;                ///< [rad], 0.025°; 0 = exact
  double noise = 0.0;                        ///< before rounding [rad]
  JointVector offset = JointVector::Zero();  ///< error of each joint's zero [rad]
  double rate_hz = 400.0;
  int delay_ticks = 0;
};

struct JointTorqueSensorOptions {
  double noise = 0.2;  ///< [N·m]
  double rate_hz = 400.0;
  int delay_ticks = 0;
};

struct ImuOptions {
  double gyro_noise = 2.5e-3;          ///< [rad/s]
  double gyro_bias = 1e-3;             ///< standard deviation of the constant bias [rad/s]
  double accelerometer_noise = 0.015;  ///< [m/s²]
  double accelerometer_bias = 0.08;    ///< standard deviation of the constant bias [m/s²]
  // Biases also drift: a Gauss–Markov process from 0, with the standard deviation in the long run
  // and the correlation time. 0: constant biases.
  double gyro_drift = 0.0;                  ///< [rad/s]
  double gyro_drift_time = 1000.0;          ///< [s]
  double accelerometer_drift = 0.0;         ///< [m/s²]
  double accelerometer_drift_time = 300.0;  ///< [s]
  Vec3 tilt = Vec3::Zero();  ///< roll, pitch, yaw of the IMU in B, unknown to the robot [rad]
  double rate_hz = 400.0;
  int delay_ticks = 0;
};

struct FootForceSensorOptions {
  bool present = false;  ///< ANYmal B has none
  double noise = 1.0;    ///< [N]
  double rate_hz = 400.0;
  int delay_ticks = 0;
};

enum class FaultySensor { imu, gyro, accelerometer, encoders, joint_torques, foot_force };

enum class FaultKind {
  stops,    ///< no samples: NaN, and the sample time stands still
  repeats,  ///< the last sample again and again, with its time
  nan,      ///< samples are NaN
  jump,     ///< every sample is off by `size`
  late,     ///< samples are `size` ticks older than usual
  spike,    ///< one sample is off by `size`
  scaled,   ///< samples are multiplied by `size`: another unit, or a wrong sign
};

/// A sensor fault over a time.
struct SensorFault {
  FaultySensor sensor = FaultySensor::imu;
  FaultKind kind = FaultKind::stops;
  double time = 0.0;                                          ///< start [s]
  double duration = std::numeric_limits<double>::infinity();  ///< [s]
  /// In the sensor's unit, on each of its values; `late`: control ticks; `scaled`: a factor.
  double size = 0.0;
  int joint = -1;  ///< encoders and joint_torques: only this one; -1: all
  int leg = -1;    ///< foot_force: only this one; -1: all
};

struct SensorOptions {
  EncoderOptions encoders;
  JointTorqueSensorOptions joint_torques;
  ImuOptions imu;
  FootForceSensorOptions foot_force;
  std::vector<SensorFault> faults;  ///< applied in this order
};

/// A push: a force on a body over a time. A scenario may also give its impulse, or a magnitude and
/// a direction along the ground.
struct Push {
  std::string body;           ///< URDF link; empty: the base
  double time = 0.0;          ///< start [s]
  double duration = 0.1;      ///< [s]
  Vec3 force = Vec3::Zero();  ///< in W [N]
};

/// Somebody lifts the robot at a point of its base, by a spring that only pulls up, and damps the
/// point. The hand rises, stays, comes down again and lets go.
struct Lift {
  double time = 0.0;                 ///< start [s]
  double height = 0.3;               ///< rise of the hand [m]
  double duration = 1.0;             ///< of the rise, and of the descent [s]
  double hold = 3.0;                 ///< time between them [s]
  Vec3 point = Vec3(0.0, 0.0, 0.3);  ///< of the base, in B [m]
};

struct Payload {
  double mass = 0.0;                    ///< [kg], a point mass fixed to the base
  Vec3 position = Vec3(0.0, 0.0, 0.2);  ///< in B [m]
};

/// External forces on the robot, and differences from the controller's model.
struct DisturbanceOptions {
  std::vector<Push> pushes;
  std::vector<Lift> lifts;
  Payload payload;
  double base_mass_scale = 1.0;
  double leg_mass_scale = 1.0;                        ///< of all links of the legs
  JointVector link_mass_scale = JointVector::Ones();  ///< of the link behind each joint, on top
  Vec3 base_com_offset = Vec3::Zero();                ///< in B [m]
  PerLeg<double> thigh_length_offset{};               ///< longer by this, HFE axis to KFE axis [m]
  PerLeg<double> shank_length_offset{};               ///< KFE axis to the foot sphere's centre [m]
};

/// Pose and posture at the start.
struct InitialState {
  Vec3 position = Vec3(0.0, 0.0, kNaN);  ///< of the base; z NaN: feet on the terrain
  double yaw = 0.0;                      ///< [rad]
  JointVector q = JointVector::Zero();   ///< joint angles [rad]
  /// The posture is not the stance, so any part may touch the ground first.
  bool is_given = false;
  /// Before the run stiff springs hold the joints for at least this long, feet in the air are
  /// lowered, and all motion stops: the run begins at rest, with loaded feet. 0: it begins with the
  /// first touching foot, without load [s].
  double settle = 0.0;
  /// Before the run the joints only damp, so that the robot lies on the ground.
  bool limp = false;
};

struct PlantOptions {
  double timestep = 0.0005;        ///< of the physics [s]
  double control_period = 0.0025;  ///< [s], a whole multiple of the timestep
  std::uint64_t seed = 1;          ///< of the sensors' noise
  TerrainOptions terrain;
  ContactOptions contact;
  ActuatorOptions actuators;
  SensorOptions sensors;
  DisturbanceOptions disturbances;
  InitialState initial;
};

}  // namespace surefoot
