#pragma once

#include "surefoot/math/types.hpp"

#include <array>
#include <cstddef>

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

/// References of some frames, one each; further ones than kMost are left out.
struct FrameList {
  static constexpr std::size_t kMost = 6;
  using value_type = FramePlan;

  std::array<FramePlan, kMost> items{};
  std::size_t count = 0;

  void add(const FramePlan& plan) {
    if (count < kMost) items[count++] = plan;
  }
  [[nodiscard]] const FramePlan* begin() const { return items.data(); }
  [[nodiscard]] const FramePlan* end() const { return items.data() + count; }
  /// Null if the list has none of this frame.
  [[nodiscard]] const FramePlan* find(int frame) const {
    for (const FramePlan& plan : *this)
      if (plan.frame == frame) return &plan;
    return nullptr;
  }
};

}  // namespace surefoot
