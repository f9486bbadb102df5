#pragma once

#include "surefoot/gaits/parts/leg_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

namespace surefoot::test {

inline constexpr double kPeriod = 0.0025;
inline const Vec3 kUp = Vec3::UnitZ();
inline const Vec3 kNoForce = Vec3::Zero();
inline constexpr double kHipHeight = 0.22;  // low, so that the leg is long enough for all [m]
inline const gaits::SwingOptions kSwing{.hip_height_min = 0.2};

inline gaits::LegMotion make_leg(const gaits::ForceOptions& force = {}) {
  gaits::PlannerOptions options;
  options.force = force;
  options.swing = kSwing;
  return gaits::LegMotion(options, kPeriod);
}

/// A leg and the foot that it moves.
struct Bench {
  Bench() = default;
  explicit Bench(const gaits::ForceOptions& force) : leg(make_leg(force)) {}

  gaits::LegEvent observe(const Vec3& force) {
    const double ground = std::max(p.z(), leg.foothold().z());
    const Vec3 over_foot(p.x(), p.y(), ground + kHipHeight);
    const model::PointKinematics hip_point{.p = hip ? *hip : over_foot, .v = hip_velocity};
    const Vec3 v = foot_velocity ? *foot_velocity : leg.plan(time).v_WF;
    const model::PointKinematics foot{.p = p, .v = v};
    return leg.observe(time, {hip_point, foot, force, kUp, force_per_torque});
  }
  gaits::LegEvent observe(double normal_force) { return observe(normal_force * kUp); }

  /// The foot follows its reference, shifted, under a force, until something happens or `duration`
  /// is over.
  gaits::LegEvent follow(double duration, double normal_force, const Vec3& behind = Vec3::Zero()) {
    const double end = time + duration;
    gaits::LegEvent event = gaits::LegEvent::none;
    while (event == gaits::LegEvent::none && time < end - 0.5 * kPeriod) {
      time += kPeriod;
      p = leg.plan(time).p_WF + behind;
      event = observe(normal_force);
    }
    return event;
  }
  /// The foot stays where it is.
  gaits::LegEvent rest(double duration, double normal_force) {
    const double end = time + duration;
    gaits::LegEvent event = gaits::LegEvent::none;
    while (event == gaits::LegEvent::none && time < end - 0.5 * kPeriod) {
      time += kPeriod;
      event = observe(normal_force);
    }
    return event;
  }

  gaits::LegMotion leg = make_leg();
  double time = 10.0;
  Vec3 p{1.0, 2.0, 0.03};
  std::optional<Vec3> hip;  // without one the leg is never too short
  Vec3 hip_velocity = Vec3::Zero();
  double force_per_torque = 0.0;      // [1/m]
  std::optional<Vec3> foot_velocity;  // without one that of the reference
};

inline constexpr double kDuration = 0.5;  // of a swing [s]

/// A foot that has just left the ground for a step forward.
inline Bench swinging() {
  Bench bench;
  bench.leg.plant(bench.time - 5.0, bench.p);
  EXPECT_EQ(bench.observe(50.0), gaits::LegEvent::none);
  bench.leg.lift(bench.time, {bench.p, bench.p + Vec3(0.2, 0.0, 0.0), kUp, kDuration, 0.08});
  return bench;
}

/// A foot that is past its expected touchdown.
inline Bench searching() {
  Bench bench = swinging();
  EXPECT_EQ(bench.follow(kDuration + 0.05, 0.0), gaits::LegEvent::none);
  EXPECT_EQ(bench.leg.phase(), LegPhase::search);
  return bench;
}

}  // namespace surefoot::test
