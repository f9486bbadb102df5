#include "surefoot/evaluation/start_alignment.hpp"

#include "surefoot/math/rotation.hpp"
#include "surefoot/signals/plan_event.hpp"

#include <cmath>

namespace surefoot::evaluation {
namespace {

constexpr double kSameTime = 1e-9;  // [s]

}  // namespace

std::optional<StartAlignment> start_alignment(const simulation::GroundTruth& truth,
                                              const RobotState& state) {
  if (std::abs(truth.time) > kSameTime) return std::nullopt;
  const Mat3 R = state.R_WB();
  if (!R.allFinite() || !state.p_WB.allFinite()) return std::nullopt;
  const Mat3 turn = rotation_about_z(yaw(truth.q_SB.toRotationMatrix()) - yaw(R));
  return StartAlignment{turn, truth.p_SB - turn * state.p_WB};
}

bool estimate_restarts(const TickRecord& tick) {
  return tick.plan.events.has(PlanEvent::begun_anew);
}

AlignedEstimate aligned(const StartAlignment& start, const simulation::GroundTruth& truth,
                        const RobotState& state) {
  const Vec3 p = start.R_SW * state.p_WB + start.p_SW;
  const Mat3 R = start.R_SW * state.R_WB();
  const double turned = yaw(R) - yaw(truth.q_SB.toRotationMatrix());
  return {p, Quat(R), (p - truth.p_SB).norm(), std::remainder(turned, 2.0 * kPi)};
}

}  // namespace surefoot::evaluation
