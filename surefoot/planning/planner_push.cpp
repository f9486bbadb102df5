// What the planner does about pushes.
#include "surefoot/math/rotation.hpp"
#include "surefoot/planning/planner.hpp"

#include <algorithm>

namespace surefoot {
namespace {

constexpr double kLiftOffMargin = 0.01;  // capture point inside the other feet's triangle by [m]
constexpr double kShortestPlan = 0.08;   // left of a phase that a new plan can use [s]
constexpr double kStandDuration = 1.0;   // [s]
constexpr double kLevel = 1e-3;          // apex of a move that does not rise [m]

}  // namespace

void Planner::react_to_push(const UserCommand& user, const RobotState& state,
                            const Dynamics& dynamics) {
  const double ground = plane_.height(dynamics.com.p.head<2>());
  balance_.update(state, dynamics, std::max(0.1, dynamics.com.p.z() - ground));
  if (!options_.push.enabled) return;
  LegMotion& next = leg(next_leg());
  const Vec2 out = balance_.excess(region_without(next_leg(), dynamics));
  if (mode_ == Mode::swing && next.phase() == LegPhase::swing) {
    const double left = deadline_ - time_;
    const bool soon = left < options_.push.foot_down_duration;
    if (!soon && out.norm() * balance_.growth(left) > options_.push.foot_down_excess) {
      put_foot_down(next_leg(), out, user, dynamics);
    }
  } else if (mode_ == Mode::support && next.phase() == LegPhase::unloading && out.norm() > 0.0 &&
             !balance_.is_steady()) {
    event_ = PlanEvent::push_reloaded;
    next.reload(time_);
    begin_support(user, options_.gait.switch_duration);
    replan_com(user, dynamics);
  }
  if (balance_.wants_plan(time_) && until_switch() > kShortestPlan) replan_com(user, dynamics);
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

// The shortest way to the ground, a little towards where the robot tips.
void Planner::put_foot_down(Leg k, const Vec2& out, const UserCommand& user,
                            const Dynamics& dynamics) {
  event_ = PlanEvent::push_foot_down;
  probing_ = false;
  const Vec3& p_WF = dynamics.foot[index(k)].p;
  Vec3 goal = p_WF;
  goal.head<2>() += options_.push.foot_down_step * out.normalized();
  goal.z() = plane_.height(goal.head<2>());
  swing_again(k, {p_WF, goal, plane_.normal, options_.push.foot_down_duration, kLevel}, user,
              dynamics);
}

SupportRegion Planner::region_without(Leg k, const Dynamics& dynamics) const {
  PerLeg<Vec2> feet;
  PerLeg<double> share{1.0, 1.0, 1.0, 1.0};
  share[index(k)] = 0.0;
  for (const Leg other : kLegs) feet[index(other)] = dynamics.foot[index(other)].p.head<2>();
  return SupportRegion(feet, share);
}

bool Planner::balanced_without(Leg k, const Dynamics& dynamics) const {
  const bool inside = region_without(k, dynamics).margin(balance_.capture_point()) > kLiftOffMargin;
  return inside && balance_.is_steady();
}

}  // namespace surefoot
