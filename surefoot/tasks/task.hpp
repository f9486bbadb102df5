#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/model/dynamics.hpp"
#include "surefoot/model/frames.hpp"
#include "surefoot/model/support_dynamics.hpp"
#include "surefoot/signals/joint_name.hpp"
#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/solver/hierarchy.hpp"

#include <string>
#include <string_view>

namespace surefoot::tasks {

/// Inputs of the tasks at one tick.
struct TaskInput {
  const model::Dynamics& dynamics;
  const MotionPlan& plan;
  const model::SupportDynamics& support;  ///< of the same dynamics and plan
  const model::RobotDescription& robot;
};

/// One objective or limit, as rows over x = (u̇, τ) (Eq. 14): first the accelerations, then the
/// torques of all joints. Immutable: the same input gives the same rows. Derive one of your own,
/// add it to `OwnTasks`, and stacks can name it; `check_task` finds what it does wrong.
class Task {
 public:
  virtual ~Task() = default;

  /// Appends this tick's rows, at most `max_rows()`, with ids from `first_id()` on. Must not
  /// allocate. If it throws, or writes rows that can't be solved, the controller holds its posture,
  /// then sits down.
  virtual void write(const TaskInput& input, solver::Level& level) const = 0;

  static constexpr int kMostRows = 1000;
  /// Largest number of rows in a tick, up to `kMostRows`.
  [[nodiscard]] virtual int max_rows() const = 0;
  /// The name in stack files.
  [[nodiscard]] virtual std::string_view name() const = 0;
  /// Row ids are 0 … num_ids() − 1. They stay with their leg when other contacts change.
  [[nodiscard]] virtual int num_ids() const { return max_rows(); }
  /// The name of a row: "LF normal force".
  [[nodiscard]] virtual std::string row_name(int id) const = 0;

  /// Tells the task its robot, once at set-up. Throws Error if the task can't be the robot's.
  void prepare(const model::RobotDescription& robot);
  /// The frame for which the plan shall have a reference, once the task is prepared.
  [[nodiscard]] virtual model::FollowedFrame follows() const { return {}; }
  /// Shall the plan have a reference of the joints?
  [[nodiscard]] virtual bool follows_joints() const { return false; }

  /// Offset of this task's ids in a level shared by several tasks; set once at set-up.
  void set_first_id(int id) { first_id_ = id; }
  [[nodiscard]] int first_id() const { return first_id_; }

 protected:
  Task() = default;
  Task(const Task&) = default;
  Task& operator=(const Task&) = default;

  /// What else the task finds out about its robot, at the end of `prepare`.
  virtual void find_parts(const model::RobotDescription&) {}

  [[nodiscard]] int num_legs() const { return num_legs_; }
  [[nodiscard]] int num_joints() const { return static_cast<int>(joints_.size()); }
  [[nodiscard]] int num_leg_joints() const { return num_leg_joints_; }
  /// A flat foot's contact has six rows, a sphere's three.
  [[nodiscard]] bool has_flat_feet() const { return has_flat_feet_; }
  /// "LF_HAA", "LF_HFE", … for an id per joint, as in messages.
  [[nodiscard]] std::string joint_name(int id) const;
  /// "LF" …
  [[nodiscard]] std::string leg_name(int leg) const;
  /// "LF x", "LF y", "LF z", "RF x", … for three ids a leg.
  [[nodiscard]] std::string leg_axis_name(int id) const;

 private:
  int num_legs_ = kNumLegs;
  int num_leg_joints_ = kNumLegJoints;
  bool has_flat_feet_ = false;
  std::vector<std::string> joints_ = told_joints(std::vector<std::string>(kNumLegJoints), kNumLegs);
  int first_id_ = 0;
};

}  // namespace surefoot::tasks
