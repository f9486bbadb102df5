#include "surefoot/gaits/command_limits.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::gaits {
namespace {

// Per step: forward and sideways [m/s], yaw rate [rad/s].
const Vec3 kMaxChange(0.1, 0.05, 0.2);
constexpr double kHeightRate = 0.15;  // [m/s]
// Of a walking torso, relative to the stance: more bent legs can't swing [m].
constexpr double kMinHeight = -0.10;

Vec3 velocities(const UserCommand& user) {
  return Vec3(user.velocity.x(), user.velocity.y(), user.yaw_rate);
}

}  // namespace

double foot_speed(const UserCommand& command, double half_length) {
  return command.velocity.norm() + std::abs(command.yaw_rate) * half_length;
}

CommandLimits::CommandLimits(const PlannerOptions& options, double period, const Scale& scale)
    : strides_(options, scale),
      max_change_(kMaxChange.cwiseProduct(Vec3(scale.speed(), scale.speed(), scale.rate()))),
      height_rate_(scale.speed() * kHeightRate),
      min_height_(scale.length * kMinHeight),
      scale_(scale),
      hip_height_(hip_height(options.stance, scale)),
      period_(period),
      half_length_(options.stance.half_length) {}

void CommandLimits::use(const PlannerOptions& options) {
  strides_.use(options);
  hip_height_ = hip_height(options.stance, scale_);
}

// COM and next foothold are planned at touchdown. A later change of velocity would make foot and
// torso inconsistent. Caution divides velocities, as accelerations fall with the strides' length.
UserCommand CommandLimits::update(const UserCommand& command, const CommandContext& context) {
  commanded_ = command;
  is_invalid_.active = command.gait == UserCommand::kKeepGait;
  has_unknown_gait_.active = !context.knows_gait;
  if (context.stands) {
    velocity_ = context.starts_at_rest ? Vec2(0.0, 0.0) : command.velocity;
    turn_ = context.starts_at_rest ? 0.0 : command.yaw_rate;
  }
  UserCommand planned = command;
  planned.velocity = velocity_;
  planned.yaw_rate = turn_;
  walked_ = within_strides(planned, context);
  UserCommand cautious = walked_;
  cautious.velocity /= context.caution;
  cautious.yaw_rate /= context.caution;
  UserCommand result = within_height(cautious, context);
  const double most = period_ * height_rate_;
  height_ = std::isnan(height_) ? result.height
                                : height_ + std::clamp(result.height - height_, -most, most);
  result.height = height_;
  return result;
}

// All velocities change by the same share of their difference, which keeps the direction.
void CommandLimits::begin_step(const CommandContext& context) {
  const Vec3 asked = velocities(commanded_), now = velocities(walked_);
  Vec3 next = asked;
  if (((asked - now).cwiseAbs().array() > max_change_.array()).any()) {
    const Vec3 difference =
        feasible_share(commanded_, context, context.cycle_duration) * asked - now;
    const double steps = difference.cwiseQuotient(max_change_).cwiseAbs().maxCoeff();
    next = now + difference / std::max(1.0, steps);
  }
  velocity_ = next.head<2>();
  turn_ = next.z();
}

double CommandLimits::feasible_share(const UserCommand& command, const CommandContext& context,
                                     double cycle_duration) const {
  const double height = hip_height_ + std::fmin(0.0, height_);
  return std::min(strides_.feasible_share(command, context.hips, height, cycle_duration),
                  allowed_share(command, context));
}

double CommandLimits::allowed_share(const UserCommand& command,
                                    const CommandContext& context) const {
  return std::min(1.0, context.speed_max / foot_speed(command, half_length_));
}

// Caution makes cycle and strides longer. The event depends on the strides without caution.
UserCommand CommandLimits::within_strides(const UserCommand& command,
                                          const CommandContext& context) {
  const double share =
      command.walk ? feasible_share(command, context, context.cycle_duration) : 1.0;
  const bool is_reached = velocity_ == commanded_.velocity && turn_ == commanded_.yaw_rate;
  const double cycle = context.cycle_duration / context.pace;
  const bool has_long_strides =
      (share < 1.0 || !is_reached) && feasible_share(commanded_, context, cycle) < 1.0;
  brakes_.active = command.walk && allowed_share(commanded_, context) < 1.0;
  slows_.active = command.walk && !brakes_.active &&
                  (has_long_strides || strides_.turns_slower(commanded_.yaw_rate, cycle));
  UserCommand result = command;
  result.velocity *= share;
  result.yaw_rate *= share;
  return result;
}

// Strides have priority over height.
UserCommand CommandLimits::within_height(const UserCommand& command,
                                         const CommandContext& context) {
  UserCommand result = command;
  if (command.walk) result.height = std::max(command.height, min_height_);
  raises_.active = result.height > command.height;
  if (!(command.height > 0.0)) {
    lowers_.active = false;
    return result;
  }
  const UserCommand strides = command.walk ? command : UserCommand{};
  const double tallest = strides_.tallest(strides, context.hips, context.cycle_duration);
  const double most = context.calibrates ? 0.0 : std::max(0.0, tallest - hip_height_);
  if (command.height <= most || !context.calibrates) lowers_.active = command.height > most;
  result.height = std::min(command.height, most);
  return result;
}

void CommandLimits::report(EventList& events) {
  for (Limit* limit : {&slows_, &brakes_, &lowers_, &raises_, &is_invalid_, &has_unknown_gait_}) {
    if (limit->active && !limit->reported) events.add({.kind = limit->event});
    limit->reported = limit->active;
  }
}

}  // namespace surefoot::gaits
