#include "surefoot/gaits/parts/frame_reference.hpp"

#include <algorithm>
#include <utility>

namespace surefoot::gaits {

void FrameReferences::follow(const std::vector<model::FollowedFrame>& frames, bool follows_joints) {
  std::vector<Reference> next;
  for (const model::FollowedFrame& frame : frames) {
    const auto before = std::ranges::find(references_, frame.number,
                                          [](const Reference& r) { return r.frame.number; });
    next.push_back(before != references_.end()
                       ? *before
                       : Reference{.frame = frame, .pose = start_, .in_world = frame.in_world});
  }
  references_ = std::move(next);
  if (!follows_joints) joints_.resize(0);
  follows_joints_ = follows_joints;
}

void FrameReferences::complete(MotionPlan& plan, const ReachCommand& command,
                               const model::Dynamics& dynamics) noexcept {
  for (Reference& reference : references_) {
    const FramePlan made = update(reference, command, dynamics);
    if (plan.frames.find(made.frame) == nullptr) plan.frames.add(made);
  }
  if (!follows_joints_) return;
  if (joints_.size() == 0) joints_ = dynamics.q;
  if (plan.joints.size() == 0) plan.joints = joints_;
}

FramePlan FrameReferences::update(Reference& reference, const ReachCommand& command,
                                  const model::Dynamics& dynamics) {
  const bool is_asked = command.frame == reference.frame.number && command.position.allFinite();
  const bool changes = is_asked && command.in_world != reference.in_world;
  if (changes) reference.in_world = command.in_world;
  const model::FrameKinematics now = frame_kinematics(reference.frame.at, dynamics);
  const model::BodyKinematics& base = dynamics.bodies.front();
  const bool in_world = reference.in_world;
  const Mat3 to_X = in_world ? Mat3(Mat3::Identity()) : Mat3(base.R.transpose());
  const Vec3 p = to_X * (in_world ? now.point.p : Vec3(now.point.p - base.p));
  const Quat q(to_X * now.rotation.R);
  if (!reference.has_begun || changes) {
    reference.position = p;
    reference.orientation.setConstant(kNaN);
    reference.pose.begin(p, Vec3::Zero(), q);
    reference.has_begun = true;
  }
  if (is_asked) {
    reference.position = command.position;
    reference.orientation = command.orientation;
  }
  reference.pose.update(reference.position, reference.orientation);
  if (is_asked) reference.pose.wait_for(p, q);
  const PoseFilter& pose = reference.pose;
  return {.frame = reference.frame.number,
          .in_world = reference.in_world,
          .p_XF = pose.position().p,
          .v_XF = pose.position().v,
          .a_XF = pose.position().a,
          .q_XF = pose.orientation(),
          .w_XF = pose.angular_velocity()};
}

}  // namespace surefoot::gaits
