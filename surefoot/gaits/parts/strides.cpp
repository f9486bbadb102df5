#include "surefoot/gaits/parts/strides.hpp"

#include "surefoot/math/rotation.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::gaits {
namespace {

constexpr double kReachReserve = 0.01;  // of a leg at the greatest torso height [m]
constexpr double kSway = 0.12;          // sideways, of the hips in a turn [m]
constexpr double kMaxLeadCycles = 0.3;  // of the heading over the feet, in cycles of the turn
constexpr double kMinLead = 0.2;        // lead that is always allowed [rad]
constexpr double kMaxSideLag = 0.5625;  // of a stance foot in a turn, in max_side_step
constexpr double kLagGain = 3.0;        // on what is left of this lag: slows the turn down

// Direction from the middle of the hind feet to that of the front feet [rad].
double heading_of(const PerLeg<Vec3>& footholds) {
  Vec2 forward = Vec2::Zero();
  for (const Leg leg : footholds.legs())
    forward +=
        0.5 * along(leg, static_cast<int>(footholds.size())) * footholds[index(leg)].head<2>();
  return std::atan2(forward.y(), forward.x());
}

// Twice the shorter of the distances, forward and backward, from a place at `offset` from the hip
// to the circle of radius `reach` about the hip; 0 outside it.
double longest_stride(const Vec2& offset, const Vec2& direction, double reach) {
  const double along = offset.dot(direction);
  const double square = along * along - offset.squaredNorm() + reach * reach;
  return 2.0 * std::max(0.0, std::sqrt(std::max(0.0, square)) - std::abs(along));
}

}  // namespace

double Strides::feasible_share(const UserCommand& user, const PerLeg<Vec2>& hips, double height,
                               double cycle_duration) const {
  const double reach = horizontal_reach(swing_, height);
  double share = 1.0;
  for (const Leg leg : hips.legs()) {
    const Vec2 foot = nominal_offset(stance_, leg, static_cast<int>(hips.size()));
    const Vec2 step = stride(foot, user, cycle_duration);
    const Vec2 from_hip = foot - hips[index(leg)];
    const double within_reach = longest_stride(from_hip, step.normalized(), reach);
    const double longest = std::min({foothold_.max_step, foothold_.max_stride,
                                     swing_.speed_max * swing_duration_, within_reach});
    const double aside = std::min({longest, foothold_.max_side_step, foothold_.max_side_stride});
    const double excess = std::hypot(step.x() / longest, step.y() / aside);
    if (excess > 1.0) share = std::min(share, 1.0 / excess);
  }
  return share;
}

Vec2 Strides::stride(const Vec2& foot, const UserCommand& user, double cycle_duration) {
  const Vec2 turning = user.yaw_rate * Vec2(-foot.y(), foot.x());
  return cycle_duration * (user.velocity + turning);
}

double Strides::tallest(const UserCommand& user, const PerLeg<Vec2>& hips,
                        double cycle_duration) const {
  const double length = swing_.reach_max - length_ * kReachReserve;
  double height = length;
  for (const Leg leg : hips.legs()) {
    const Vec2 foot = nominal_offset(stance_, leg, static_cast<int>(hips.size()));
    const Vec2 half = 0.5 * stride(foot, user, cycle_duration);
    const Vec2 from_hip = foot - hips[index(leg)];
    const Vec2 most = from_hip.cwiseAbs() + half.cwiseAbs() + Vec2(0.0, length_ * kSway);
    const double furthest = most.norm();
    height = std::min(height, std::sqrt(std::max(0.0, length * length - furthest * furthest)));
  }
  return height;
}

double Strides::turning_share(double yaw_rate, const PerLeg<Vec3>& footholds,
                              const PerLeg<bool>& down, double yaw, double cycle_duration) const {
  const double side = yaw_rate < 0.0 ? -1.0 : 1.0;
  const double ahead = side * std::remainder(yaw - heading_of(footholds), 2.0 * kPi);
  const double max_ahead = std::max(kMinLead, kMaxLeadCycles * cycle_duration * std::abs(yaw_rate));
  const double behind = side_lag(side, footholds, down, yaw);
  const double max_behind = kMaxSideLag * foothold_.max_side_step;
  return std::clamp(
      std::min(2.0 * (1.0 - ahead / max_ahead), kLagGain * (1.0 - behind / max_behind)), 0.0, 1.0);
}

bool Strides::turns_slower(double yaw_rate, double cycle_duration) const {
  constexpr double kUnslowedLag = kMaxSideLag * (1.0 - 1.0 / kLagGain);
  const double side_stride = cycle_duration * std::abs(yaw_rate) * stance_.half_length;
  return 0.5 * side_stride > kUnslowedLag * foothold_.max_side_step;
}

// Sideways, in heading axes: there a leg has the least room, and can hit the leg next to it.
double Strides::side_lag(double side, const PerLeg<Vec3>& footholds, const PerLeg<bool>& down,
                         double yaw) const {
  const int num_legs = static_cast<int>(footholds.size());
  Vec2 center = Vec2::Zero();
  for (const Vec3& foothold : footholds) center += foothold.head<2>() / num_legs;
  const Vec2 left = rotation_about_z(yaw).col(1).head<2>();
  double furthest = 0.0;
  for (const Leg leg : footholds.legs()) {
    const Vec2 from_center = footholds[index(leg)].head<2>() - center;
    const double aside = left.dot(from_center) - nominal_offset(stance_, leg, num_legs).y();
    const double behind = -side * along(leg, num_legs) * aside;
    if (down[index(leg)]) furthest = std::max(furthest, behind);
  }
  return furthest;
}

}  // namespace surefoot::gaits
