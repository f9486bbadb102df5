#pragma once

#include "surefoot/signals/base_load.hpp"
#include "surefoot/signals/hierarchy_report.hpp"
#include "surefoot/signals/joint_command.hpp"
#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/signals/robot_state.hpp"
#include "surefoot/signals/sensor_health.hpp"
#include "surefoot/signals/sensor_reading.hpp"
#include "surefoot/signals/user_command.hpp"

#include <array>
#include <limits>

namespace surefoot {

/// The controller's model at one tick, at the estimated state, in W. NaN if nothing was solved.
struct ModelRecord {
  Vec3 p_WCom = Vec3::Zero();  ///< centre of mass [m]
  Vec3 v_WCom = Vec3::Zero();
  PerLeg<Vec3> p_WF = per_leg<Vec3>(Vec3::Zero());   ///< foot sphere centres
  PerLeg<Vec3> p_WH = per_leg<Vec3>(Vec3::Zero());   ///< hips
  PerLeg<Vec3> force = per_leg<Vec3>(Vec3::Zero());  ///< λ of the solution [N]
  BaseLoad load;                                     ///< payload of the base
};

/// One complete tick of the control loop. A controller that gets the same readings, commands and
/// estimated base states from the start computes the same ticks again.
struct TickRecord {
  SensorReading reading;  ///< as it came
  SensorHealth health;    ///< of the reading
  UserCommand user;
  RobotState state;
  MotionPlan plan;
  ModelRecord model;
  HierarchyReport hierarchy;
  JointCommand command;
};

/// Gives all joint vectors of a tick the robot's size; those of another become NaN. And all lists
/// of legs.
inline void size_joints(TickRecord& tick, Eigen::Index num_joints, int num_legs = kNumLegs) {
  for (JointVector* joints : {&tick.reading.q, &tick.reading.torque, &tick.state.q, &tick.state.qd,
                              &tick.state.torque, &tick.command.torque}) {
    if (joints->size() != num_joints) joints->setConstant(num_joints, kNaN);
  }
  tick.reading.foot_force.resize(num_legs);
  tick.state.size_legs(num_legs);
  tick.plan.feet.resize(num_legs);
  for (PerLeg<Vec3>* vectors : {&tick.model.p_WF, &tick.model.p_WH, &tick.model.force})
    vectors->resize(num_legs);
}

/// Wall-clock time of levels [µs]; NaN: not measured.
using LevelTimes = std::array<float, kMaxLevels>;
inline constexpr LevelTimes kNoLevelTimes = [] {
  LevelTimes times{};
  times.fill(std::numeric_limits<float>::quiet_NaN());
  return times;
}();

/// Wall-clock time of the stages of one tick [µs]; apart from TickRecord, which is deterministic.
struct TickTiming {
  double time = 0.0;  ///< of the tick [s]
  double estimate = 0.0;
  double plan = 0.0;
  double model = 0.0;
  double stack = 0.0;
  double solve = 0.0;
  double total = 0.0;
  /// Of `solve`, in the order of the tick's hierarchy; work shared by levels counts in none.
  LevelTimes levels = kNoLevelTimes;
};

}  // namespace surefoot
