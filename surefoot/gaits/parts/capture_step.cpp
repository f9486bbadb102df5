#include "surefoot/gaits/parts/capture_step.hpp"

#include "surefoot/math/disc.hpp"

#include <cmath>

namespace surefoot::gaits {
namespace {

constexpr int kLengths = 4, kDirections = 12;  // of the candidate steps

bool has_room(const PerLeg<Vec2>& feet, Leg leg, double room) {
  for (const Leg other : feet.legs()) {
    if (other != leg && (feet[index(other)] - feet[index(leg)]).norm() < room) return false;
  }
  return true;
}

}  // namespace

CaptureStep find_capture_step(const CaptureProblem& problem, Leg leg, const PushOptions& options) {
  const Vec2 from = problem.feet[index(leg)];
  CaptureStep best{.goal = from};
  PerLeg<Vec2> feet = problem.feet;
  const auto everywhere = per_leg(1.0, static_cast<int>(feet.size()));
  for (int i = 0; i <= kLengths; ++i) {
    const double length = options.step_max * i / kLengths;
    for (int j = 0; j < (i == 0 ? 1 : kDirections); ++j) {
      const double angle = problem.heading + 2.0 * kPi * j / kDirections;
      const Vec2 asked = from + length * Vec2(std::cos(angle), std::sin(angle));
      feet[index(leg)] = nearest_within(asked, problem.hip, problem.reach);
      const double margin = SupportRegion(feet, everywhere).margin(problem.capture_point);
      if (has_room(feet, leg, problem.foot_room) && margin > best.margin)
        best = {feet[index(leg)], margin};
    }
    if (best.margin >= options.capture_margin) break;
  }
  return best;
}

}  // namespace surefoot::gaits
