#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/gaits/parts/strides.hpp"
#include "surefoot/signals/event_list.hpp"
#include "surefoot/signals/sensor_reading.hpp"

namespace surefoot::gaits {

/// What limits the command at a tick.
struct CommandContext {
  double cycle_duration = 0.0;   ///< of the gait, with the pace of this tick [s]
  double pace = 1.0;             ///< factor in the duration, see Body::pace
  double caution = 1.0;          ///< divisor of the velocities, for friction and pushes
  PerLeg<Vec2> hips;             ///< relative to the footholds' centre, in heading axes [m]
  bool stands = true;            ///< the stand is active
  bool starts_at_rest = false;   ///< the first step has no velocity, instead of the commanded one
  bool calibrates = false;       ///< a calibration is going on or due
  double speed_max = kInfinity;  ///< of a foot relative to the torso, in this gait [m/s]
  bool knows_gait = true;        ///< the command's
};

/// Of the fastest foot relative to the torso [m/s]; `half_length` of the stance [m].
[[nodiscard]] double foot_speed(const UserCommand& command, double half_length);

/// Limits the user's command to what the legs can follow: velocities change step by step and keep
/// the strides within reach; the height leaves reach for strides and sway.
class CommandLimits {
 public:
  /// `period` of the control loop [s], `scale` of the robot.
  CommandLimits(const PlannerOptions& options, double period, const Scale& scale);

  /// Goes on in another gait.
  void use(const PlannerOptions& options);
  /// One tick.
  [[nodiscard]] UserCommand update(const UserCommand& command, const CommandContext& context);
  /// Moves the velocities toward the command by the largest change per step.
  void begin_step(const CommandContext& context);
  /// Adds an event for each limit that has just become active, and for an invalid command.
  void report(EventList& events);

  [[nodiscard]] const Strides& strides() const { return strides_; }

 private:
  struct Limit {
    PlanEvent event;
    bool active = false, reported = false;
  };

  /// Of the velocities, that the gait's speed allows.
  [[nodiscard]] double allowed_share(const UserCommand& command,
                                     const CommandContext& context) const;
  [[nodiscard]] double feasible_share(const UserCommand& command, const CommandContext& context,
                                      double cycle_duration) const;
  [[nodiscard]] UserCommand within_strides(const UserCommand& command,
                                           const CommandContext& context);
  [[nodiscard]] UserCommand within_height(const UserCommand& command,
                                          const CommandContext& context);

  Strides strides_;
  Vec3 max_change_;                  // per step, as `kMaxChange`
  double height_rate_, min_height_;  // as `kHeightRate`, `kMinHeight`
  Scale scale_;
  double hip_height_, period_;         // in the stance [m], [s]
  double half_length_;                 // of the stance [m]
  UserCommand commanded_, walked_;     // as given, and with feasible strides
  Vec2 velocity_{0.0, 0.0};            // of this step [m/s]
  double turn_ = 0.0;                  // yaw rate of this step [rad/s]
  double height_ = kNaN;               // of the torso, relative to the stance [m]
  Limit slows_{PlanEvent::slowed};     // strides too short for the velocity
  Limit brakes_{PlanEvent::too_fast};  // the gait too slow for it
  Limit lowers_{PlanEvent::lowered};   // legs too short for the height
  Limit raises_{PlanEvent::raised};    // legs too bent for it
  Limit is_invalid_{PlanEvent::invalid_command}, has_unknown_gait_{PlanEvent::unknown_gait};
};

}  // namespace surefoot::gaits
