#include "surefoot/gaits/parts/foothold_planner.hpp"

#include "surefoot/math/rotation.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::gaits {
namespace {

constexpr double kStepUpReach = 1.25;         // of max_step, as a step up does not stretch the leg
constexpr double kForcedReach = 1.25;         // of max_step, where the next print is too far
constexpr double kMaxSlope = 0.36;            // rise over run; steeper ground is an edge
constexpr double kMinStairRise = 0.06;        // per stride; a greater rise may be stairs [m]
constexpr double kMaxSlopeDeviation = 0.015;  // of a print from the line through two others [m]
constexpr double kMinStride = 0.05;           // that determines the ground's slope [m]
constexpr double kMinProgress = 0.03;         // of a footprint ahead of the foot [m]

/// Do three consecutive prints lie on one slope: evenly, and flatter than stairs, whose prints may
/// rise evenly too? `length` is the robot's scale.
bool is_slope(const Vec3& first, const Vec3& second, const Vec3& third, double length) {
  const Vec3 stride = second - first, next = third - second;
  const double slope = stride.z() / stride.head<2>().norm(), run = next.head<2>().norm();
  const bool gentle = std::max(std::abs(slope) * run, std::abs(next.z())) < kMaxSlope * run;
  return gentle && std::abs(next.z()) < length * kMinStairRise &&
         std::abs(next.z() - slope * run) < length * kMaxSlopeDeviation;
}

/// The prints beyond and before a nominal foothold along a heading, and one `stride` before that;
/// null: none.
struct Around {
  const Vec3 *beyond, *before, *earlier;
};
template <typename Prints>
Around prints_around(const Prints& prints, const Vec3& nominal, const Vec2& heading,
                     double half_width, double stride) {
  const Vec2 aside(-heading.y(), heading.x());
  const auto ahead = [&](const Vec3& print) { return heading.dot((print - nominal).head<2>()); };
  const auto nearest = [&](double sign, const auto& fits) {
    const Vec3* found = nullptr;
    for (std::size_t i = 0; i < prints.size(); ++i) {
      const Vec3& print = prints.newest(i);
      if (std::abs(aside.dot((print - nominal).head<2>())) > half_width) continue;  // off the path
      if (!fits(ahead(print))) continue;
      if (found == nullptr || sign * ahead(print) < sign * ahead(*found)) found = &print;
    }
    return found;
  };
  const auto last_up_to = [&](double limit) {
    return nearest(-1.0, [&](double way) { return way <= limit; });
  };
  const Vec3* beyond = nearest(1.0, [](double way) { return way > 0.0; });
  const Vec3* before = last_up_to(0.0);
  return {beyond, before, before == nullptr ? nullptr : last_up_to(ahead(*before) - stride)};
}

}  // namespace

Vec3 FootholdPlanner::foothold(Leg leg, const PerLeg<Vec3>& footholds,
                               const estimation::TerrainPlane& plane, double yaw,
                               const UserCommand& user, double cycle_duration) const {
  const Mat2 R = rotation_about_z(yaw).topLeftCorner<2, 2>();
  Vec2 center = Vec2::Zero();
  const int num_legs = static_cast<int>(footholds.size());
  for (const Leg other : footholds.legs()) {
    center += (footholds[index(other)].head<2>() - R * nominal_offset(stance_, other, num_legs)) /
              num_legs;
  }
  // Feet of n legs in turn lie a stride's n-th apart, and the next one steps in front of all.
  const double ahead = (num_legs + 1) / (2.0 * num_legs) * cycle_duration;
  const Mat2 R_ahead = rotation_about_z(yaw + ahead * user.yaw_rate).topLeftCorner<2, 2>();
  const Vec3& from = footholds[index(leg)];
  const Vec2 goal =
      center + R_ahead * nominal_offset(stance_, leg, num_legs) + ahead * (R * user.velocity);
  const Vec2 near = limit_stretch(leg, goal, footholds, R.col(0));
  const Vec2 step = clip_norm<2>(near - from.head<2>(), options_.max_step);
  Vec3 nominal;
  nominal << from.head<2>() + step, 0.0;
  nominal.z() = expected_height(leg, nominal.head<2>(), footholds, plane);
  const Vec2 heading = R.col(0) * (user.velocity.x() < 0.0 ? -1.0 : 1.0);
  const bool follows = !is_front(leg) && options_.hind_use_front_prints;
  const Vec3 wanted = follows ? on_prints(prints(leg), nominal, from, heading) : nominal;
  return avoid_voids(leg, wanted, footholds, plane, heading);
}

double FootholdPlanner::expected_height(Leg leg, const Vec2& place, const PerLeg<Vec3>& footholds,
                                        const estimation::TerrainPlane& plane) const {
  const double height = plane.height(place);
  if (!is_front(leg) || !options_.bounded_by_feet) return height;
  const double way = (place - footholds[index(leg)].head<2>()).norm();
  const double beyond = way * last_slope(prints(leg));
  double highest = footholds[index(leg)].z();
  for (const Vec3& foothold : footholds) highest = std::max(highest, foothold.z());
  return std::min(height, highest + beyond);
}

double FootholdPlanner::last_slope(const Prints& prints) const {
  for (std::size_t i = 1; i < prints.size(); ++i) {
    const Vec3 stride = prints.newest(0) - prints.newest(i);
    const double length = stride.head<2>().norm(), rise = std::abs(stride.z());
    if (length < length_ * kMinStride) continue;
    return rise > kMaxSlope * length + options_.same_height ? 0.0 : rise / length;
  }
  return kInfinity;
}

// Keeps a front foot near the next foot on its side, which steps in its prints.
Vec2 FootholdPlanner::limit_stretch(Leg leg, const Vec2& goal, const PerLeg<Vec3>& footholds,
                                    const Vec2& heading) const {
  if (!is_front(leg) || !options_.hind_use_front_prints) return goal;
  const int num_legs = static_cast<int>(footholds.size());
  const Leg next = static_cast<Leg>(static_cast<int>(leg) + 2);
  const double ahead = heading.dot(goal - footholds[index(next)].head<2>());
  const double apart = 2.0 * stance_.half_length / (num_legs / 2 - 1);
  return goal - std::max(0.0, ahead - apart - options_.stretch_max) * heading;
}

void FootholdPlanner::avoid(const Vec3& p_WF) {
  voids_.add({p_WF.head<2>(), touchdowns_ + kAvoidedFor});
}

bool FootholdPlanner::is_void(const Vec2& place) const {
  for (std::size_t i = 0; i < voids_.size(); ++i) {
    const auto& [centre, until] = voids_.newest(i);
    if (touchdowns_ < until && (place - centre).norm() < options_.void_radius) return true;
  }
  return false;
}

// Tries half the step, then beyond the void, then beside it. Skips places out of reach, where the
// leg could not search for ground. Otherwise the foot steps on the spot.
Vec3 FootholdPlanner::avoid_voids(Leg leg, const Vec3& place, const PerLeg<Vec3>& footholds,
                                  const estimation::TerrainPlane& plane,
                                  const Vec2& heading) const {
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
    const bool is_near = other.norm() < kStepUpReach * options_.max_step &&
                         limit_stretch(leg, there, footholds, heading) == there;
    if (!is_near || is_void(there)) continue;
    Vec3 result;
    result << there, expected_height(leg, there, footholds, plane);
    return result;
  }
  return from;
}

void FootholdPlanner::remember(Leg leg, const Vec3& p_WF) {
  ++touchdowns_;
  if (is_front(leg)) prints(leg).add(p_WF);
}

void FootholdPlanner::forget() {
  prints_ = {};
  voids_ = {};
}

void FootholdPlanner::forget_last(Leg leg) {
  if (is_front(leg)) prints(leg).drop_newest();
}

// If the prints before and beyond the nominal foothold differ in height, there is an edge between
// them, and only the prints are safe: the foot steps on the one beyond or, if that is out of reach,
// on the one before. Elsewhere it may step between prints, at the height of the higher one.
Vec3 FootholdPlanner::on_prints(const Prints& prints, const Vec3& nominal, const Vec3& from,
                                const Vec2& heading) const {
  const auto [beyond, before, earlier] =
      prints_around(prints, nominal, heading, stance_.half_width, length_ * kMinStride);
  if (beyond == nullptr) return nominal;
  const auto ahead = [&](const Vec3& print) { return heading.dot((print - nominal).head<2>()); };
  const double rise = before == nullptr ? 0.0 : beyond->z() - before->z();
  const bool slope = earlier != nullptr && is_slope(*earlier, *before, *beyond, length_);
  const bool edge = std::abs(rise) > options_.same_height && !slope;
  const double reach = (edge && rise > 0.0 ? kStepUpReach : 1.0) * options_.max_step;
  const auto reachable = [&](const Vec3& print) { return (print - from).head<2>().norm() < reach; };
  const double least = length_ * kMinProgress;
  const bool can_wait = edge && heading.dot((*before - from).head<2>()) > least;
  if (edge && !reachable(*beyond)) return can_wait ? *before : step_toward(*beyond, from);
  const Vec3& nearest =
      edge || before == nullptr || ahead(*beyond) < -ahead(*before) ? *beyond : *before;
  const bool near = (nearest - nominal).head<2>().norm() < options_.print_radius;
  const bool progress = heading.dot((nearest - from).head<2>()) > least;
  if (edge || (near && progress && reachable(nearest))) return nearest;
  Vec3 between = nominal;
  between.z() = before == nullptr ? beyond->z() : std::max(before->z(), beyond->z());
  return between;
}

// As far as the leg reaches.
Vec3 FootholdPlanner::step_toward(const Vec3& print, const Vec3& from) const {
  const Vec2 way = (print - from).head<2>();
  const double longest = kForcedReach * options_.max_step;
  if (way.norm() < longest) return print;
  Vec3 goal;
  goal << from.head<2>() + clip_norm<2>(way, longest), std::max(print.z(), from.z());
  return goal;
}

}  // namespace surefoot::gaits
