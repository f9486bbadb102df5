#include "surefoot/planning/capture_step.hpp"

#include "surefoot/math/types.hpp"

namespace surefoot {
namespace {

constexpr int kTried = 8;           // steps on the way
constexpr double kFootRoom = 0.12;  // between two feet [m]

Vec2 within(const Vec2& p, const Vec2& centre, double radius) {
  const Vec2 from = p - centre;
  return from.norm() > radius ? Vec2(centre + radius / from.norm() * from) : p;
}

bool has_room(const PerLeg<Vec2>& feet, Leg leg) {
  for (const Leg other : kLegs) {
    if (other != leg && (feet[index(other)] - feet[index(leg)]).norm() < kFootRoom) return false;
  }
  return true;
}

}  // namespace

CaptureStep find_capture_step(const CaptureProblem& problem, Leg leg, const PushOptions& options) {
  const PerLeg<double> all{1.0, 1.0, 1.0, 1.0};
  const Vec2& from = problem.feet[index(leg)];
  const double out = problem.out.norm();
  const Vec2 direction = out > 0.0 ? Vec2(problem.out / out) : Vec2::Zero();
  const Vec2 behind = problem.capture_point + options.capture_margin * direction;
  CaptureStep best{.goal = from};
  PerLeg<Vec2> feet = problem.feet;
  for (int i = 0; i <= kTried; ++i) {
    const double share = static_cast<double>(i) / kTried;
    const Vec2 asked = within(from + share * (behind - from), from, options.step_max);
    feet[index(leg)] = within(asked, problem.hip, problem.reach);
    const double margin = SupportRegion(feet, all).margin(problem.capture_point);
    if (!has_room(feet, leg) || margin <= best.margin) continue;
    best = {feet[index(leg)], margin};
    if (margin >= options.capture_margin) break;
  }
  return best;
}

}  // namespace surefoot
