#pragma once

#include "surefoot/estimation/invariant_filter.hpp"
#include "surefoot/estimation/standing_start.hpp"
#include "surefoot/estimation/state_estimator.hpp"
#include "surefoot/model/description.hpp"
#include "surefoot/model/leg_chain.hpp"
#include "surefoot/model/limb_chain.hpp"

namespace surefoot {
struct Group;
}  // namespace surefoot

namespace surefoot::estimation {

struct LegInertialOptions {
  InvariantFilterOptions filter;
  double foot_walk = 4e-4, loose_foot_walk = 0.3;
  /// Leg errors of millimetres and milliradians turn a robot by 3 mrad a metre, by the same each
  /// stride. As independent noise, a hundred footholds (a minute, in which a gyroscope's bias
  /// wanders as far) must count as one: so ten times as much. If it is too small, a walk's legs
  /// disturb the gyroscope bias found while standing.
  double stance_turn = 0.03;
  double trust_time = 0.08, trust_force = 30.0;
  bool predict = true;
};

/// Their names, units, ranges and help.
[[nodiscard]] Group fields(LegInertialOptions& o);

/// Base state from IMU, encoders and stance feet, by an InvariantFilter.
///
/// Feet enter and leave softly: shortly after touchdown, or with little load, a foot may walk. A
/// turning foot sphere rolls: its centre moves by Δφ × r n, with Δφ the turn of the shank since the
/// last tick, r the radius and n the vertical. The filter uses joint velocities only for the start
/// (StandingStart): at the first reading of a robot at rest, or while swaying after standing for
/// 0.1 s. Position and heading begin at 0, with the feet's mean lowest point at z = 0; a restart
/// (TickContext) keeps them and discards the rest. Off its feet the base counts as at rest, level
/// by the accelerometer's last tenth of a second, and turns by the gyroscope about the vertical
/// alone; its height puts its feet on the ground that they left. Samples come late, by known times;
/// with `predict` the state continues from them to now,
///
///     q += q̇ τ_q,   R ← R exp(S(ω) τ),   p += v τ,   v += a τ
///
/// with τ_q the joints' and τ the IMU's delay, and a the mean acceleration of the last hundredth of
/// a second, which smooths touchdowns. Does not allocate after construction.
class LegInertialEstimator final : public StateEstimator {
 public:
  /// Throws Error if the URDF can't be read, and on a period that is none. `period` of the control
  /// loop [s].
  LegInertialEstimator(const model::RobotDescription& robot, const LegInertialOptions& options,
                       double period);

  [[nodiscard]] const RobotState& update(const SensorReading& reading,
                                         const TickContext& context) noexcept override;
  void restart() noexcept override;
  bool is_own() const noexcept override { return false; }

  [[nodiscard]] const InvariantFilter& filter() const { return filter_; }

 private:
  struct Foot {
    Vec3 p_BF = Vec3::Zero();
    Mat3 J = Mat3::Zero();         // ∂p_BF/∂q of its leg, or a square root of J Jᵀ [m]
    Mat3 R_BK = Mat3::Identity();  // shank
    Vec3 roll = Vec3::Zero();      // of the sphere since the last tick, in W [m]
    Vec3 shift = Vec3::Zero();     // of its estimate, from a corrected leg length, in W [m]
    double stands_for = 0.0;       // [s]
    double radius = 0.0;           // [m]
  };

  /// One tick before the start.
  [[nodiscard]] bool stands(const SensorReading& reading,
                            const JointVector& joint_velocity) noexcept;
  /// One tick of a robot off its feet.
  void hang(const SensorReading& reading, double dt);
  [[nodiscard]] StandingStart::State state_at_restart() const;
  void start(const SensorReading& reading, const StandingStart::State& standing, double heading);
  void stand_at(const Vec3& p_WB);
  /// Mean height of the base above the ground at the feet [m].
  [[nodiscard]] double height_over_feet() const;
  void advance(const SensorReading& reading, double dt, bool is_finite);
  void reset_distance();
  void add_turn_uncertainty();
  void take_over(const KinematicErrors& errors, const JointVector& q);
  void take_further_joints(const JointVector& q) noexcept;
  void update_kinematics(const SensorReading& reading);
  /// Position, Jacobian and axes of a foot in B.
  void place(Leg leg, const JointVector& q, Foot& foot) const;
  void update_foot(Leg leg, const FootContact& contact, double dt);
  [[nodiscard]] double walk(const Foot& foot, const FootContact& contact) const;
  void write_joints(const SensorReading& reading, const TickContext& context);
  void write_base(const SensorReading& reading, const KinematicErrors& errors);
  void predict(const TickContext& context);

  LegInertialOptions options_;
  double period_;
  Eigen::Index num_joints_;
  PerLeg<model::LegChain> described_, chains_;  // of the URDF, and as estimated
  std::vector<model::LimbChain> limbs_;         // instead, of a robot that only stands
  KinematicErrors errors_;
  InvariantFilter filter_;
  PerLeg<Foot> feet_;
  Vec3 gyro_before_ = Vec3::Zero();  // at the last tick, in B [rad/s]
  // Means of the last tenth of a second, in B [rad/s], [m/s²]; of the last hundredth.
  Vec3 mean_gyro_ = Vec3::Zero(), mean_force_ = Vec3::Zero(), recent_force_ = Vec3::Zero();
  Mat3 R_WB_before_ = Mat3::Identity();
  Vec3 p_WB_planted_ = Vec3::Zero();  // at the last touchdown [m]
  double farthest_ = 0.0;             // the base's largest distance from there [m]
  RobotState state_;
  bool started_ = false;
  bool hung_ = false;       // at the last tick
  bool has_stood_ = false;  // so the gyroscope's bias is known
  StandingStart standing_start_;
  model::BodyTree tree_;
};

}  // namespace surefoot::estimation
