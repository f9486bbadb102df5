#include "surefoot/planning/foothold_planner.hpp"

#include "surefoot/math/rotation.hpp"

#include <algorithm>

namespace surefoot {
namespace {

constexpr double kStrideShare = 5.0 / 8.0;
constexpr double kLeastProgress = 0.03;  // a footprint must lie this far ahead of the foot [m]

}  // namespace

Vec2 FootholdPlanner::nominal_offset(Leg leg) const {
  return {is_front(leg) ? stance_.half_length : -stance_.half_length,
          is_left(leg) ? stance_.half_width : -stance_.half_width};
}

Vec3 FootholdPlanner::foothold(Leg leg, const PerLeg<Vec3>& footholds, const TerrainPlane& plane,
                               double yaw, const UserCommand& user, double cycle_duration) const {
  const Mat2 R = rotation_about_z(yaw).topLeftCorner<2, 2>();
  Vec2 center = Vec2::Zero();
  for (const Leg other : kLegs) {
    center += (footholds[index(other)].head<2>() - R * nominal_offset(other)) / kNumLegs;
  }
  const double ahead = kStrideShare * cycle_duration;
  const Mat2 R_ahead = rotation_about_z(yaw + ahead * user.yaw_rate).topLeftCorner<2, 2>();
  const Vec3& from = footholds[index(leg)];
  const Vec2 goal = center + R_ahead * nominal_offset(leg) + ahead * (R * user.velocity);
  const Vec2 step = clip_norm<2>(goal - from.head<2>(), options_.max_step);
  Vec3 nominal;
  nominal << from.head<2>() + step, 0.0;
  nominal.z() = plane.height(nominal.head<2>());
  if (is_front(leg) || !options_.hind_use_front_prints) return nominal;
  return nearest_print(prints_[is_left(leg) ? 0 : 1], nominal, from,
                       R.col(0) * (user.velocity.x() < 0.0 ? -1.0 : 1.0));
}

void FootholdPlanner::remember(Leg leg, const Vec3& p_WF) {
  if (!is_front(leg)) return;
  Prints& prints = prints_[is_left(leg) ? 0 : 1];
  prints.points[prints.count++ % kPrintsKept] = p_WF;
}

Vec3 FootholdPlanner::nearest_print(const Prints& prints, const Vec3& nominal, const Vec3& from,
                                    const Vec2& heading) const {
  Vec3 best = nominal;
  double smallest = options_.print_radius;
  for (std::size_t i = 0; i < std::min(prints.count, kPrintsKept); ++i) {
    const Vec3& print = prints.points[i];
    const double distance = (print - nominal).head<2>().norm();
    if (distance >= smallest || heading.dot((print - from).head<2>()) < kLeastProgress) continue;
    smallest = distance;
    best = print;
  }
  return best;
}

}  // namespace surefoot
