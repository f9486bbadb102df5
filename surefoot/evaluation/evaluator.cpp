#include "surefoot/evaluation/evaluator.hpp"

#include "surefoot/evaluation/quantile.hpp"
#include "surefoot/signals/plan_event.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>

namespace surefoot::evaluation {
namespace {

constexpr double kReachTime = 6.0;      // after which a new reach is judged [s]
constexpr double kMinHipHeight = 0.12;  // above the mean stance foot; allows a crouch [m]
constexpr double kMaxTilt = 60.0 * kPi / 180.0;
constexpr double kMaxSitSpeed = 0.5;   // of a robot that sits down [m/s]
constexpr double kLandingForce = 5.0;  // normal force of a landed foot [N]
constexpr double kMinLoadShare = 0.1;  // of the weight, on a loaded foot

// Extremes start as NaN, and a NaN value changes nothing.
void raise(double& maximum, double value) {
  if (std::isnan(maximum) || value > maximum) maximum = value;
}
void lower(double& minimum, double value) {
  if (std::isnan(minimum) || value < minimum) minimum = value;
}

/// Do both ask for the same?
bool is_same(const ReachCommand& a, const ReachCommand& b) {
  const bool are_free = a.orientation.array().isNaN().all() && b.orientation.array().isNaN().all();
  return a.arm == b.arm && a.in_world == b.in_world && a.position == b.position &&
         (are_free || a.orientation == b.orientation);
}

double tilt(const Quat& q_SB) {
  return std::acos(std::clamp(q_SB.toRotationMatrix()(2, 2), -1.0, 1.0));
}

Quantiles quantiles(std::vector<double> times) {
  if (times.empty()) return {};
  std::sort(times.begin(), times.end());
  return {quantile(times, 0.5), quantile(times, 0.99), times.back()};
}

}  // namespace

void Evaluator::Squares::add(double value) {
  sum += value * value;
  ++count;
}

double Evaluator::Squares::root_mean() const { return count == 0 ? kNaN : std::sqrt(sum / count); }

void Evaluator::add(const simulation::GroundTruth& truth, const TickRecord& tick) {
  const CommandMode mode = tick.command.mode;
  if (is_off_its_feet(mode)) {
    add_off_its_feet(truth, tick);
  } else if (tick.command.cause == StopCause::none) {
    judge_plan(truth, tick);
  }
  add_progress(truth, tick);
  effort_.add(truth, tick.command.torque);
  add_body_contacts(truth);
  const bool may_lie = is_sensor(tick.command.cause) || mode == CommandMode::rise;
  check_fall(truth, may_lie, mode == CommandMode::lifted);
  ++ticks_;
}

// A lifted or rising robot follows no plan; estimate and plan restart afterwards.
void Evaluator::add_off_its_feet(const simulation::GroundTruth& truth, const TickRecord& tick) {
  const bool is_lifted = tick.command.mode == CommandMode::lifted;
  double& time = is_lifted ? metrics_.lifted_s : metrics_.standing_up_s;
  time += options_.control_period;
  raise(is_lifted ? metrics_.torque_lifted_max_nm : metrics_.torque_standing_up_max_nm,
        truth.torque.cwiseAbs().maxCoeff());
  estimate_ = {};
  plan_before_.reset();
}

// A stopped controller uses neither its plan nor its estimate.
void Evaluator::judge_plan(const simulation::GroundTruth& truth, const TickRecord& tick) {
  frame_.update(tick.plan, tick.model.p_WF, truth.p_SF);
  if (estimate_restarts(tick)) estimate_ = {};
  estimate_.add(truth, tick.state);
  touchdowns_.add(truth, tick.plan);
  losses_.add(truth, tick.plan);
  slips_.add(truth, tick);
  add_walk(truth, tick);
  add_com(truth, tick);
  add_torso(truth, tick);
  add_frames(tick);
  add_reach(truth, tick);
  for (const Leg leg : tick.plan.feet.legs()) add_foot(leg, truth, tick.plan.feet[index(leg)]);
}

void Evaluator::add_reach(const simulation::GroundTruth& truth, const TickRecord& tick) {
  const ReachCommand& command = tick.user.reach;
  if (!is_same(command, reach_)) reach_begin_ = truth.time;
  reach_ = command;
  const auto arm = static_cast<std::size_t>(tick.plan.arm.arm);
  if (tick.plan.arm.arm < 0 || arm >= truth.p_ST.size()) return;
  if (truth.time - reach_begin_ < options_.scale.time() * kReachTime) return;
  const Vec3 is = truth.q_SB.conjugate() * (truth.p_ST[arm] - truth.p_SB);
  const Vec3 wanted = tick.state.q_WB.conjugate() * (tick.plan.arm.p_WT - tick.state.p_WB);
  raise(metrics_.reach_error_max_m, (is - wanted).norm());
}

void Evaluator::add(const TickTiming& timing) {
  tick_times_.push_back(timing.total);
  solve_times_.push_back(timing.solve);
}

void Evaluator::add_progress(const simulation::GroundTruth& truth, const TickRecord& tick) {
  if (ticks_ == 0) start_ = truth.p_SB;
  end_ = truth.p_SB;
  if (tick.command.mode != CommandMode::optimal) ++metrics_.fallback_ticks;
  if (tick.command.mode == CommandMode::lifted) return;
  const bool calibrates = tick.plan.calibration != CalibrationStage::none;
  raise(calibrates ? metrics_.max_tilt_calibrating_rad : metrics_.max_tilt_rad, tilt(truth.q_SB));
}

void Evaluator::add_walk(const simulation::GroundTruth& truth, const TickRecord& tick) {
  for (const GaitEvent& event : tick.plan.events)
    metrics_.no_ground_events += event.kind == PlanEvent::no_ground ? 1 : 0;
  if (!tick.user.walk || tick.plan.calibration != CalibrationStage::none) return;
  if (walk_ticks_ == 0) walk_start_ = truth.p_SB;
  walk_end_ = truth.p_SB;
  path_.add(truth, tick.user, frame_.R_SW() * tick.plan.R_WC.col(0));
  command_.add(truth, tick.user);
  effort_.add_walk(truth);
  ++walk_ticks_;
}

void Evaluator::add_com(const simulation::GroundTruth& truth, const TickRecord& tick) {
  // The frames differ by a turn about the vertical, so the height of the plan's COM does not
  // matter.
  const Vec3 desired = frame_.to_S({tick.plan.com.p.x(), tick.plan.com.p.y(), 0.0});
  const double error = (truth.p_SCom - desired).head<2>().norm();
  raise(metrics_.com_zmp_slack_max_m, tick.plan.com_zmp_slack);
  if (tick.plan.calibration != CalibrationStage::none) {
    raise(metrics_.com_error_calibrating_max_m, error);
    return;
  }
  raise(metrics_.com_error_max_m, error);
  com_error_.add(error);
  if (!tick.user.walk) return;
  Vec3 centre = Vec3::Zero();
  for (const FootPlan& foot : tick.plan.feet)
    centre += foot.p_WF / static_cast<double>(tick.plan.feet.size());
  const Vec3 across = frame_.R_SW() * tick.plan.R_WC.col(1);
  const double lateral = across.dot(truth.p_SCom - frame_.to_S(centre));
  const bool first = walk_ticks_ == 1;
  sway_min_ = first ? lateral : std::min(sway_min_, lateral);
  sway_max_ = first ? lateral : std::max(sway_max_, lateral);
}

void Evaluator::add_torso(const simulation::GroundTruth& truth, const TickRecord& tick) {
  height_error_.add(truth.p_SB.z() - frame_.to_S({0.0, 0.0, tick.plan.torso.height}).z());
  orientation_error_.add(truth.q_SB.angularDistance(Quat(frame_.R_SW()) * tick.plan.torso.q_WB));
}

// A calibration restarts the plan, in its own world frame.
void Evaluator::add_frames(const TickRecord& tick) {
  const MotionPlan& now = tick.plan;
  const bool calibrates = now.calibration != CalibrationStage::none;
  if (plan_before_ && !calibrates) {
    const MotionPlan& before = *plan_before_;
    raise(metrics_.torso_reference_step_max_rad, now.torso.q_WB.angularDistance(before.torso.q_WB));
    raise(metrics_.torso_reference_step_max_m, std::abs(now.torso.height - before.torso.height));
    raise(metrics_.control_frame_step_max_rad, Quat(now.R_WC).angularDistance(Quat(before.R_WC)));
  }
  plan_before_ = calibrates ? std::nullopt : std::optional(now);
}

void Evaluator::add_foot(Leg leg, const simulation::GroundTruth& truth, const FootPlan& plan) {
  Foot& foot = feet_[index(leg)];
  const simulation::TrueContact& contact = truth.feet[index(leg)];
  const bool in_stance = in_contact(plan.phase);
  if (in_stance && !foot.was_contact) {
    ++metrics_.steps_taken;
    foot = {.was_contact = true, .landing_seen = false};
  }
  foot.was_contact = in_stance;
  foot.search = plan.phase == LegPhase::search ? foot.search + options_.control_period : 0.0;
  raise(metrics_.search_max_s, foot.search);
  raise(metrics_.penetration_max_m, contact.penetration);
  if (in_stance && contact.touching) add_stance(foot, contact);
  if (!options_.hip_in_base) return;
  const Vec3 p_BH = options_.hip_in_base(leg, truth.q.segment<kJointsPerLeg>(first_joint(leg)));
  raise(metrics_.limb_extension_max_m,
        (truth.p_SB + truth.q_SB * p_BH - truth.p_SF[index(leg)]).norm());
}

void Evaluator::add_stance(Foot& foot, const simulation::TrueContact& contact) {
  foot.slip += contact.slip_velocity.norm() * options_.control_period;
  raise(metrics_.foot_slip_max_m, foot.slip);
  const double normal_force = contact.normal.dot(contact.force);
  add_friction(contact, normal_force);
  const double landed = options_.scale.force() * kLandingForce;
  if (normal_force < landed || foot.landing_seen || !options_.terrain_height) return;
  foot.landing_seen = true;
  if (is_edge_landing(options_.terrain_height, contact.point, contact.normal, options_.scale))
    ++metrics_.edge_landings;
}

void Evaluator::add_friction(const simulation::TrueContact& contact, double normal_force) {
  if (normal_force <= 0.0) return;
  const double tangential_force = (contact.force - normal_force * contact.normal).norm();
  // Rounding gives a sliding foot ±1e-16.
  const double margin = std::max(0.0, contact.friction - tangential_force / normal_force);
  lower(metrics_.friction_margin_min, margin);
  if (normal_force >= kMinLoadShare * options_.mass * kGravity) {
    lower(metrics_.friction_margin_loaded_min, margin);
  }
}

void Evaluator::add_body_contacts(const simulation::GroundTruth& truth) {
  const auto bits = [](int mask) { return static_cast<unsigned>(mask); };
  metrics_.shank_contacts += std::popcount(bits(truth.shank_contacts) & ~bits(shanks_touched_));
  metrics_.torso_contacts += truth.torso_contact && !torso_touched_ ? 1 : 0;
  shanks_touched_ = truth.shank_contacts;
  torso_touched_ = truth.torso_contact;
}

void Evaluator::check_fall(const simulation::GroundTruth& truth, bool may_lie, bool hangs) {
  double sum = 0.0;
  int count = 0;
  for (const Leg leg : truth.feet.legs()) {
    if (!truth.feet[index(leg)].touching) continue;
    sum += truth.p_SF[index(leg)].z();
    ++count;
  }
  if (count > 0) footprint_height_ = sum / count;
  const double height = truth.p_SB.z() - footprint_height_;
  metrics_.base_height_end_m = height;
  if (metrics_.fell) return;
  std::array<char, 96> text{};
  const bool is_too_low =
      height + options_.scale.hip_height < options_.scale.length * kMinHipHeight;
  const bool lands_softly = may_lie && truth.v_SB.z() > -(options_.scale.speed() * kMaxSitSpeed);
  if (truth.torso_contact && !lands_softly) {
    std::snprintf(text.data(), text.size(), "fell at %.4f s: the torso touched the ground",
                  truth.time);
  } else if (is_too_low && !may_lie && !hangs) {
    std::snprintf(text.data(), text.size(),
                  "fell at %.4f s: the base came down to %.2f m above the feet", truth.time,
                  height);
  } else if (!(tilt(truth.q_SB) <= kMaxTilt) && !hangs) {
    std::snprintf(text.data(), text.size(), "fell at %.4f s: tilted by more than 60°", truth.time);
  } else {
    return;
  }
  metrics_.fell = true;
  fall_ = text.data();
}

Metrics Evaluator::metrics(const RunEnd& end) const {
  Metrics result = metrics_;
  estimate_.write(result);
  touchdowns_.write(result);
  losses_.write(result);
  slips_.write(result);
  path_.write(result);
  command_.write(result);
  result.reason = metrics_.fell ? fall_ : end.reason;
  result.goal_reached = end.goal_reached;
  result.duration_s = ticks_ * options_.control_period;
  result.distance_m = (end_ - start_).head<2>().norm();
  const double walked_s = walk_ticks_ * options_.control_period;
  const double way = (walk_end_ - walk_start_).head<2>().norm();
  effort_.write(way, result);
  if (walk_ticks_ > 0) result.speed_mps = way / walked_s;
  if (walk_ticks_ > 0) result.com_lateral_sway_m = (sway_max_ - sway_min_) / 2.0;
  result.com_error_rms_m = com_error_.root_mean();
  result.base_height_error_rms_m = height_error_.root_mean();
  result.orientation_error_rms_rad = orientation_error_.root_mean();
  result.tick_us = quantiles(tick_times_);
  result.solve_us = quantiles(solve_times_);
  result.realtime_factor = result.duration_s / end.wall_seconds;
  result.seed = end.seed;
  result.version = end.version;
  return result;
}

}  // namespace surefoot::evaluation
