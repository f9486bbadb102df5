#pragma once

#include "surefoot/gaits/parts/pose_filter.hpp"
#include "surefoot/model/frames.hpp"
#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/signals/user_command.hpp"

#include <vector>

namespace surefoot::gaits {

/// References of the frames that tasks follow, and of the joints, where a planner gives none: each
/// frame is held where it is at the first tick, in B or W, and goes by a `PoseFilter` to where the
/// user wants it.
class FrameReferences {
 public:
  /// `period` of the control loop [s], `scale` of the robot.
  FrameReferences(double period, const Scale& scale) : start_(period, scale) {}

  /// Between two ticks: which frames are followed, each once. Those that were go on. Allocates.
  void follow(const std::vector<model::FollowedFrame>& frames, bool follows_joints);

  /// One tick: adds to the plan what it lacks. Does not allocate.
  void complete(MotionPlan& plan, const ReachCommand& command,
                const model::Dynamics& dynamics) noexcept;

 private:
  struct Reference {
    model::FollowedFrame frame;
    PoseFilter pose;  // in X
    bool in_world = false, has_begun = false;
    Vec3 position = Vec3::Zero(), orientation = Vec3::Constant(kNaN);  // wanted, in X
  };

  static FramePlan update(Reference& reference, const ReachCommand& command,
                          const model::Dynamics& dynamics);

  PoseFilter start_;
  std::vector<Reference> references_;
  bool follows_joints_ = false;
  JointVector joints_{};  // at first; empty before
};

}  // namespace surefoot::gaits
