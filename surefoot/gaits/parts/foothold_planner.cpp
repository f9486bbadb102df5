#include "surefoot/gaits/parts/foothold_planner.hpp"

#include "surefoot/gaits/parts/turn_limits.hpp"
#include "surefoot/math/rotation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace surefoot {
namespace {

constexpr double kStrideShare = 5.0 / 8.0;
constexpr double kReachUpward = 1.25;    // of max_step: a leg that steps up is not stretched
constexpr double kLastReach = 1.25;      // … and one that would not go on otherwise must be
constexpr double kSteepest = 0.36;       // rise over run of a slope; what is steeper is an edge
constexpr double kLowestStair = 0.06;    // what rises by more in a stride may be stairs [m]
constexpr double kEvenly = 0.015;        // a slope's print from the line through two others [m]
constexpr double kLeastStride = 0.05;    // that says something of the ground's slope [m]
constexpr double kLeastProgress = 0.03;  // a footprint must lie this far ahead of the foot [m]
constexpr double kLead = 0.3;            // of a heading that turns before the feet, in cycles …
constexpr double kLeastLead = 0.2;       // … but up to this at any rate [rad]

constexpr double kSway = 0.12;  // of the hips, sideways, as far as a turn makes them [m]

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

Vec2 nominal_offset(const StanceOptions& stance, Leg leg) {
  return {is_front(leg) ? stance.half_length : -stance.half_length,
          is_left(leg) ? stance.half_width : -stance.half_width};
}

Vec3 FootholdPlanner::foothold(Leg leg, const PerLeg<Vec3>& footholds, const TerrainPlane& plane,
                               double yaw, const UserCommand& user, double cycle_duration) const {
  const Mat2 R = rotation_about_z(yaw).topLeftCorner<2, 2>();
  Vec2 center = Vec2::Zero();
  for (const Leg other : kLegs) {
    center += (footholds[index(other)].head<2>() - R * nominal_offset(stance_, other)) / kNumLegs;
  }
  const double ahead = kStrideShare * cycle_duration;
  const Mat2 R_ahead = rotation_about_z(yaw + ahead * user.yaw_rate).topLeftCorner<2, 2>();
  const Vec3& from = footholds[index(leg)];
  const Vec2 goal = center + R_ahead * nominal_offset(stance_, leg) + ahead * (R * user.velocity);
  const Vec2 near = not_stretched(leg, goal, footholds, R.col(0));
  const Vec2 step = clip_norm<2>(near - from.head<2>(), options_.max_step);
  Vec3 nominal;
  nominal << from.head<2>() + step, 0.0;
  nominal.z() = expected_height(leg, nominal.head<2>(), footholds, plane);
  const Vec2 heading = R.col(0) * (user.velocity.x() < 0.0 ? -1.0 : 1.0);
  const bool follows = !is_front(leg) && options_.hind_use_front_prints;
  const Vec3 wanted =
      follows ? on_prints(prints_[is_left(leg) ? 0 : 1], nominal, from, heading) : nominal;
  return beside_voids(leg, wanted, footholds, plane, heading);
}

double FootholdPlanner::expected_height(Leg leg, const Vec2& place, const PerLeg<Vec3>& footholds,
                                        const TerrainPlane& plane) const {
  const double height = plane.height(place);
  if (!is_front(leg) || !options_.bounded_by_feet) return height;
  const double way = (place - footholds[index(leg)].head<2>()).norm();
  const double beyond = way * last_slope(prints_[is_left(leg) ? 0 : 1]);
  double highest = footholds[index(leg)].z();
  for (const Vec3& foothold : footholds) highest = std::max(highest, foothold.z());
  return std::min(height, highest + beyond);
}

double FootholdPlanner::last_slope(const Prints& prints) const {
  for (std::size_t i = 1; i < prints.size(); ++i) {
    const Vec3 stride = prints.newest(0) - prints.newest(i);
    const double length = stride.head<2>().norm(), rise = std::abs(stride.z());
    if (length < kLeastStride) continue;
    return rise > kSteepest * length + options_.same_height ? 0.0 : rise / length;
  }
  return std::numeric_limits<double>::infinity();
}

// A front foot does not run away from the hind foot that is to follow in its prints.
Vec2 FootholdPlanner::not_stretched(Leg leg, const Vec2& goal, const PerLeg<Vec3>& footholds,
                                    const Vec2& heading) const {
  if (!is_front(leg) || !options_.hind_use_front_prints) return goal;
  const double ahead = heading.dot(goal - footholds[index(same_side(leg))].head<2>());
  return goal - std::max(0.0, ahead - 2.0 * stance_.half_length - options_.stretch_max) * heading;
}

double FootholdPlanner::feasible_share(const UserCommand& user, const PerLeg<Vec2>& hips,
                                       const StrideLimits& limits, double cycle_duration) const {
  double share = 1.0;
  for (const Leg leg : kLegs) {
    const Vec2 step = stride(leg, user, cycle_duration);
    const Vec2 from_hip = nominal_offset(stance_, leg) - hips[index(leg)];
    const double within_reach = longest_stride(from_hip, step.normalized(), limits.reach);
    const double longest =
        std::min({options_.max_step, options_.max_stride, limits.length, within_reach});
    const double aside = std::min({longest, options_.max_side_step, options_.max_side_stride});
    const double excess = std::hypot(step.x() / longest, step.y() / aside);
    if (excess > 1.0) share = std::min(share, 1.0 / excess);
  }
  return share;
}

Vec2 FootholdPlanner::stride(Leg leg, const UserCommand& user, double cycle_duration) const {
  const Vec2 foot = nominal_offset(stance_, leg);
  const Vec2 turning = user.yaw_rate * Vec2(-foot.y(), foot.x());
  return cycle_duration * (user.velocity + turning);
}

double FootholdPlanner::tallest(const UserCommand& user, const PerLeg<Vec2>& hips, double length,
                                double cycle_duration) const {
  double height = length;
  for (const Leg leg : kLegs) {
    const Vec2 half = 0.5 * stride(leg, user, cycle_duration);
    const Vec2 from_hip = nominal_offset(stance_, leg) - hips[index(leg)];
    const Vec2 most = from_hip.cwiseAbs() + half.cwiseAbs() + Vec2(0.0, kSway);
    const double furthest = most.norm();
    height = std::min(height, std::sqrt(std::max(0.0, length * length - furthest * furthest)));
  }
  return height;
}

double FootholdPlanner::turning_share(double yaw_rate, const PerLeg<Vec3>& footholds,
                                      const PerLeg<bool>& down, double yaw,
                                      double cycle_duration) const {
  const double side = yaw_rate < 0.0 ? -1.0 : 1.0;
  const double ahead = side * std::remainder(yaw - heading_of(footholds), 2.0 * kPi);
  const double most_ahead = std::max(kLeastLead, kLead * cycle_duration * std::abs(yaw_rate));
  const double behind = left_behind(side, footholds, down, yaw);
  const double most_behind = kMostBehind * options_.max_side_step;
  return std::clamp(
      std::min(2.0 * (1.0 - ahead / most_ahead), kBrake * (1.0 - behind / most_behind)), 0.0, 1.0);
}

// Sideways, in heading axes: there a leg is the least agile, and meets the one beside it.
double FootholdPlanner::left_behind(double side, const PerLeg<Vec3>& footholds,
                                    const PerLeg<bool>& down, double yaw) const {
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

void FootholdPlanner::avoid(const Vec3& p_WF) {
  voids_[num_voids_++ % kVoidsKept] = {p_WF.head<2>(), touchdowns_ + kAvoidedFor};
}

bool FootholdPlanner::is_void(const Vec2& place) const {
  return std::ranges::any_of(voids_, [&](const Void& known) {
    return touchdowns_ < known.until && (place - known.place).norm() < options_.void_radius;
  });
}

// Half the way there may still be the ground that the foot stands on; then over it, then beside it.
// A leg that is stretched to get there can't look for ground below. Where nothing is left the foot
// stays where it is: there is ground.
Vec3 FootholdPlanner::beside_voids(Leg leg, const Vec3& place, const PerLeg<Vec3>& footholds,
                                   const TerrainPlane& plane, const Vec2& heading) const {
  const Vec3& from = footholds[index(leg)];
  if (!is_void(place.head<2>())) return place;
  const Vec2 step = (place - from).head<2>();
  const Vec2 way = step.norm() > options_.void_radius ? Vec2(step.normalized()) : heading;
  const Vec2 aside(-way.y(), way.x());
  const double far = 2.0 * options_.void_radius;
  const std::array<Vec2, 5> others{Vec2(0.5 * step), Vec2(step + far * way),
                                   Vec2(step + far * aside), Vec2(step - far * aside),
                                   Vec2(step + 2.0 * far * way)};
  for (const Vec2& other : others) {
    const Vec2 there = from.head<2>() + other;
    const bool is_near = other.norm() < kReachUpward * options_.max_step &&
                         not_stretched(leg, there, footholds, heading) == there;
    if (!is_near || is_void(there)) continue;
    Vec3 result;
    result << there, expected_height(leg, there, footholds, plane);
    return result;
  }
  return from;
}

void FootholdPlanner::remember(Leg leg, const Vec3& p_WF) {
  ++touchdowns_;
  if (!is_front(leg)) return;
  prints_[is_left(leg) ? 0 : 1].add(p_WF);
}

void FootholdPlanner::forget() {
  prints_ = {};
  voids_ = {};
  num_voids_ = 0;
}

void FootholdPlanner::forget_last(Leg leg) {
  if (!is_front(leg)) return;
  prints_[is_left(leg) ? 0 : 1].drop_last();
}

void FootholdPlanner::Prints::add(const Vec3& p_WF) {
  points[added++ % kPrintsKept] = p_WF;
  kept = std::min(kept + 1, kPrintsKept);
}

void FootholdPlanner::Prints::drop_last() {
  if (kept == 0) return;
  --added;
  --kept;
}

// The front foot's prints tell what lies under the hind foot's way. Where the print before the
// nominal foothold and the one beyond it differ in height, there is an edge between to slip from,
// and only the prints are known to be good: a step up may be longer than others, and where the far
// side is out of reach the foot waits on the print before it, if it is not there yet. Elsewhere it
// goes where it likes, over the higher of the two.
Vec3 FootholdPlanner::on_prints(const Prints& prints, const Vec3& nominal, const Vec3& from,
                                const Vec2& heading) const {
  const Vec2 aside(-heading.y(), heading.x());
  const auto ahead = [&](const Vec3& print) { return heading.dot((print - nominal).head<2>()); };
  const auto beside = [&](const Vec3& print) {  // of another way, before a turn
    return std::abs(aside.dot((print - nominal).head<2>())) > stance_.half_width;
  };
  const auto last_before = [&](double limit) {
    const Vec3* last = nullptr;
    for (std::size_t i = 0; i < prints.size(); ++i) {
      const Vec3& print = prints.newest(i);
      if (!beside(print) && ahead(print) <= limit &&
          (last == nullptr || ahead(print) > ahead(*last)))
        last = &print;
    }
    return last;
  };
  const Vec3* beyond = nullptr;
  for (std::size_t i = 0; i < prints.size(); ++i) {
    const Vec3& print = prints.newest(i);
    if (!beside(print) && ahead(print) > 0.0 &&
        (beyond == nullptr || ahead(print) < ahead(*beyond)))
      beyond = &print;
  }
  if (beyond == nullptr) return nominal;
  const Vec3* before = last_before(0.0);
  const Vec3* earlier = before == nullptr ? nullptr : last_before(ahead(*before) - kLeastStride);
  const double rise = before == nullptr ? 0.0 : beyond->z() - before->z();
  const bool slope = earlier != nullptr && is_slope(*earlier, *before, *beyond);
  const bool edge = std::abs(rise) > options_.same_height && !slope;
  const double reach = (edge && rise > 0.0 ? kReachUpward : 1.0) * options_.max_step;
  const auto reachable = [&](const Vec3& print) { return (print - from).head<2>().norm() < reach; };
  const bool can_wait = edge && heading.dot((*before - from).head<2>()) > kLeastProgress;
  if (edge && !reachable(*beyond)) return can_wait ? *before : towards(*beyond, from);
  const Vec3& nearest =
      edge || before == nullptr || ahead(*beyond) < -ahead(*before) ? *beyond : *before;
  const bool near = (nearest - nominal).head<2>().norm() < options_.print_radius;
  const bool progress = heading.dot((nearest - from).head<2>()) > kLeastProgress;
  if (edge || (near && progress && reachable(nearest))) return nearest;
  Vec3 between = nominal;
  between.z() = before == nullptr ? beyond->z() : std::max(before->z(), beyond->z());
  return between;
}

// Evenly, not steeper than slopes are and by less than stairs: a print on every tread rises evenly,
// too.
bool FootholdPlanner::is_slope(const Vec3& first, const Vec3& second, const Vec3& third) const {
  const Vec3 stride = second - first, next = third - second;
  const double slope = stride.z() / stride.head<2>().norm(), run = next.head<2>().norm();
  const bool gentle = std::max(std::abs(slope) * run, std::abs(next.z())) < kSteepest * run;
  return gentle && std::abs(next.z()) < kLowestStair && std::abs(next.z() - slope * run) < kEvenly;
}

// As far as the leg can.
Vec3 FootholdPlanner::towards(const Vec3& print, const Vec3& from) const {
  const Vec2 way = (print - from).head<2>();
  const double longest = kLastReach * options_.max_step;
  if (way.norm() < longest) return print;
  Vec3 goal;
  goal << from.head<2>() + clip_norm<2>(way, longest), std::max(print.z(), from.z());
  return goal;
}

}  // namespace surefoot
