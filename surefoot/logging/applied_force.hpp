#pragma once

#include "surefoot/logging/log_header.hpp"

#include <optional>
#include <string>
#include <vector>

namespace surefoot::logging {

/// An external force on a body of the robot over an uninterrupted time; true, unknown to control.
struct AppliedForce {
  std::size_t body = 0;           ///< its row of the truth's `xfrc_applied`
  double from = kNaN, to = kNaN;  ///< [s]; `to` is NaN while it acts
  Vec3 force = Vec3::Zero();      ///< the largest so far, in S [N]
  Quat q_SB = Quat::Identity();   ///< base orientation at that time
};

/// The forces in a tick's `xfrc_applied`, six numbers a body, the world's first; `from` is `time`.
[[nodiscard]] std::vector<AppliedForce> applied_forces(double time, const std::vector<double>& xfrc,
                                                       const Quat& q_SB);

/// Follows external forces, tick by tick.
class AppliedForceWatch {
 public:
  /// New and ended forces. A force counts as begun at its second tick, because it may cover only
  /// part of its first step. A force at the very first tick is not reported.
  struct Changes {
    std::vector<AppliedForce> begun, ended;
  };

  [[nodiscard]] Changes see(double time, const std::vector<double>& xfrc, const Quat& q_SB);
  /// Forces that act now.
  [[nodiscard]] std::vector<AppliedForce> acting() const;

 private:
  struct Followed {
    AppliedForce force;
    bool is_reported = false;
  };

  std::vector<Followed> followed_;
  std::optional<double> last_;  // time of the tick before
};

/// Body names by row of `xfrc_applied`, the world's first, from the header's physics model; empty
/// without one.
[[nodiscard]] std::vector<std::string> body_names(const LogHeader& header);

/// Angle of a force from the robot's heading in the horizontal plane [rad], positive to its left;
/// NaN for a vertical force.
[[nodiscard]] double angle_from_ahead(const AppliedForce& force);

/// "50 N, 90° from ahead to the left, on the base".
[[nodiscard]] std::string applied_force_text(const AppliedForce& force,
                                             const std::vector<std::string>& bodies);
/// "pushed by 50 N, …".
[[nodiscard]] std::string push_text(const AppliedForce& force,
                                    const std::vector<std::string>& bodies);
/// "the push on the base ends".
[[nodiscard]] std::string push_end_text(const AppliedForce& force,
                                        const std::vector<std::string>& bodies);
/// "the base" for the first body, the name for others.
[[nodiscard]] std::string body_text(std::size_t body, const std::vector<std::string>& bodies);

}  // namespace surefoot::logging
