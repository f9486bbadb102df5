#pragma once

#include <algorithm>

namespace surefoot {

/// How fast a foot that searches goes on down: it waits where the foot stays behind its reference,
/// and at the end of the leg's reach.
class SearchPace {
 public:
  static constexpr double kReferenceLead = 0.02;  // the search waits for a foot further behind [m]

  /// One tick of `period` [s]. `behind`: of the foot from its reference along the normal [m];
  /// `reach_left` of the leg [m].
  void update(double behind, double reach_left, double period) {
    pace_ = behind > kReferenceLead ? 0.0 : std::clamp(reach_left / kSlowZone, 0.0, 1.0);
    stuck_for_ = std::max(0.0, stuck_for_ + (pace_ < kWaiting ? period : -period));
  }
  /// 1: at touchdown speed, 0: the search waits.
  [[nodiscard]] double pace() const { return pace_; }
  /// For so long that there is no ground within reach.
  [[nodiscard]] bool is_stuck() const { return stuck_for_ > kUnreachableAfter; }

 private:
  static constexpr double kSlowZone = 0.03;  // slows down this far before the end of the reach [m]
  static constexpr double kWaiting = 0.1;    // a pace below this is none
  static constexpr double kUnreachableAfter = 0.3;  // [s]

  double pace_ = 1.0;
  double stuck_for_ = 0.0;  // how long it has waited [s]
};

}  // namespace surefoot
