#include "surefoot/tasks/frame_task.hpp"

#include "surefoot/base/error.hpp"

namespace surefoot::tasks {
namespace {

FramePlan in_world(const ArmPlan& arm) {
  return {.in_world = true,
          .p_XF = arm.p_WT,
          .v_XF = arm.v_WT,
          .a_XF = arm.a_WT,
          .q_XF = arm.q_WT,
          .w_XF = arm.w_WT};
}

}  // namespace

void FrameTask::find_parts(const model::RobotDescription& robot) {
  if (name_.empty()) {
    if (!robot.arms.empty()) return;
    throw Error(
        std::string(name()) + ": no frame is given, and the robot " + robot.name +
        " has no arm whose tip could be meant; valid is the name of a link or joint, as \"" +
        robot.base_link + "\"");
  }
  const model::Frames frames(robot);
  const int number = frames.number(name_);
  frame_ = {.number = number, .in_world = held_in_ == HeldIn::world, .at = frames[number]};
}

std::optional<FrameTask::Motion> FrameTask::motion(const TaskInput& input) const noexcept {
  if (frame_.number < 0) {
    const ArmPlan& arm = input.plan.arm;
    const bool reaches = arm.arm >= 0 && arm.arm < static_cast<int>(input.dynamics.arm_tips.size());
    if (!reaches) return std::nullopt;
    return Motion{input.dynamics.arm_tips[static_cast<std::size_t>(arm.arm)], in_world(arm)};
  }
  const FramePlan* plan = input.plan.frames.find(frame_.number);
  Motion motion{frame_kinematics(frame_.at, input.dynamics), {}};
  const bool is_in_world = plan == nullptr ? frame_.in_world : plan->in_world;
  if (!is_in_world) motion.now = relative_to_base(motion.now, input.dynamics);
  motion.reference.p_XF = motion.now.point.p;
  motion.reference.q_XF = Quat(motion.now.rotation.R);
  if (plan != nullptr) motion.reference = *plan;
  return motion;
}

}  // namespace surefoot::tasks
