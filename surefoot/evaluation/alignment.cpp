#include "surefoot/evaluation/alignment.hpp"

#include "surefoot/math/rotation.hpp"

#include <cmath>

namespace surefoot::evaluation {
namespace {

WorldPose inverse(const Mat3& R_SW, const Vec3& p_SW) {
  return {-(R_SW.transpose() * p_SW), Quat(Mat3(R_SW.transpose()))};
}

}  // namespace

const Alignment& Aligner::update(const simulation::GroundTruth& truth, const TickRecord& tick) {
  alignment_ = {};
  alignment_.time = truth.time;
  if (estimate_restarts(tick)) start_.reset();
  if (!start_) start_ = start_alignment(truth, tick.state);
  if (start_) compare_estimate(truth, tick.state);
  if (tick.command.cause == StopCause::none && !is_off_its_feet(tick.command.mode)) {
    frame_.update(tick.plan, tick.model.p_WF, truth.p_SF);
    compare_plan(truth, tick.plan);
  }
  return alignment_;
}

void Aligner::compare_plan(const simulation::GroundTruth& truth, const MotionPlan& plan) {
  alignment_.feet = inverse(frame_.R_SW(), frame_.to_S(Vec3::Zero()));
  const auto to_W = [this](const Vec3& p_S) -> Vec3 {
    return alignment_.feet.q_WS * p_S + alignment_.feet.p_WS;
  };
  alignment_.com_error = to_W(truth.p_SCom).head<2>() - plan.com.p;
  alignment_.height_error = to_W(truth.p_SB).z() - plan.torso.height;
}

void Aligner::compare_estimate(const simulation::GroundTruth& truth, const RobotState& state) {
  alignment_.start = inverse(start_->R_SW, start_->p_SW);
  const AlignedEstimate estimate = aligned(*start_, truth, state);
  alignment_.base_error = alignment_.start.q_WS * (estimate.p_SB - truth.p_SB);
  alignment_.heading_error = estimate.heading_error;
}

}  // namespace surefoot::evaluation
