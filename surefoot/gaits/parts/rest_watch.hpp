#pragma once

#include "surefoot/signals/robot_state.hpp"

#include <algorithm>

namespace surefoot {

/// Since when a robot has stood on all feet without going anywhere.
class RestWatch {
 public:
  /// One tick. `stands`: the gait lets all feet stand, and they do.
  void update(const RobotState& state, bool stands) {
    if (!stands) stands_from_ = state.time;
    if (!(state.v_WB.norm() < kStill)) rests_from_ = state.time;
  }
  /// For 1 s, and it does not turn.
  [[nodiscard]] bool is_at_rest(const RobotState& state) const {
    return state.time > std::max(stands_from_, rests_from_) + kDuration &&
           state.w_WB_B.norm() < kStill;
  }

 private:
  static constexpr double kStill = 0.02;         // [m/s] and [rad/s]
  static constexpr double kDuration = 1.0;       // [s]
  double stands_from_ = 0.0, rests_from_ = 0.0;  // [s]
};

}  // namespace surefoot
