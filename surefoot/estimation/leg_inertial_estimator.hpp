#pragma once

#include "surefoot/estimation/invariant_filter.hpp"
#include "surefoot/estimation/standing_start.hpp"
#include "surefoot/estimation/state_estimator.hpp"
#include "surefoot/model/description.hpp"
#include "surefoot/model/leg_chain.hpp"

namespace surefoot {

struct LegInertialOptions {
  InvariantFilterOptions filter;
  /// Of a foot that stands firmly: soft ground creeps by some 0.2 mm/s under a walking robot
  /// [m/√s].
  double foot_walk = 4e-4;
  double loose_foot_walk = 0.3;  ///< … of one that hardly touches, or slides [m/√s]
  /// By how much the standing feet may seem to turn together about the vertical where the base goes
  /// over them, between one foothold and the next [rad/m]. Legs of which millimetres and
  /// milliradians are not known turn a robot by 3 mrad a metre, each stride by the same; taken as
  /// chance between footholds, a hundred of them (a minute, in which a gyroscope's bias wanders as
  /// far) must say as little as one: ten times as much. Taken too small, a walk's legs move the
  /// bias that the gyroscope was found to have while the robot stood.
  double stance_turn = 0.03;
  double trust_time = 0.08;   ///< after a touchdown until a foot is trusted fully [s]
  double trust_force = 30.0;  ///< normal force from which on it is [N]
  bool predict = true;        ///< the state is of now; otherwise of when the samples were taken
};

/// Base state from the IMU, the encoders and the feet that stand: an InvariantFilter, fed.
///
/// Feet enter and leave softly: a foot that has just come down, or that carries little, may walk.
/// A foot's sphere that turns rolls: its centre moves by Δφ × r n, with Δφ the turn of the shank
/// since the last tick, r the radius and n the vertical. The filter takes no joint
/// velocities, but for the start (StandingStart): at the first reading of a robot at rest, or in
/// the sway of one that has stood for 0.1 s. Position and heading begin at 0, with the feet's
/// lowest points at z = 0 in the mean; a restart (TickContext) keeps them and forgets the rest.
/// Off its feet the base is taken to rest where it was, level as the last tenth of a second of the
/// accelerometer says, and to turn as the gyroscope says about the vertical alone; its height is
/// such that its feet would stand on the ground that they left.
/// Samples come late, by times that readings tell; with `predict` the state goes on from them to
/// now as it moves,
///
///     q += q̇ τ_q,   R ← R exp(S(ω) τ),   p += v τ,   v += a τ
///
/// with τ_q the joints' and τ the IMU's delay, and a the mean acceleration of the last hundredth of
/// a second, as the spikes of a touchdown do not last. Does not allocate after construction.
class LegInertialEstimator final : public StateEstimator {
 public:
  /// Throws Error where the URDF can't be read. `period` of the control loop [s].
  LegInertialEstimator(const RobotDescription& robot, const LegInertialOptions& options,
                       double period);

  [[nodiscard]] const RobotState& update(const SensorReading& reading,
                                         const TickContext& context) noexcept override;
  void begin_anew() noexcept override;

  [[nodiscard]] const InvariantFilter& filter() const { return filter_; }

 private:
  struct Foot {
    Vec3 p_BF = Vec3::Zero();
    Mat3 J = Mat3::Zero();         // ∂p_BF/∂q of its leg [m]
    Mat3 R_BS = Mat3::Identity();  // shank
    Vec3 roll = Vec3::Zero();      // of the sphere since the last tick, in W [m]
    Vec3 shift = Vec3::Zero();     // of where it is believed, by a leg found longer, in W [m]
    double stands_for = 0.0;       // [s]
  };

  /// One tick before the start.
  [[nodiscard]] bool stands(const SensorReading& reading,
                            const JointVector& joint_velocity) noexcept;
  /// One tick of a robot that is not on its feet.
  void hang(const SensorReading& reading, double dt);
  void start(const SensorReading& reading, const StandingStart::State& standing, double heading);
  void stand_at(const Vec3& p_WB);
  /// Of the base over the ground under the feet, in their mean [m].
  [[nodiscard]] double height_over_feet() const;
  void advance(const SensorReading& reading, double dt, bool is_finite);
  void start_way();
  void doubt_turn();
  void take_over(const KinematicErrors& errors, const JointVector& q);
  void see_feet(const SensorReading& reading);
  void update_foot(Leg leg, const FootContact& contact, double dt);
  [[nodiscard]] double walk(const Foot& foot, const FootContact& contact) const;
  void write_joints(const SensorReading& reading, const TickContext& context);
  void write_base(const SensorReading& reading);
  void predict(const TickContext& context);

  LegInertialOptions options_;
  double period_;
  double foot_radius_;
  PerLeg<LegChain> described_, chains_;  // of the URDF, and as they are believed to be
  KinematicErrors errors_;
  InvariantFilter filter_;
  PerLeg<Foot> feet_{};
  Vec3 gyro_before_ = Vec3::Zero();  // at the last tick, in B [rad/s]
  // Of the last tenth of a second, in B [rad/s], [m/s²]; of the last hundredth.
  Vec3 mean_gyro_ = Vec3::Zero(), mean_force_ = Vec3::Zero(), recent_force_ = Vec3::Zero();
  Mat3 R_WB_before_ = Mat3::Identity();
  Vec3 p_WB_planted_ = Vec3::Zero();  // as the last foot was planted [m]
  double way_ = 0.0;                  // the furthest that the base has been from there [m]
  RobotState state_;
  bool started_ = false;
  StandingStart standing_start_;
};

}  // namespace surefoot
