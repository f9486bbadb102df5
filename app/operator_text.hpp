#pragma once

#include "surefoot/logging/message_fields.hpp"
#include "surefoot/math/types.hpp"

#include <string>

namespace surefoot {

/// What the operator of a run did, in words: "the operator pushes base with 12 N·s to the left
/// (120 N for 0.1 s)", "friction 0.6 → 0.4, by the operator". Directions are those of the robot's
/// heading; left out where it is not known (NaN).
[[nodiscard]] std::string operator_text(const logged::Change& change, double yaw);

/// Which changes are told. A pull follows the operator's hand, up to 20 times a second: its begin
/// and its end are.
class ToldChanges {
 public:
  /// In the order of the log.
  [[nodiscard]] bool tells(const logged::Change& change);
  /// What the last pull gave up to its last change, ∫ |force| dt [N·s].
  [[nodiscard]] double given() const { return given_; }

 private:
  bool is_pulled_ = false;
  double force_ = 0.0, since_ = 0.0, given_ = 0.0;  // of the pull [N, s, N·s]
};

/// Where a force in W goes as the robot sees it: "forwards and to the left"; empty where it or the
/// heading is not known.
[[nodiscard]] std::string direction_text(const Vec3& force, double yaw);

}  // namespace surefoot
