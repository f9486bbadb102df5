#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/gaits/parts/leg_limits.hpp"
#include "surefoot/signals/user_command.hpp"

namespace surefoot::gaits {

/// What strides the legs can make about the nominal stance. A foot makes one step a cycle, so its
/// stride is velocity × cycle. Hips are about the torso's centre, in heading axes [m].
class Strides {
 public:
  /// `scale` of the robot.
  explicit Strides(const PlannerOptions& options, const Scale& scale = {})
      : stance_(options.stance),
        foothold_(options.foothold),
        swing_(options.swing),
        swing_duration_(options.gait.swing_duration),
        length_(scale.length) {}

  /// Share of the commanded velocity, at most 1, that the strides of all legs allow with the hips
  /// at a `height` over the feet [m]:
  ///
  ///     (stride_x / longest)² + (stride_y / aside)² ≤ 1
  ///
  /// with `aside` at most `max_side_step` and `max_side_stride`, `longest` at most `max_step`,
  /// `max_stride`, what a swing can do in its time, and twice the way from the foot's nominal place
  /// to where the leg reaches from the hip.
  [[nodiscard]] double feasible_share(const UserCommand& user, const PerLeg<Vec2>& hips,
                                      double height, double cycle_duration) const;

  /// Height of the hips over the feet up to which the legs reach both ends of the strides, half of
  /// each before and behind the foot's nominal place, while the hips sway [m].
  [[nodiscard]] double tallest(const UserCommand& user, const PerLeg<Vec2>& hips,
                               double cycle_duration) const;

  /// Share of a yaw rate, at most 1, that feet which stand allow until they step. In a steady turn
  /// the heading is up to 0.15 cycles of the turn ahead of the feet, and they are up to 3/8 of
  /// their stride aside of their nominal places. It is 0 where the heading is twice as far ahead,
  /// or a foot that it leaves behind half as far again.
  [[nodiscard]] double turning_share(double yaw_rate, const PerLeg<Vec3>& footholds,
                                     const PerLeg<bool>& down, double yaw,
                                     double cycle_duration) const;
  /// Whether the heading waits for the feet not only in a turn's first steps but for good: a foot
  /// is left behind by half of its stride, sideways, when it steps again.
  [[nodiscard]] bool turns_slower(double yaw_rate, double cycle_duration) const;

 private:
  /// Of a leg, in heading axes [m].
  [[nodiscard]] Vec2 stride(Leg leg, const UserCommand& user, double cycle_duration) const;
  /// How far the foot that stands furthest back in a turn to a side, 1 or −1, is aside of its
  /// nominal place [m].
  [[nodiscard]] double left_behind(double side, const PerLeg<Vec3>& footholds,
                                   const PerLeg<bool>& down, double yaw) const;

  StanceOptions stance_;
  FootholdOptions foothold_;
  SwingOptions swing_;
  double swing_duration_;  // [s]
  double length_;          // that its lengths go with, as a ratio
};

}  // namespace surefoot::gaits
