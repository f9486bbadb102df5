// What the planner does about pushes.
#include "surefoot/gaits/planner.hpp"
#include "surefoot/math/rotation.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace surefoot {
namespace {

constexpr double kOffPlan = 0.01;       // the COM from its plan: that one can't be followed [m]
constexpr double kShortestPlan = 0.08;  // left of a phase that a new plan can use [s]
constexpr double kWorthAStep = 0.01;    // better balanced with it than without by [m]
constexpr double kAgility = 45.0;       // that drives give a foot in the air [m/s²]
constexpr double kAtRest = 0.06;        // a COM that is slower has been caught [m/s]
constexpr double kLonger = 1.1;         // a hasty swing takes so many times as long …
constexpr double kLongest = 2.0;        // … and again, up to about so many times, for its drives

}  // namespace

void Planner::react_to_push(const UserCommand& user, const RobotState& state,
                            const Dynamics& dynamics) {
  balance_.update(state, dynamics, com_height(dynamics));
  if (recovering_ && mode_ != Mode::swing && is_calm(dynamics)) {  // from a push or a slip
    recovering_ = false;
    if (mode_ == Mode::support) begin_support(user, options_.gait.switch_duration);
    replan_com(user, dynamics);
  }
  if (!options_.push.enabled) return;
  const Leg next = next_leg();
  if (mode_ == Mode::swing && leg(next).phase() == LegPhase::swing) {
    if (tips_before_landing(dynamics)) put_foot_down(next, user, dynamics);
  } else if (mode_ == Mode::support && leg(next).phase() == LegPhase::unloading &&
             !balance_.is_steady()) {
    event_ = PlanEvent::push_reloaded;
    leg(next).reload(time_);
    begin_support(user, options_.gait.switch_duration);
    recovering_ = true;
    replan_com(user, dynamics);
  }
  if (mode_ != Mode::swing) step_to_recover(user, dynamics);
  const bool off = (dynamics.com.p.head<2>() - plan_.com.p).norm() > kOffPlan;
  const bool wants_plan = balance_.wants_plan(time_) || (off && balance_.may_plan(time_));
  if (wants_plan && until_switch() > kShortestPlan) replan_com(user, dynamics);
}

bool Planner::is_agile(const SwingTarget& target) const {
  return SwingCurve(target, options_.swing).peak_acceleration() < kAgility;
}

bool Planner::is_calm(const Dynamics& dynamics) const {
  return all_down() && balance_.is_steady() && dynamics.com.v.head<2>().norm() < kAtRest &&
         balance_margin(dynamics) > options_.push.calm_margin;
}

bool Planner::tips_before_landing(const Dynamics& dynamics) const {
  if (leg(next_leg()).target().straight) return false;  // it is on its way down
  const double left = deadline_ - time_;
  if (left < options_.push.foot_down_duration) return false;  // it lands as soon as it can
  const Vec2 out = balance_.excess(region_without(next_leg(), dynamics));
  return out.norm() * balance_.growth(left) > options_.push.foot_down_excess;
}

double Planner::until_switch() const {
  if (mode_ == Mode::swing) return deadline_ - time_;
  if (mode_ == Mode::support) return lift_time_ - time_;
  return kStandDuration;
}

PerLeg<Vec2> Planner::leaning_hips() const {
  PerLeg<Vec2> result = hips_;
  const Mat2 R = rotation_about_z(-yaw_).topLeftCorner<2, 2>();
  for (Vec2& hip : result) hip -= R * balance_.shift();
  return result;
}

// The shortest way to the ground that catches the robot.
void Planner::put_foot_down(Leg k, const UserCommand& user, const Dynamics& dynamics) {
  event_ = PlanEvent::push_foot_down;
  probing_ = false;
  emergency_ = recovering_ = true;
  const FootPlan& now = plan_.feet[index(k)];  // goes on from here: the foot has its speed
  SwingTarget target{.start = now.p_WF + period_ * now.v_WF,
                     .normal = plane_.normal,
                     .duration = options_.push.foot_down_duration,
                     .straight = true,
                     .velocity = now.v_WF};
  const auto aim = [&] {
    target.goal.head<2>() = capture_step(k, target.duration, dynamics).goal;
    target.goal.z() = plane_.height(target.goal.head<2>());
  };
  const double longest = kLongest * target.duration;
  for (aim(); !is_agile(target) && target.duration < longest; aim()) target.duration *= kLonger;
  swing_again(k, target, user, dynamics);
}

CaptureStep Planner::capture_step(Leg k, double duration, const Dynamics& dynamics) const {
  const SupportRegion others = region_without(k, dynamics);
  CaptureProblem problem;
  problem.heading = yaw_;
  for (const Leg other : kLegs)
    problem.feet[index(other)] = dynamics.foot[index(other)].p.head<2>();
  if (!leg(k).down())  // its speed takes it on: the least turn is from where it would come to rest
    problem.feet[index(k)] += 0.5 * duration * plan_.feet[index(k)].v_WF.head<2>();
  problem.capture_point = balance_.capture_point_after(others, duration);
  problem.hip = (dynamics.hip[index(k)].p + duration * dynamics.com.v).head<2>();
  problem.reach = horizontal_reach(options_.stance.height);
  return find_capture_step(problem, k, options_.push);
}

void Planner::step_to_recover(const UserCommand& user, const Dynamics& dynamics) {
  if (!options_.push.steps || !balance_.is_pushed() || !all_down()) return;
  const double margin = balance_margin(dynamics);
  if (margin > options_.push.step_margin) return;
  Leg best = Leg::LF;
  CaptureStep step;
  for (const Leg k : kLegs) {
    if (leg(k).since(time_) < options_.force.ramp_up) return;  // one has only just come down
    const CaptureStep found = capture_step(k, options_.push.step_duration, dynamics);
    if (found.margin > step.margin) std::tie(best, step) = std::pair(k, found);
  }
  const double growth = balance_.growth(options_.push.step_duration);
  const double without = margin < 0.0 ? growth * margin : margin;
  if (step.margin < without + kWorthAStep) return;
  event_ = PlanEvent::push_step;
  begin_swing();
  emergency_ = recovering_ = true;
  for (const Leg k : kLegs) {
    if (k != best && leg(k).phase() == LegPhase::unloading) leg(k).reload(time_);
  }
  go_on_with(best);
  const Vec3& p_WF = dynamics.foot[index(best)].p;
  Vec3 goal;
  goal << step.goal, plane_.height(step.goal);
  SwingTarget target{p_WF, goal, plane_.normal, options_.push.step_duration,
                     options_.push.step_apex};
  const double longest = kLongest * target.duration;
  while (!is_agile(target) && target.duration < longest) target.duration *= kLonger;
  swing_again(best, target, user, dynamics);
}

SupportRegion Planner::region_without(Leg k, const Dynamics& dynamics) const {
  PerLeg<double> share{1.0, 1.0, 1.0, 1.0};
  share[index(k)] = 0.0;
  return region(share, dynamics);
}

SupportRegion Planner::region(const PerLeg<double>& share, const Dynamics& dynamics) const {
  PerLeg<Vec2> feet;
  for (const Leg k : kLegs) feet[index(k)] = dynamics.foot[index(k)].p.head<2>();
  return SupportRegion(feet, share);
}

double Planner::balance_margin(const Dynamics& dynamics) const {
  return region({1.0, 1.0, 1.0, 1.0}, dynamics).margin(balance_.capture_point());
}

bool Planner::balanced_without(Leg k, const Dynamics& dynamics) const {
  const double margin = region_without(k, dynamics).margin(balance_.capture_point());
  return margin > options_.push.lift_off_margin && balance_.is_steady();
}

}  // namespace surefoot
