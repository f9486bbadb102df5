#pragma once

#include "surefoot/signals/sensor_reading.hpp"

#include <cstdint>
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace surefoot {
struct Group;
}  // namespace surefoot

namespace surefoot::simulation {

/// Limit of sensor and drive delays, in control ticks.
inline constexpr int kMaxDelayTicks = 1000;
/// Limit of a thigh's or shank's length error [m].
inline constexpr double kMaxLengthOffset = 0.1;
inline constexpr double kMaxPayload = 200.0;  ///< [kg]
/// Limit of mass scales and their inverses.
inline constexpr double kMaxMassScale = 10.0;

/// A box of terrain; `position` is its centre.
struct TerrainBox {
  Vec3 position = Vec3::Zero(), size = Vec3::Ones(), rpy = Vec3::Zero();
  double friction = -1.0;  ///< here and below: −1 is the terrain's default
};

/// An infinite plane through `position` with orientation `rpy`.
struct TerrainLevel {
  Vec3 position = Vec3::Zero(), rpy = Vec3::Zero();
  double friction = -1.0;
};

/// A height field: heights over a regular grid centred at `position`, row by row along y. Without
/// heights they are generated.
struct TerrainHeightField {
  Vec3 position = Vec3::Zero();
  double size_x = 1.0, size_y = 1.0;
  int columns = 0, rows = 0;
  std::vector<double> heights;
  double amplitude = 0.0, wavelength = 0.5;
  std::uint64_t seed = 0;
  double friction = -1.0;
};

/// Random boxes on a grid, reproducible by seed.
struct TerrainRandomBoxes {
  Vec3 position = Vec3::Zero();
  double size_x = 2.0, size_y = 2.0;
  double cell = 0.3, max_height = 0.1;
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
  double stiffness = 180.9;
};

/// Motor and gear, of `sea` at level 2.
struct RotorOptions {
  double inertia = 2.4e-5, gear_ratio = 50.0;
  double viscous = 0.2, coulomb = 1.0, coulomb_speed = 0.1;
};

/// Control loop of the spring's torque, of `sea` at level 2. Its gains follow from `bandwidth_hz`.
struct TorqueLoopOptions {
  double damping = 0.7, integral_time = 0.1;
};

struct ActuatorOptions {
  ActuatorModel model = ActuatorModel::ideal;  ///< of a scenario that names none: sea
  int level = 1, delay_ticks = 1;
  double bandwidth_hz = 70.0;
  /// Of a scenario that does not give them, those of its robot.
  JointVector stall_torque = JointVector::Constant(kNumLegJoints, 40.0),
              no_load_speed = JointVector::Constant(kNumLegJoints, 12.0);
  double quantisation = 0.2, torque_gain = 1.0;
  JointVector joint_torque_gain = JointVector::Ones(kNumLegJoints);
  SpringOptions spring;
  RotorOptions rotor;
  TorqueLoopOptions torque_loop;
};

// Sensors. Noise is white, with the standard deviation of a sample. A rate is that of samples, at
// most the control rate; below it a sample is held until the next. A delay is of the transmission,
// in control ticks.

struct EncoderOptions {
  double resolution = 4.4e-4, noise = 0.0;
  JointVector offset = JointVector::Zero(kNumLegJoints);
  double rate_hz = 400.0;
  int delay_ticks = 0;
};

struct JointTorqueSensorOptions {
  double noise = 0.2, rate_hz = 400.0;
  int delay_ticks = 0;
};

/// Biases also drift: a Gauss–Markov process from 0, with the standard deviation in the long run
/// and the correlation time.
struct ImuOptions {
  double gyro_noise = 2.5e-3, gyro_bias = 1e-3;
  double accelerometer_noise = 0.015, accelerometer_bias = 0.08;
  double gyro_drift = 0.0, gyro_drift_time = 1000.0;
  double accelerometer_drift = 0.0, accelerometer_drift_time = 300.0;
  Vec3 tilt = Vec3::Zero();
  double rate_hz = 400.0;
  int delay_ticks = 0;
};

struct FootForceSensorOptions {
  bool present = false;
  double noise = 1.0, rate_hz = 400.0;
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
  double time = 0.0, duration = std::numeric_limits<double>::infinity();
  double size = 0.0;
  int joint = -1, leg = -1;  ///< these alone; −1: all
  int num_legs = kNumLegs;   ///< of the robot, for their names
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
  std::string body;  ///< URDF link; empty: the base
  double time = 0.0, duration = 0.1;
  Vec3 force = Vec3::Zero();
};

/// Somebody lifts the robot at a point of its base, by a spring that only pulls up, and damps the
/// point. The hand rises, stays, comes down again and lets go.
struct Lift {
  double time = 0.0, height = 0.3, duration = 1.0, hold = 3.0;
  Vec3 point = Vec3(0.0, 0.0, 0.3);
};

struct Payload {
  double mass = 0.0;
  Vec3 position = Vec3(0.0, 0.0, 0.2);
};

/// External forces on the robot, and differences from the controller's model.
struct DisturbanceOptions {
  std::vector<Push> pushes;
  std::vector<Lift> lifts;
  Payload payload;
  double base_mass_scale = 1.0, leg_mass_scale = 1.0;
  JointVector link_mass_scale = JointVector::Ones(kNumLegJoints);
  Vec3 base_com_offset = Vec3::Zero();
  PerLeg<double> thigh_length_offset{}, shank_length_offset{};
};

/// Pose and posture at the start.
struct InitialState {
  Vec3 position = Vec3(0.0, 0.0, kNaN);              ///< of the base; z NaN: feet on the terrain
  double yaw = 0.0;                                  ///< [rad]
  JointVector q = JointVector::Zero(kNumLegJoints);  ///< joint angles [rad]
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

/// For a robot with this many legs; numbers of further ones are the defaults.
void set_num_legs(PlantOptions& options, int num_legs);
void set_num_legs(DisturbanceOptions& options, int num_legs);

/// Names, units, ranges and help of these options.
[[nodiscard]] Group fields(TerrainBox& o);
[[nodiscard]] Group fields(TerrainLevel& o);
[[nodiscard]] Group fields(TerrainHeightField& o);
[[nodiscard]] Group fields(TerrainRandomBoxes& o);
[[nodiscard]] Group fields(ContactOptions& o);
[[nodiscard]] Group fields(ActuatorOptions& o);
[[nodiscard]] Group fields(SensorFault& o);
[[nodiscard]] Group fields(Push& o);
[[nodiscard]] Group fields(Lift& o);
[[nodiscard]] Group sensor_fields(SensorOptions& o);            ///< but for the faults
[[nodiscard]] Group disturbance_fields(DisturbanceOptions& o);  ///< but for pushes and lifts

}  // namespace surefoot::simulation
