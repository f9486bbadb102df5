#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/gaits/parts/leg_limits.hpp"
#include "surefoot/signals/user_command.hpp"

namespace surefoot::gaits {

/// The strides that the legs can make about the nominal stance. A foot makes one step per cycle, so
/// its stride is velocity × cycle. Hips are relative to the torso's centre, in heading axes [m].
class Strides {
 public:
  /// `scale` of the robot.
  explicit Strides(const PlannerOptions& options, const Scale& scale = {})
      : stance_(options.stance),
        foothold_(options.foothold),
        swing_(options.swing),
        swing_duration_(options.gait.swing_duration),
        length_(scale.length) {}

  void use(const PlannerOptions& options) {
    stance_ = options.stance;
    foothold_ = options.foothold;
    swing_ = options.swing;
    swing_duration_ = options.gait.swing_duration;
  }

  /// Share of the commanded velocity, at most 1, that the strides of all legs allow with the hips
  /// at a `height` over the feet [m]:
  ///
  ///     (stride_x / longest)² + (stride_y / aside)² ≤ 1
  ///
  /// with `aside` at most `max_side_step` and `max_side_stride`, `longest` at most `max_step`,
  /// `max_stride`, `speed_max` × swing duration, and twice the distance from the foot's nominal
  /// place to the end of the leg's reach.
  [[nodiscard]] double feasible_share(const UserCommand& user, const PerLeg<Vec2>& hips,
                                      double height, double cycle_duration) const;

  /// Greatest height of the hips over the feet at which the legs reach both ends of their strides
  /// while the hips sway [m]. Strides are centred on the nominal places.
  [[nodiscard]] double tallest(const UserCommand& user, const PerLeg<Vec2>& hips,
                               double cycle_duration) const;

  /// Share of a yaw rate, at most 1, that the stance feet allow until they step. In a steady turn
  /// the heading leads the feet by up to 0.15 cycles of the turn, and the feet are up to 3/8 of
  /// their stride beside their nominal places. The share is 0 at twice this lead, or at 1.5 times
  /// this distance.
  [[nodiscard]] double turning_share(double yaw_rate, const PerLeg<Vec3>& footholds,
                                     const PerLeg<bool>& down, double yaw,
                                     double cycle_duration) const;
  /// Is a steady turn slower than commanded, as the feet, half a stride behind when they step, slow
  /// the heading down?
  [[nodiscard]] bool turns_slower(double yaw_rate, double cycle_duration) const;

 private:
  /// In heading axes [m].
  [[nodiscard]] static Vec2 stride(const Vec2& foot, const UserCommand& user,
                                   double cycle_duration);
  /// Largest sideways lag of a stance foot in a turn to `side`, 1 or −1 [m].
  [[nodiscard]] double side_lag(double side, const PerLeg<Vec3>& footholds,
                                const PerLeg<bool>& down, double yaw) const;

  StanceOptions stance_;
  FootholdOptions foothold_;
  SwingOptions swing_;
  double swing_duration_;  // [s]
  double length_;          // scale of lengths
};

}  // namespace surefoot::gaits
