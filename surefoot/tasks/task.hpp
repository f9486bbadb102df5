#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/model/dynamics.hpp"
#include "surefoot/model/support_dynamics.hpp"
#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/solver/hierarchy.hpp"

#include <string>
#include <string_view>

namespace surefoot {

/// What the tasks see of one tick.
struct TaskInput {
  const Dynamics& dynamics;
  const MotionPlan& plan;
  const SupportDynamics& support;  ///< of the same dynamics and plan
  const RobotDescription& robot;
};

/// One objective or limit, as rows over x = (u̇, τ) (Eq. 14). A task is immutable: the same input
/// gives the same rows.
class Task {
 public:
  virtual ~Task() = default;

  /// Appends this tick's rows. Does not allocate; all rows fit in `max_rows()`.
  virtual void write(const TaskInput& input, Level& level) const noexcept = 0;

  /// Most rows that a tick can have.
  [[nodiscard]] virtual int max_rows() const = 0;
  /// The name that stack files use.
  [[nodiscard]] virtual std::string_view name() const = 0;
  /// Row ids are 0 … num_ids() − 1. They stay with their leg when others lift off or touch down.
  [[nodiscard]] virtual int num_ids() const { return max_rows(); }
  /// What the row of an id is: "LF normal force".
  [[nodiscard]] virtual std::string row_name(int id) const = 0;

  /// Where several tasks share a level: added to every id that this task writes, set once at
  /// set-up.
  void set_first_id(int id) { first_id_ = id; }
  [[nodiscard]] int first_id() const { return first_id_; }

 protected:
  Task() = default;
  Task(const Task&) = default;
  Task& operator=(const Task&) = default;

 private:
  int first_id_ = 0;
};

/// "LF x", "LF y", "LF z", "RF x", … for ids that count three rows a leg.
[[nodiscard]] std::string leg_axis_name(int id);
/// "LF_HAA", "LF_HFE", … for ids that count joints.
[[nodiscard]] std::string joint_name(int id);

}  // namespace surefoot
