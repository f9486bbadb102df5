#include "surefoot/gaits/command_limits.hpp"

#include "surefoot/gaits/parts/reach.hpp"
#include "surefoot/gaits/parts/turn_limits.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr double kSpareReach = 0.01;  // of a leg, that no torso is held so high for [m]
// From step to step:
const Vec2 kVelocityChange(0.1, 0.05);  // forwards and sideways [m/s]
constexpr double kTurnChange = 0.2;     // [rad/s]
constexpr double kHeightRate = 0.15;    // [m/s]
// Of a torso over legs that step, under the stance's height: knees that are bent further have no
// room to swing [m].
constexpr double kLowest = -0.10;

}  // namespace

CommandLimits::CommandLimits(const PlannerOptions& options, double period)
    : stance_(options.stance),
      swing_(options.swing),
      swing_duration_(options.gait.swing_duration),
      max_side_step_(options.foothold.max_side_step),
      period_(period) {}

// Accelerations fall with the length of the strides.
UserCommand CommandLimits::update(const UserCommand& command, const CommandRoom& room,
                                  const FootholdPlanner& footholds) {
  walked_ = within_strides(as_planned(command, room.stands), room, footholds);
  UserCommand cautious = walked_;
  cautious.velocity /= room.caution;
  cautious.yaw_rate /= room.caution;
  UserCommand result = within_height(cautious, room, footholds);
  result.height = slowly(result.height);
  return result;
}

// The COM's way to the next lift-off is planned when a foot comes down, and with it the foothold
// behind it: a velocity that changed in between would send foot and torso to different places.
UserCommand CommandLimits::as_planned(const UserCommand& command, bool stands) {
  commanded_ = command;
  if (stands) {
    velocity_ = command.velocity;
    turn_ = command.yaw_rate;
  }
  UserCommand result = command;
  result.velocity = velocity_;
  result.yaw_rate = turn_;
  return result;
}

// All of them by the same share of what is missing, so that the direction becomes the commanded
// one, also where the legs can't follow it all the way.
void CommandLimits::take_up(const CommandRoom& room, const FootholdPlanner& footholds) {
  const Vec3 most(kVelocityChange.x(), kVelocityChange.y(), kTurnChange);
  const auto velocities = [](const UserCommand& user) {
    return Vec3(user.velocity.x(), user.velocity.y(), user.yaw_rate);
  };
  const Vec3 asked = velocities(commanded_), now = velocities(walked_);
  Vec3 next = asked;
  if (((asked - now).cwiseAbs().array() > most.array()).any()) {
    const double share = feasible_share(commanded_, room.hips, room.cycle_duration, footholds);
    const Vec3 missing = share * asked - now;
    next = now + missing / std::max(1.0, missing.cwiseQuotient(most).cwiseAbs().maxCoeff());
  }
  velocity_ = next.head<2>();
  turn_ = next.z();
}

double CommandLimits::feasible_share(const UserCommand& command, const PerLeg<Vec2>& hips,
                                     double cycle_duration,
                                     const FootholdPlanner& footholds) const {
  const double height = stance_.height + std::fmin(0.0, height_);
  const StrideLimits limits{.reach = horizontal_reach(swing_, height),
                            .length = swing_.speed_max * swing_duration_};
  return footholds.feasible_share(command, hips, limits, cycle_duration);
}

// A cautious gait's cycle is longer, and so are its strides; who commands it is told of those that
// would be too long without caution, too.
UserCommand CommandLimits::within_strides(const UserCommand& command, const CommandRoom& room,
                                          const FootholdPlanner& footholds) {
  const double share =
      command.walk ? feasible_share(command, room.hips, room.cycle_duration, footholds) : 1.0;
  const bool is_taken_up = velocity_ == commanded_.velocity && turn_ == commanded_.yaw_rate;
  const bool may_slow = share < 1.0 || !is_taken_up;
  const double cycle = room.cycle_duration / room.pace;
  const bool has_long_strides =
      may_slow && feasible_share(commanded_, room.hips, cycle, footholds) < 1.0;
  const double side_stride = cycle * std::abs(commanded_.yaw_rate) * stance_.half_length;
  slows_.holds = command.walk && (has_long_strides || turns_slower(side_stride, max_side_step_));
  UserCommand result = command;
  result.velocity *= share;
  result.yaw_rate *= share;
  return result;
}

// Strides come before height.
UserCommand CommandLimits::within_height(const UserCommand& command, const CommandRoom& room,
                                         const FootholdPlanner& footholds) {
  UserCommand result = command;
  if (command.walk) result.height = std::max(command.height, kLowest);
  raises_.holds = result.height > command.height;
  if (!(command.height > 0.0)) {
    lowers_.holds = false;
    return result;
  }
  UserCommand strides = command;
  if (!command.walk) {
    strides.velocity.setZero();
    strides.yaw_rate = 0.0;
  }
  const double tallest =
      footholds.tallest(strides, room.hips, swing_.reach_max - kSpareReach, room.cycle_duration);
  const double most = room.calibrates ? 0.0 : std::max(0.0, tallest - stance_.height);
  if (command.height <= most) {
    lowers_.holds = false;
  } else if (!room.calibrates) {
    lowers_.holds = true;
  }
  result.height = std::min(command.height, most);
  return result;
}

double CommandLimits::slowly(double height) {
  const double most = period_ * kHeightRate;
  height_ = std::isnan(height_) ? height : height_ + std::clamp(height - height_, -most, most);
  return height_;
}

void CommandLimits::Limit::tell(PlanEvent event, EventList& events) {
  if (holds && !told) events.add({.kind = event});
  told = holds;
}

void CommandLimits::tell(EventList& events) {
  slows_.tell(PlanEvent::slowed, events);
  lowers_.tell(PlanEvent::lowered, events);
  raises_.tell(PlanEvent::raised, events);
}

}  // namespace surefoot
