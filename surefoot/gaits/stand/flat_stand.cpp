#include "surefoot/gaits/stand/flat_stand.hpp"

#include "surefoot/math/rotation.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::gaits {
namespace {

constexpr double kForward = 0.5;  // share of half a sole
constexpr double kSquat = 0.25;   // share of the height
constexpr double kRate = 2.5;     // of the references [1/s]

}  // namespace

void FlatStand::Reference::follow(double target, double rate, double dt) {
  a = rate * rate * (target - p) - 2.0 * rate * v;
  v += dt * a;
  p += dt * v;
}

void FlatStand::update(const UserCommand& command, const RobotState& state,
                       const model::Dynamics& dynamics, MotionPlan& plan) noexcept {
  if (!has_begun_) begin(state, dynamics, plan);
  follow_feet(dynamics, plan);
  const double rate = scale_.rate() * kRate;
  forward_.follow(std::clamp(command.shift.x(), -reach_.x(), reach_.x()), rate, period_);
  left_.follow(std::clamp(command.shift.y(), -reach_.y(), reach_.y()), rate, period_);
  up_.follow(std::clamp(command.height, -kSquat * height_, 0.0), rate, period_);
  plan.time = state.time;
  plan.events = {};
  plan.torso.height = middle_.z() + height_ + up_.p;
  plan.torso.height_rate = up_.v;
  plan.torso.height_acceleration = up_.a;
  plan_com(dynamics, plan);
}

// The centre of mass begins where it is, so that nothing jumps.
void FlatStand::begin(const RobotState& state, const model::Dynamics& dynamics, MotionPlan& plan) {
  has_begun_ = true;
  yaw_ = yaw(state.R_WB());
  plan = MotionPlan{};
  FootPlan stance;
  stance.force_min = force_.min;
  stance.force_max = force_.max;
  plan.feet = PerLeg<FootPlan>(dynamics.num_legs(), stance);
  follow_feet(dynamics, plan);
  plan.torso.q_WB = Quat(rotation_about_z(yaw_));
  plan.R_WC = rotation_about_z(yaw_);
  height_ = state.p_WB.z() - middle_.z();
  const Mat3 to_heading = plan.R_WC.transpose();
  reach_ << kForward * dynamics.sole.x(), 0.0;
  for (const FootPlan& foot : plan.feet)
    reach_.y() = std::max(reach_.y(), std::abs((to_heading * (foot.p_WF - middle_)).y()));
  const Vec3 com = to_heading * (dynamics.com.p - middle_);
  forward_ = {.p = com.x()};
  left_ = {.p = com.y()};
  up_ = {};
}

// The feet stay, but their estimates drift.
void FlatStand::follow_feet(const model::Dynamics& dynamics, MotionPlan& plan) {
  middle_.setZero();
  for (const Leg leg : plan.feet.legs()) {
    plan.feet[index(leg)].p_WF = dynamics.contact[index(leg)].p;
    plan.feet[index(leg)].friction = force_.friction;
    middle_ += dynamics.contact[index(leg)].p / dynamics.num_legs();
  }
  plan.terrain_point = middle_;
}

void FlatStand::plan_com(const model::Dynamics& dynamics, MotionPlan& plan) const {
  const Mat2 heading = plan.R_WC.topLeftCorner<2, 2>();
  plan.com.p = middle_.head<2>() + heading * Vec2(forward_.p, left_.p);
  plan.com.v = heading * Vec2(forward_.v, left_.v);
  plan.com.a = heading * Vec2(forward_.a, left_.a);
  plan.com.zmp = plan.com.p - (dynamics.com.p.z() - middle_.z()) / kGravity * plan.com.a;
}

}  // namespace surefoot::gaits
