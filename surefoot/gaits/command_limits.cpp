#include "surefoot/gaits/command_limits.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::gaits {
namespace {

// From step to step, forwards, sideways [m/s] and turning [rad/s]:
const Vec3 kMostChange(0.1, 0.05, 0.2);
constexpr double kHeightRate = 0.15;  // [m/s]
// Of a torso over legs that step, under the stance's height: knees that are bent further have no
// room to swing [m].
constexpr double kLowest = -0.10;

Vec3 velocities(const UserCommand& user) {
  return Vec3(user.velocity.x(), user.velocity.y(), user.yaw_rate);
}

}  // namespace

CommandLimits::CommandLimits(const PlannerOptions& options, double period, const Scale& scale)
    : strides_(options, scale),
      most_change_(kMostChange.cwiseProduct(Vec3(scale.speed(), scale.speed(), scale.rate()))),
      height_rate_(scale.speed() * kHeightRate),
      lowest_(scale.length * kLowest),
      hip_height_(hip_height(options.stance, scale)),
      period_(period) {}

// The COM's way to the next lift-off is planned when a foot comes down, and with it the foothold
// behind it: a velocity that changed in between would send foot and torso to different places.
// Accelerations fall with the length of the strides, so caution divides them.
UserCommand CommandLimits::update(const UserCommand& command, const CommandRoom& room) {
  commanded_ = command;
  if (room.stands) {
    velocity_ = command.velocity;
    turn_ = command.yaw_rate;
  }
  UserCommand planned = command;
  planned.velocity = velocity_;
  planned.yaw_rate = turn_;
  walked_ = within_strides(planned, room);
  UserCommand cautious = walked_;
  cautious.velocity /= room.caution;
  cautious.yaw_rate /= room.caution;
  UserCommand result = within_height(cautious, room);
  const double most = period_ * height_rate_;
  height_ = std::isnan(height_) ? result.height
                                : height_ + std::clamp(result.height - height_, -most, most);
  result.height = height_;
  return result;
}

// All of them by the same share of what is missing, so that the direction becomes the commanded
// one, also where the legs can't follow it all the way.
void CommandLimits::take_up(const CommandRoom& room) {
  const Vec3 asked = velocities(commanded_), now = velocities(walked_);
  Vec3 next = asked;
  if (((asked - now).cwiseAbs().array() > most_change_.array()).any()) {
    const Vec3 missing = feasible_share(commanded_, room, room.cycle_duration) * asked - now;
    const double steps = missing.cwiseQuotient(most_change_).cwiseAbs().maxCoeff();
    next = now + missing / std::max(1.0, steps);
  }
  velocity_ = next.head<2>();
  turn_ = next.z();
}

double CommandLimits::feasible_share(const UserCommand& command, const CommandRoom& room,
                                     double cycle_duration) const {
  const double height = hip_height_ + std::fmin(0.0, height_);
  return strides_.feasible_share(command, room.hips, height, cycle_duration);
}

// A cautious gait's cycle is longer, and so are its strides; who commands it is told of those that
// would be too long without caution, too.
UserCommand CommandLimits::within_strides(const UserCommand& command, const CommandRoom& room) {
  const double share = command.walk ? feasible_share(command, room, room.cycle_duration) : 1.0;
  const bool is_taken_up = velocity_ == commanded_.velocity && turn_ == commanded_.yaw_rate;
  const double cycle = room.cycle_duration / room.pace;
  const bool has_long_strides =
      (share < 1.0 || !is_taken_up) && feasible_share(commanded_, room, cycle) < 1.0;
  slows_.holds =
      command.walk && (has_long_strides || strides_.turns_slower(commanded_.yaw_rate, cycle));
  UserCommand result = command;
  result.velocity *= share;
  result.yaw_rate *= share;
  return result;
}

// Strides come before height.
UserCommand CommandLimits::within_height(const UserCommand& command, const CommandRoom& room) {
  UserCommand result = command;
  if (command.walk) result.height = std::max(command.height, lowest_);
  raises_.holds = result.height > command.height;
  if (!(command.height > 0.0)) {
    lowers_.holds = false;
    return result;
  }
  const UserCommand strides = command.walk ? command : UserCommand{};
  const double tallest = strides_.tallest(strides, room.hips, room.cycle_duration);
  const double most = room.calibrates ? 0.0 : std::max(0.0, tallest - hip_height_);
  if (command.height <= most || !room.calibrates) lowers_.holds = command.height > most;
  result.height = std::min(command.height, most);
  return result;
}

void CommandLimits::tell(EventList& events) {
  for (Limit* limit : {&slows_, &lowers_, &raises_}) {
    if (limit->holds && !limit->told) events.add({.kind = limit->event});
    limit->told = limit->holds;
  }
}

}  // namespace surefoot::gaits
