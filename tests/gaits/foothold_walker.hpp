#pragma once

#include "surefoot/gaits/parts/foothold_planner.hpp"
#include "surefoot/math/rotation.hpp"

#include <algorithm>
#include <array>

namespace surefoot::test {

inline constexpr double kCycle = 4.0;  // [s]
inline constexpr std::array kOrder{Leg::LH, Leg::LF, Leg::RH, Leg::RF};

inline Vec2 turned(double angle, const Vec2& v) {
  return rotation_about_z(angle).topLeftCorner<2, 2>() * v;
}

inline UserCommand command(double forward, double lateral = 0.0, double yaw_rate = 0.0) {
  return {.walk = true, .velocity = {forward, lateral}, .yaw_rate = yaw_rate};
}

/// Footholds that a planner leads over level ground.
struct Walker {
  explicit Walker(const gaits::FootholdOptions& options,
                  const gaits::StanceOptions& stance_options = {})
      : stance(stance_options), planner(stance_options, options) {}

  void stand(const Vec2& center, double heading) {
    yaw = heading;
    for (const Leg leg : kLegs) {
      feet[index(leg)] << center + turned(yaw, gaits::nominal_offset(stance, leg, kNumLegs)),
          ground;
    }
  }
  [[nodiscard]] estimation::TerrainPlane plane() const {
    return {Vec3::UnitZ(), Vec3(0, 0, ground)};
  }
  [[nodiscard]] Vec3 next(Leg leg, const UserCommand& user) const {
    return planner.foothold(leg, feet, plane(), yaw, user, kCycle);
  }
  /// One leg goes, a quarter of the cycle passes.
  void step(const UserCommand& user) {
    const Leg leg = kOrder[static_cast<std::size_t>(steps++) % kOrder.size()];
    const Vec3 goal = next(leg, user);
    last_step = goal - feet[index(leg)];
    feet[index(leg)] = goal;
    planner.remember(leg, goal);
    yaw += 0.25 * kCycle * user.yaw_rate;
  }
  void walk(int count, const UserCommand& user) {
    for (int i = 0; i < count; ++i) step(user);
  }
  /// Where the stance's middle is, from a foot's own place in it.
  [[nodiscard]] Vec2 center_by(Leg leg) const {
    return feet[index(leg)].head<2>() - turned(yaw, gaits::nominal_offset(stance, leg, kNumLegs));
  }
  [[nodiscard]] Vec2 center() const {
    Vec2 sum = Vec2::Zero();
    for (const Leg leg : kLegs) sum += 0.25 * center_by(leg);
    return sum;
  }
  /// Largest distance of a foot from its nominal place.
  [[nodiscard]] double distortion() const {
    double largest = 0.0;
    for (const Leg leg : kLegs) largest = std::max(largest, (center_by(leg) - center()).norm());
    return largest;
  }

  gaits::StanceOptions stance;
  gaits::FootholdPlanner planner;
  PerLeg<Vec3> feet;
  double yaw = 0.0;
  double ground = 0.031;
  int steps = 0;
  Vec3 last_step = Vec3::Zero();
};

}  // namespace surefoot::test
