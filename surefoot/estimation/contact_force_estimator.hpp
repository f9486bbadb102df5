#pragma once

#include "surefoot/estimation/foot_sensor_trust.hpp"
#include "surefoot/estimation/joint_observer.hpp"
#include "surefoot/estimation/swing_tare.hpp"
#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/per_leg.hpp"
#include "surefoot/signals/robot_state.hpp"
#include "surefoot/signals/sensor_reading.hpp"

#include <array>

namespace surefoot {
struct Group;
}  // namespace surefoot

namespace surefoot::estimation {

struct ContactForceOptions {
  double bandwidth_hz = 40.0;
  bool use_foot_sensor = false;
  SwingTareOptions tare = {};
};

/// Their names, units, ranges and help.
[[nodiscard]] Group fields(ContactForceOptions& o);

/// Ages of samples on arrival [s].
struct JointDelays {
  double encoders = 0.0, torques = 0.0;
};

/// Ground forces on the feet and joint velocities, from encoders and joint torques alone.
///
/// A JointObserver compares the motion of each leg k with Eq. (2) without ground forces:
///
///     a = M_kk⁻¹ (τ − h − M_kb u̇_b)_k,    f_k = (J_kᵀ)⁻¹ M_kk d̂_k
///
/// minus the usual torque error of a swing leg (SwingTare). A second observer gives the velocities.
/// It takes the same a for swing legs; for stance legs the a that keeps the foot in place,
/// J_k a + J_kb u̇_b + J̇ u = 0, as the ground takes up the torques. u̇_b is the base's acceleration,
/// the low-passed difference of the estimated velocities. J_k is the 3×3 block of the contact
/// Jacobian of leg k, inverted with a damping that matters only near the straight leg. Of a flat
/// foot it has six rows (`LimbDynamics`), so that its moment is no force. Forces in W,
/// of the ground on the foot [N]. Does not allocate.
class ContactForceEstimator {
 public:
  /// `period` of the control loop [s]; `scale` and numbers of joints and legs of the robot.
  ContactForceEstimator(const ContactForceOptions& options, double period, const Scale& scale = {},
                        int num_joints = kNumLegJoints, int num_legs = kNumLegs);

  /// First in a tick: takes encoders and joint torques, returns joint velocities [rad/s]. Forces
  /// belong to the later of the two samples. `delays` are the samples' usual ages.
  const JointVector& observe(const SensorReading& reading, const JointDelays& delays = {}) noexcept;

  /// Then, with the dynamics at the state: fills state.foot_force. `terrain_normal_W` is the unit
  /// normal estimate, along which a foot sensor measures. `stands`: the feet planned to carry load.
  void update(const model::Dynamics& dynamics, const PerLeg<bool>& stands,
              const Vec3& terrain_normal_W, const SensorReading& reading,
              RobotState& state) noexcept;

 private:
  using BaseVector = Eigen::Matrix<double, 6, 1>;

  static constexpr std::size_t kNumRecent = 8;  // ticks; later samples count as faulty
  /// The last few joint vectors, the newest first.
  struct Recent {
    std::array<JointVector, kNumRecent> values;
    void start(const JointVector& value) { values.fill(value); }
    void add(const JointVector& value);
    [[nodiscard]] const JointVector& ago(int ticks) const;
  };

  [[nodiscard]] int periods_until(double time) const;
  /// In whole ticks, limited to the recent ones.
  [[nodiscard]] int ticks_in(double delay) const;
  void set_delays(const JointDelays& delays);
  void update_flat_feet(const model::Dynamics& dynamics, const PerLeg<bool>& stands,
                        RobotState& state);
  void update_base_acceleration(const model::Dynamics& dynamics);
  /// Accelerations of a leg's joints, in the air under the measured torques and with a fixed foot.
  [[nodiscard]] Vec3 free_acceleration(const model::Dynamics& dynamics, Leg leg,
                                       const JointVector& torque) const;
  [[nodiscard]] Vec3 stance_acceleration(const model::Dynamics& dynamics, Leg leg) const;
  /// M_kk d̂_k of all legs [N·m].
  [[nodiscard]] LegJointVector missing_torque(const model::Dynamics& dynamics) const;

  ContactForceOptions options_;
  double period_;
  JointObserver force_observer_, velocity_observer_;
  SwingTare tare_;
  PerLeg<FootSensorTrust> foot_sensors_;
  Recent angles_, torques_;
  int angle_delay_ = 0, force_delay_ = 0;  // of the observers' states [ticks]
  int torque_lag_ = 0;                     // of torques behind angles, may be negative [ticks]
  double time_ = kNaN;                     ///< of the last reading [s]
  int periods_ = 0;                        ///< between the last two readings
  double periods_of_base_ = 0.0;  ///< since the last base velocity; some readings have no state
  bool begins_ = true;            ///< no update since the first reading
  BaseVector base_velocity_ = BaseVector::Zero(), base_acceleration_ = BaseVector::Zero();
};

}  // namespace surefoot::estimation
