#pragma once

#include "surefoot/logging/log_header.hpp"

#include <optional>
#include <string>
#include <vector>

namespace surefoot {

/// A force from outside on a body of the robot, while it acts without a break: the truth's, that
/// no stage of control knows.
struct AppliedForce {
  std::size_t body = 0;           ///< its row of the truth's `xfrc_applied`
  double from = kNaN, to = kNaN;  ///< [s]; it acts on while `to` is NaN
  Vec3 force = Vec3::Zero();      ///< the largest so far, in W [N]
  Quat q_WB = Quat::Identity();   ///< of the base at that time
};

/// The forces in a tick's `xfrc_applied`, six numbers a body, the world's first; `from` is
/// `time`.
[[nodiscard]] std::vector<AppliedForce> applied_forces(double time, const std::vector<double>& xfrc,
                                                       const Quat& q_WB);

/// Follows the forces from outside, tick by tick.
class AppliedForceWatch {
 public:
  /// What has begun and ended. A begin is told with the second tick that has the force, as in the
  /// first one it may have acted for a part of its step alone; that of a force which the first tick
  /// of all has is not.
  struct Changes {
    std::vector<AppliedForce> begun, ended;
  };

  [[nodiscard]] Changes see(double time, const std::vector<double>& xfrc, const Quat& q_WB);
  /// That act now.
  [[nodiscard]] std::vector<AppliedForce> acting() const;

 private:
  struct Followed {
    AppliedForce force;
    bool is_told = false;
  };

  std::vector<Followed> followed_;
  std::optional<double> last_;  // time of the tick before
};

/// Names of the bodies by their row of `xfrc_applied`, the world's first, from the header's physics
/// model; empty without one.
[[nodiscard]] std::vector<std::string> body_names(const LogHeader& header);

/// Angle of a force in the plane from the robot's heading [rad], positive to its left; NaN of one
/// that stands on the plane.
[[nodiscard]] double angle_from_ahead(const AppliedForce& force);

/// "50 N, 90° from ahead to the left, on the base".
[[nodiscard]] std::string applied_force_text(const AppliedForce& force,
                                             const std::vector<std::string>& bodies);
/// "the base" is the first of all, others have their name.
[[nodiscard]] std::string body_text(std::size_t body, const std::vector<std::string>& bodies);

}  // namespace surefoot
