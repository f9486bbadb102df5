#pragma once

#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/signals/robot_state.hpp"

#include <random>

namespace surefoot::test {

/// Seeded random numbers for the states and plans of a test.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  [[nodiscard]] double uniform(double low, double high);
  [[nodiscard]] Vec3 vector(double bound);  ///< every component within ±bound
  [[nodiscard]] Quat rotation();            ///< uniform
  [[nodiscard]] Quat small_rotation(double bound);

  /// Anywhere, any orientation, joints within ±2 rad of 0, everything moving.
  [[nodiscard]] RobotState state();
  /// Anywhere, any orientation, joints within ±0.3 rad of a posture, everything moving.
  [[nodiscard]] RobotState state_around(const JointVector& posture);
  /// Standing roughly upright around a posture, everything moving a little.
  [[nodiscard]] RobotState standing_state(const JointVector& posture);

 private:
  std::mt19937_64 engine_;
};

/// The state after moving by u for a time, to first order in the orientation's own coordinates:
/// exact for constant u. The velocity stays.
[[nodiscard]] RobotState moved(const RobotState& state, const GeneralizedVector& u, double time);

/// At rest with all knees straight and every foot exactly below its HAA axis (ANYmal B): each leg
/// can carry a vertical force without any joint torque, so four of them share the weight in a way
/// that no motion tells apart, and the stacked contact Jacobian of point feet has rank 11 of 12.
[[nodiscard]] RobotState straight_legged_state();

/// A plan that leaves the given legs in contact and sends the others to where they are.
[[nodiscard]] MotionPlan plan_with_contacts(const PerLeg<bool>& contacts);

/// All 16 sets of legs in contact.
[[nodiscard]] std::array<PerLeg<bool>, 16> all_contact_sets();

}  // namespace surefoot::test
