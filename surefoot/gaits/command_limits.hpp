#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/gaits/parts/strides.hpp"
#include "surefoot/signals/event_list.hpp"
#include "surefoot/signals/sensor_reading.hpp"

namespace surefoot::gaits {

/// What a command has to fit into at a tick.
struct CommandRoom {
  double cycle_duration = 0.0;  ///< of the steps, with the caution of this tick [s]
  double pace = 1.0;            ///< by which caution makes it longer: a factor
  double caution = 1.0;         ///< how much slower the walk should be, for friction and pushes
  PerLeg<Vec2> hips;            ///< about the footholds' centre, in heading axes [m]
  bool stands = true;           ///< no step goes on
  bool calibrates = false;      ///< the torso turns on the spot, or is about to
};

/// Makes of the user's command one that the legs can follow: velocities that change step by step
/// and leave strides within reach, and a height that strides and sway leave to the legs.
class CommandLimits {
 public:
  /// `period` of the control loop [s], `scale` of the robot.
  CommandLimits(const PlannerOptions& options, double period, const Scale& scale);

  /// One tick.
  [[nodiscard]] UserCommand update(const UserCommand& command, const CommandRoom& room);
  /// A step begins: the next one's velocities are as near to the command as they may change.
  void take_up(const CommandRoom& room);
  /// Tells each limit once, when it begins to hold the command back.
  void tell(EventList& events);

  [[nodiscard]] const Strides& strides() const { return strides_; }

 private:
  struct Limit {
    PlanEvent event;
    bool holds = false, told = false;
  };

  [[nodiscard]] double feasible_share(const UserCommand& command, const CommandRoom& room,
                                      double cycle_duration) const;
  [[nodiscard]] UserCommand within_strides(const UserCommand& command, const CommandRoom& room);
  [[nodiscard]] UserCommand within_height(const UserCommand& command, const CommandRoom& room);

  Strides strides_;
  Vec3 most_change_;                  // from step to step, as `kMostChange`
  double height_rate_, lowest_;       // as `kHeightRate`, `kLowest`
  double hip_height_, period_;        // in the stance [m], [s]
  UserCommand commanded_, walked_;    // as asked for, and with strides that legs can make
  Vec2 velocity_{0.0, 0.0};           // that this step is planned with [m/s]
  double turn_ = 0.0;                 // the same, of the yaw rate [rad/s]
  double height_ = kNaN;              // of the torso, beyond the stance's [m]
  Limit slows_{PlanEvent::slowed};    // strides too short for the velocity
  Limit lowers_{PlanEvent::lowered};  // legs too short for the height
  Limit raises_{PlanEvent::raised};   // legs too bent for it
};

}  // namespace surefoot::gaits
