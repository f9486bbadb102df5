#include "surefoot/control/checked_input.hpp"

#include "surefoot/base/formatted.hpp"
#include "surefoot/math/rotation.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::control {
namespace {

double clamp_finite(double value, double limit) {
  return std::isfinite(value) ? std::clamp(value, -limit, limit) : 0.0;
}

std::string what_is_wrong(const FootPlan& foot) {
  const bool is_finite = foot.p_WF.allFinite() && foot.v_WF.allFinite() && foot.a_WF.allFinite() &&
                         std::isfinite(foot.force_min + foot.force_max + foot.friction);
  if (!is_finite) return "NaN or infinity";
  if (foot.friction < 0.0) return formatted("friction %g below 0", foot.friction);
  if (foot.force_max < 0.0) return formatted("force_max %g N below 0", foot.force_max);
  if (foot.force_min > foot.force_max)
    return formatted("force_min %g N above force_max %g N", foot.force_min, foot.force_max);
  return {};
}

}  // namespace

UserCommand limited(const UserCommand& user) {
  UserCommand result = user;
  for (double& v : result.velocity) v = clamp_finite(v, UserCommand::kFastest);
  for (double& d : result.shift) d = clamp_finite(d, UserCommand::kMostHeight);
  result.yaw_rate = clamp_finite(user.yaw_rate, UserCommand::kFastest);
  result.height = clamp_finite(user.height, UserCommand::kMostHeight);
  const bool is_finite = user.velocity.allFinite() && user.shift.allFinite() &&
                         std::isfinite(user.yaw_rate) && std::isfinite(user.height);
  if (!is_finite) result.gait = UserCommand::kKeepGait;
  return result;
}

std::string what_is_wrong(const MotionPlan& plan, const model::RobotDescription& robot) {
  if (static_cast<int>(plan.feet.size()) != robot.num_legs())
    return "the planner's plan does not have the robot's number of feet";
  if (!std::isfinite(plan.time)) return "the planner's plan has NaN or infinity in its time";
  for (const Leg leg : plan.feet.legs()) {
    const std::string wrong = what_is_wrong(plan.feet[index(leg)]);
    if (!wrong.empty())
      return "the planner's plan has " + wrong + " in foot " +
             std::string(leg_name(leg, robot.num_legs()));
  }
  const auto is_at_first = [&](const FootPlan& foot) { return foot.p_WF == plan.feet[0].p_WF; };
  if (std::ranges::all_of(plan.feet, is_at_first))
    return "the planner's plan is empty: it has all feet at one place";
  const TorsoPlan& torso = plan.torso;
  const bool is_torso_known = torso.q_WB.coeffs().allFinite() && torso.w_WB.allFinite() &&
                              torso.wdot_WB.allFinite() && std::isfinite(torso.height) &&
                              std::isfinite(torso.height_rate + torso.height_acceleration);
  if (!is_torso_known) return "the planner's plan has NaN or infinity in the torso";
  if (!plan.com.p.allFinite() || !plan.com.v.allFinite() || !plan.com.a.allFinite())
    return "the planner's plan has NaN or infinity in the centre of mass";
  if (!is_rotation(Quat(plan.R_WC))) return "the planner's R_WC is no rotation";
  if (plan.joints.size() != 0 && plan.joints.size() != robot.num_joints())
    return "the planner's plan does not have the robot's number of joints";
  for (const FramePlan& frame : plan.frames) {
    if (frame.frame < 0) return "the planner's plan has a frame without a number";
    if (plan.frames.find(frame.frame) != &frame)
      return "the planner's plan has frame " + std::to_string(frame.frame) + " twice";
  }
  const auto is_frame_finite = [](const FramePlan& frame) {
    return frame.p_XF.allFinite() && frame.v_XF.allFinite() && frame.a_XF.allFinite() &&
           frame.w_XF.allFinite() && is_rotation(frame.q_XF);
  };
  if (!std::ranges::all_of(plan.frames, is_frame_finite) || !plan.joints.allFinite())
    return "the planner's plan has NaN or infinity in a frame or a joint";
  return {};
}

}  // namespace surefoot::control
