#include "surefoot/gaits/parts/strides.hpp"

#include "surefoot/math/rotation.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::gaits {
namespace {

constexpr double kSpareReach = 0.01;    // of a leg, that no torso is held so high for [m]
constexpr double kSway = 0.12;          // of the hips, sideways, as far as a turn makes them [m]
constexpr double kLead = 0.3;           // of a heading that turns before the feet, in cycles …
constexpr double kLeastLead = 0.2;      // … but up to this at any rate [rad]
constexpr double kMostBehind = 0.5625;  // of a foot that a turn leaves, in max_side_step sideways …
constexpr double kBrake = 3.0;  // … slowed down before in proportion to what is left, times this

// From the middle of the hind feet to that of the front feet, whatever the strides on either side.
double heading_of(const PerLeg<Vec3>& footholds) {
  Vec2 forward = Vec2::Zero();
  for (const Leg leg : kLegs)
    forward += (is_front(leg) ? 0.5 : -0.5) * footholds[index(leg)].head<2>();
  return std::atan2(forward.y(), forward.x());
}

// Twice the way from a place at `offset` from the hip to the circle of radius `reach` about the
// hip, forward or backward, whichever is shorter; 0 outside it.
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
  for (const Leg leg : kLegs) {
    const Vec2 step = stride(leg, user, cycle_duration);
    const Vec2 from_hip = nominal_offset(stance_, leg) - hips[index(leg)];
    const double within_reach = longest_stride(from_hip, step.normalized(), reach);
    const double longest = std::min({foothold_.max_step, foothold_.max_stride,
                                     swing_.speed_max * swing_duration_, within_reach});
    const double aside = std::min({longest, foothold_.max_side_step, foothold_.max_side_stride});
    const double excess = std::hypot(step.x() / longest, step.y() / aside);
    if (excess > 1.0) share = std::min(share, 1.0 / excess);
  }
  return share;
}

Vec2 Strides::stride(Leg leg, const UserCommand& user, double cycle_duration) const {
  const Vec2 foot = nominal_offset(stance_, leg);
  const Vec2 turning = user.yaw_rate * Vec2(-foot.y(), foot.x());
  return cycle_duration * (user.velocity + turning);
}

double Strides::tallest(const UserCommand& user, const PerLeg<Vec2>& hips,
                        double cycle_duration) const {
  const double length = swing_.reach_max - length_ * kSpareReach;
  double height = length;
  for (const Leg leg : kLegs) {
    const Vec2 half = 0.5 * stride(leg, user, cycle_duration);
    const Vec2 from_hip = nominal_offset(stance_, leg) - hips[index(leg)];
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
  const double most_ahead = std::max(kLeastLead, kLead * cycle_duration * std::abs(yaw_rate));
  const double behind = left_behind(side, footholds, down, yaw);
  const double most_behind = kMostBehind * foothold_.max_side_step;
  return std::clamp(
      std::min(2.0 * (1.0 - ahead / most_ahead), kBrake * (1.0 - behind / most_behind)), 0.0, 1.0);
}

bool Strides::turns_slower(double yaw_rate, double cycle_duration) const {
  constexpr double kFree = kMostBehind * (1.0 - 1.0 / kBrake);
  const double side_stride = cycle_duration * std::abs(yaw_rate) * stance_.half_length;
  return 0.5 * side_stride > kFree * foothold_.max_side_step;
}

// Sideways, in heading axes: there a leg is the least agile, and meets the one beside it.
double Strides::left_behind(double side, const PerLeg<Vec3>& footholds, const PerLeg<bool>& down,
                            double yaw) const {
  Vec2 center = Vec2::Zero();
  for (const Vec3& foothold : footholds) center += foothold.head<2>() / kNumLegs;
  const Vec2 left = rotation_about_z(yaw).col(1).head<2>();
  double furthest = 0.0;
  for (const Leg leg : kLegs) {
    const Vec2 from_center = footholds[index(leg)].head<2>() - center;
    const double aside = left.dot(from_center) - nominal_offset(stance_, leg).y();
    const double behind = side * (is_front(leg) ? -aside : aside);
    if (down[index(leg)]) furthest = std::max(furthest, behind);
  }
  return furthest;
}

}  // namespace surefoot::gaits
