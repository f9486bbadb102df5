#pragma once

#include "surefoot/estimation/foot_sensor_trust.hpp"
#include "surefoot/estimation/joint_observer.hpp"
#include "surefoot/estimation/swing_tare.hpp"
#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/robot_state.hpp"
#include "surefoot/signals/sensor_reading.hpp"

#include <array>

namespace surefoot {

struct ContactForceOptions {
  double bandwidth_hz = 40.0;  ///< of the observers' poles, ω / 2π
  /// Take the force along the terrain's normal from a foot force sensor, where there is one and it
  /// fits what the joints tell (FootSensorTrust). What is along the ground the joints tell.
  bool use_foot_sensor = false;
  SwingTareOptions tare = {};
};

/// How old samples are when they come [s].
struct JointDelays {
  double encoders = 0.0, torques = 0.0;
};

/// Ground forces on the feet and joint velocities, from encoders and joint torques alone.
///
/// A JointObserver compares the motion of each leg k with what Eq. (2) says without ground forces:
///
///     a = M_kk⁻¹ (τ − h − M_kb u̇_b)_k,    f_k = (J_kᵀ)⁻¹ M_kk d̂_k
///
/// less what a swinging leg's torques always lack (SwingTare). A second one, for the velocities,
/// takes the same a of legs in the air, and of legs that stand the one that keeps the foot where it
/// is, J_k a + J_kb u̇_b + J̇ u = 0: torques that the ground takes up don't move a joint. u̇_b is the
/// base's acceleration, the low-passed difference of the believed velocities. J_k is the 3×3 block
/// of the contact Jacobian of leg k, inverted with a damping that matters only near the straight
/// leg. Forces in W, of the ground on the foot [N]. Does not allocate.
class ContactForceEstimator {
 public:
  ContactForceEstimator(const ContactForceOptions& options, double period);

  /// First in a tick: takes encoders and joint torques in; joint velocities from the readings so
  /// far [rad/s]. The forces are those of the later of the two. `delays` of the samples, as usual.
  const JointVector& observe(const SensorReading& reading, const JointDelays& delays = {}) noexcept;

  /// Then, with the dynamics at the state: fills state.foot_force. `terrain_normal_W` is the unit
  /// normal as believed: a foot sensor gives the force along it. `stands` says which feet the plan
  /// lets carry.
  void update(const Dynamics& dynamics, const PerLeg<bool>& stands, const Vec3& terrain_normal_W,
              const SensorReading& reading, RobotState& state) noexcept;

 private:
  using BaseVector = Eigen::Matrix<double, 6, 1>;

  static constexpr std::size_t kKept = 8;  // ticks; sensors that are later are not believed
  /// The last few joint vectors, the newest first.
  struct Recent {
    std::array<JointVector, kKept> values;
    void start(const JointVector& value) { values.fill(value); }
    void add(const JointVector& value);
    [[nodiscard]] const JointVector& ago(int ticks) const;
  };

  [[nodiscard]] int periods_until(double time) const;
  /// In whole ticks, of what is kept.
  [[nodiscard]] int ticks_in(double delay) const;
  void follow(const JointDelays& delays);
  void update_base_acceleration(const GeneralizedVector& u);
  /// Of a leg's joints: in the air under the measured torques, and with the foot on the ground.
  [[nodiscard]] Vec3 free_acceleration(const Dynamics& dynamics, Leg leg,
                                       const JointVector& torque) const;
  [[nodiscard]] Vec3 stance_acceleration(const Dynamics& dynamics, Leg leg) const;
  /// M_kk d̂_k of all legs [N·m].
  [[nodiscard]] JointVector missing_torque(const Dynamics& dynamics) const;

  ContactForceOptions options_;
  double period_;
  JointObserver force_observer_, velocity_observer_;
  SwingTare tare_;
  PerLeg<FootSensorTrust> foot_sensors_;
  Recent angles_, torques_;
  int angle_delay_ = 0, force_delay_ = 0;  // of what the observers know [ticks]
  int torque_lag_ = 0;                     // behind the angles; negative: before them [ticks]
  double time_ = kNaN;                     ///< of the last reading [s]
  int periods_ = 0;                        ///< between the last two readings
  double periods_of_base_ =
      0.0;              ///< since its velocity was known; there are readings without a state
  bool begins_ = true;  ///< no update was since the first reading
  BaseVector base_velocity_ = BaseVector::Zero(), base_acceleration_ = BaseVector::Zero();
};

}  // namespace surefoot
