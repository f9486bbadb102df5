// What the planner makes of the user's command: what legs can follow, and when a calibration may
// begin.
#include "surefoot/gaits/parts/turn_limits.hpp"
#include "surefoot/gaits/planner.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace surefoot {
namespace {

constexpr double kStill = 0.02;  // [m/s] and [rad/s]
constexpr double kSpare = 0.01;  // of a leg's reach, that no torso is held so high for [m]
// From step to step:
const Vec2 kVelocityChange(0.1, 0.05);  // forwards and sideways [m/s]
constexpr double kTurnChange = 0.2;     // [rad/s]
constexpr double kHeightRate = 0.15;    // [m/s]
// Of a torso over legs that step, under the stance's height: knees that are bent further have no
// room to swing [m].
constexpr double kLowest = -0.10;

}  // namespace

// The COM's way to the next lift-off is planned when a foot comes down, and with it the foothold
// behind it: a velocity that changed in between would send foot and torso to different places.
UserCommand Planner::as_planned(const UserCommand& user) {
  commanded_ = user;
  if (mode_ == Mode::stand) {
    velocity_ = user.velocity;
    turn_ = user.yaw_rate;
  }
  UserCommand result = user;
  result.velocity = velocity_;
  result.yaw_rate = turn_;
  return result;
}

// All of them by the same share of what is missing, so that the direction becomes the commanded
// one, also where the legs can't follow it all the way.
void Planner::take_up() {
  const Vec3 most(kVelocityChange.x(), kVelocityChange.y(), kTurnChange);
  const auto velocities = [](const UserCommand& user) {
    return Vec3(user.velocity.x(), user.velocity.y(), user.yaw_rate);
  };
  const Vec3 asked = velocities(commanded_), now = velocities(walked_);
  Vec3 next = asked;
  if (((asked - now).cwiseAbs().array() > most.array()).any()) {
    const Vec3 missing = feasible_share(commanded_, cycle_duration()) * asked - now;
    next = now + missing / std::max(1.0, missing.cwiseQuotient(most).cwiseAbs().maxCoeff());
  }
  velocity_ = next.head<2>();
  turn_ = next.z();
}

double Planner::feasible_share(const UserCommand& user, double cycle_duration) const {
  const double height = options_.stance.height + std::fmin(0.0, height_);
  const StrideLimits limits{.reach = horizontal_reach(height),
                            .length = options_.swing.speed_max * options_.gait.swing_duration};
  return foothold_planner_.feasible_share(user, leaning_hips(), limits, cycle_duration);
}

// A cautious gait's cycle is longer, and so are its strides; who commands it is told of those that
// would be too long without caution, too.
UserCommand Planner::within_strides(const UserCommand& user) {
  const double share = user.walk ? feasible_share(user, cycle_duration()) : 1.0;
  const bool may_slow = share < 1.0 || !is_taken_up();
  const double cycle = cycle_duration() / pace();
  const bool has_long_strides = may_slow && feasible_share(commanded_, cycle) < 1.0;
  const double side_stride = cycle * std::abs(commanded_.yaw_rate) * options_.stance.half_length;
  slows_ =
      user.walk && (has_long_strides || turns_slower(side_stride, options_.foothold.max_side_step));
  UserCommand result = user;
  result.velocity *= share;
  result.yaw_rate *= share;
  return result;
}

// Strides come before height.
UserCommand Planner::within_height(const UserCommand& user) {
  UserCommand result = user;
  if (user.walk) result.height = std::max(user.height, kLowest);
  raises_ = result.height > user.height;
  if (!(user.height > 0.0)) {
    lowers_ = false;
    return result;
  }
  UserCommand strides = user;
  if (!user.walk) {
    strides.velocity.setZero();
    strides.yaw_rate = 0.0;
  }
  const double tallest = foothold_planner_.tallest(
      strides, leaning_hips(), options_.swing.reach_max - kSpare, cycle_duration());
  const bool turns = calibration_.is_due();
  const double most = turns ? 0.0 : std::max(0.0, tallest - options_.stance.height);
  if (user.height <= most) {
    lowers_ = false;
  } else if (!turns) {
    lowers_ = true;
  }
  result.height = std::min(user.height, most);
  return result;
}

double Planner::slowly(double height) {
  const double most = period_ * kHeightRate;
  height_ = std::isnan(height_) ? height : height_ + std::clamp(height - height_, -most, most);
  return height_;
}

// The heading needs no step to turn by itself: where it does not wait for the first steps, for late
// ones or after it went the other way, the feet come to stand across the torso.
double Planner::turning_share(double yaw_rate) const {
  PerLeg<bool> down{};
  for (const Leg k : kLegs) down[index(k)] = leg(k).down();
  return foothold_planner_.turning_share(yaw_rate, footholds(), down, yaw_, cycle_duration());
}

// Accelerations fall with the length of the strides.
UserCommand Planner::with_caution(const UserCommand& user) const {
  UserCommand result = user;
  const double caution = std::max(grip_.caution(), balance_.caution());
  result.velocity /= caution;
  result.yaw_rate /= caution;
  return result;
}

bool Planner::is_undisturbed(const RobotState& state) const {
  return plan_.num_contacts() == kNumLegs && std::ranges::none_of(state.slips, std::identity{}) &&
         state.external_force.head<2>().isZero();
}

// Once, at the first tick at which nothing else happens.
void Planner::tell_limits() {
  if (calibration_.is_due()) return;  // it doesn't walk
  slowed_ = slowed_ && slows_;
  lowered_ = lowered_ && lowers_;
  raised_ = raised_ && raises_;
  if (event_ != PlanEvent::none) return;
  if (slows_ && !slowed_) {
    event_ = PlanEvent::slowed;
    slowed_ = true;
  } else if (lowers_ && !lowered_) {
    event_ = PlanEvent::lowered;
    lowered_ = true;
  } else if (raises_ && !raised_) {
    event_ = PlanEvent::raised;
    raised_ = true;
  }
}

void Planner::note_rest(const RobotState& state) {
  if (mode_ != Mode::stand || !all_down()) stands_from_ = time_;
  if (!(state.v_WB.norm() < kStill)) rests_from_ = time_;
}

bool Planner::is_at_rest(const RobotState& state) const {
  return !calibration_.is_going_on() && !recovering_ &&
         time_ > std::max(stands_from_, rests_from_) + kStandDuration &&
         state.w_WB_B.norm() < kStill;
}

}  // namespace surefoot
