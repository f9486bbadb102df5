#pragma once

#include "surefoot/gaits/parts/foothold_planner.hpp"
#include "surefoot/gaits/planner_options.hpp"
#include "surefoot/signals/event_list.hpp"
#include "surefoot/signals/sensor_reading.hpp"
#include "surefoot/signals/user_command.hpp"

namespace surefoot {

/// What a command has to fit into at a tick.
struct CommandRoom {
  double cycle_duration = 0.0;  ///< of the steps, with the caution of this tick [s]
  double pace = 1.0;            ///< by which caution makes it longer: a factor
  double caution = 1.0;         ///< how much slower the walk should be, for friction and pushes
  PerLeg<Vec2> hips{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(),
                    Vec2::Zero()};  ///< about the footholds' centre, in heading axes [m]
  bool stands = true;               ///< no step goes on
  bool calibrates = false;          ///< the torso turns on the spot, or is about to
};

/// Makes of the user's command one that the legs can follow: velocities that change step by step
/// and leave strides within reach, and a height that strides and sway leave to the legs.
class CommandLimits {
 public:
  /// `period` of the control loop [s].
  CommandLimits(const PlannerOptions& options, double period);

  /// One tick.
  [[nodiscard]] UserCommand update(const UserCommand& command, const CommandRoom& room,
                                   const FootholdPlanner& footholds);
  /// A step begins: the next one's velocities are as near to the command as they may change.
  void take_up(const CommandRoom& room, const FootholdPlanner& footholds);
  /// Tells each limit once, when it begins to hold the command back.
  void tell(EventList& events);

 private:
  struct Limit {
    bool holds = false, told = false;
    void tell(PlanEvent event, EventList& events);
  };

  /// With the velocities that this step is planned with: in a stand as commanded.
  [[nodiscard]] UserCommand as_planned(const UserCommand& command, bool stands);
  /// Of the command's velocities, that legs can follow.
  [[nodiscard]] double feasible_share(const UserCommand& command, const PerLeg<Vec2>& hips,
                                      double cycle_duration,
                                      const FootholdPlanner& footholds) const;
  [[nodiscard]] UserCommand within_strides(const UserCommand& command, const CommandRoom& room,
                                           const FootholdPlanner& footholds);
  [[nodiscard]] UserCommand within_height(const UserCommand& command, const CommandRoom& room,
                                          const FootholdPlanner& footholds);
  /// On the way to a height [m].
  [[nodiscard]] double slowly(double height);

  StanceOptions stance_;
  SwingOptions swing_;
  double swing_duration_, max_side_step_;  // [s], [m]
  double period_;
  UserCommand commanded_, walked_;  // as asked for, and with strides that legs can make
  Vec2 velocity_{0.0, 0.0};         // that this step is planned with [m/s]
  double turn_ = 0.0;               // the same, of the yaw rate [rad/s]
  double height_ = kNaN;            // of the torso, beyond the stance's [m]
  Limit slows_;                     // strides too short for the velocity
  Limit lowers_;                    // legs too short for the height
  Limit raises_;                    // legs too bent for it
};

}  // namespace surefoot
