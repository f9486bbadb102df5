#pragma once

#include "surefoot/math/types.hpp"
#include "surefoot/signals/bounded_list.hpp"

namespace surefoot {

/// Reference of a frame F of the robot in X, which is the base B or W.
struct FramePlan {
  int frame = -1;         ///< its place in `model::Frames`
  bool in_world = false;  ///< X is W
  Vec3 p_XF = Vec3::Zero();
  Vec3 v_XF = Vec3::Zero();
  Vec3 a_XF = Vec3::Zero();
  Quat q_XF = Quat::Identity();
  Vec3 w_XF = Vec3::Zero();  ///< in X [rad/s]
};

/// References of some frames, one each.
struct FrameList : BoundedList<FramePlan, 6> {
  /// Null if the list has none of this frame.
  [[nodiscard]] const FramePlan* find(int frame) const {
    for (const FramePlan& plan : *this)
      if (plan.frame == frame) return &plan;
    return nullptr;
  }
};

}  // namespace surefoot
