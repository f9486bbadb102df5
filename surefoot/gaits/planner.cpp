#include "surefoot/gaits/planner.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/math/rotation.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace surefoot::gaits {

Planner::Planner(const PlannerOptions& options, double period, const Scale& scale)
    : body_(options, period, scale),
      flat_stand_(options.force, period, scale),
      crawl_(options),
      rhythmic_(options.rhythm, scale),
      limits_(options, period, scale),
      torso_(options.torso, period),
      friction_frame_(options.friction_frame, period),
      calibration_(options.calibration, scale),
      rest_(scale),
      hips_(options.gait.num_legs(), Vec2::Zero()) {
  plan_.feet.resize(options.gait.num_legs());
}

void Planner::begin_anew(const Planner& fresh) {
  const int steps_taken = body_.steps_taken;
  *this = fresh;
  body_.steps_taken = steps_taken;
}

void Planner::set_friction(double friction) {
  if (!(friction > 0.0) || !std::isfinite(friction)) {
    throw Error("friction is " + std::to_string(friction) + "; valid is a number above 0");
  }
  body_.grip.expect(friction);
}

const MotionPlan& Planner::update(const UserCommand& command, const RobotState& state,
                                  const model::Dynamics& dynamics,
                                  const HierarchyOutcome& last) noexcept {
  if (dynamics.has_flat_feet()) {
    flat_stand_.update(command, state, dynamics, plan_);
    return plan_;
  }
  body_.events = {};
  if (!initialised_) calibration_.expect_switch(command.calibrate);  // a calibration begins anyway
  if (!initialised_ || restarts_) initialise(state, dynamics);
  calibration_.update(state.time, command.calibrate, is_undisturbed(state));
  const UserCommand user = limit(command);
  Situation now{state.time, yaw_, user, state, dynamics, last, plan_, body_};
  move_legs(now);
  finish_calibration(state);
  write_plan(now);
  return plan_;
}

void Planner::initialise(const RobotState& state, const model::Dynamics& dynamics) {
  initialised_ = learns_ground_ = true;
  restarts_ = false;
  calibration_.begin(state.time);
  yaw_ = surefoot::yaw(state.R_WB());
  for (const Leg k : body_.legs.all()) {
    body_.legs[k].plant(state.time, dynamics.foot[index(k)].p, true);
    const Vec3 hip = rotation_about_z(-yaw_) * (dynamics.hip[index(k)].p - state.p_WB);
    hips_[index(k)] = hip.head<2>();
  }
  relearn_ground();
  friction_frame_.restart(body_.plane.normal);
  torso_.restart(state);
  const UserCommand nothing;
  const HierarchyOutcome unknown;
  Situation now{state.time, yaw_, nothing, state, dynamics, unknown, plan_, body_};
  stand_.begin(now, body_, {});
}

void Planner::relearn_ground() {
  learns_ground_ = learns_ground_ && calibration_.is_going_on();
  body_.learn_ground();
}

// The torso leans against a push, which moves the hips.
CommandContext Planner::command_context() const {
  CommandContext context{.cycle_duration = walk().stride_duration(body_.pace()),
                         .pace = body_.pace(),
                         .caution = body_.grip.caution(),
                         .hips = hips_,
                         .stands = !walks_,
                         .starts_at_rest = !walk().is_static(),
                         .calibrates = calibration_.is_due()};
  if (!walk().is_static()) return context;
  context.caution = std::max(context.caution, body_.balance.caution());
  const Mat2 R = rotation_about_z(-yaw_).topLeftCorner<2, 2>();
  for (Vec2& hip : context.hips) hip -= R * body_.balance.shift();
  return context;
}

// The heading waits for the feet: otherwise late steps would leave them twisted under the torso.
UserCommand Planner::limit(const UserCommand& command) {
  const CommandContext now = command_context();
  UserCommand user = limits_.update(command, now);
  user.walk = user.walk && !calibration_.is_due();
  if (walk().is_static()) {
    user.yaw_rate *= limits_.strides().turning_share(user.yaw_rate, body_.legs.footholds(),
                                                     body_.legs.down(), yaw_, now.cycle_duration);
  }
  yaw_rate_ = user.walk && !gait().waits(body_) ? user.yaw_rate : 0.0;
  yaw_ += body_.period * yaw_rate_;
  return user;
}

void Planner::move_legs(Situation& now) {
  gait().observe(now, body_);
  if (learns_ground_ && !calibration_.is_going_on()) relearn_ground();
  const GaitOutcome outcome = gait().advance(now, body_);
  if (outcome.begins_step) limits_.begin_step(command_context());
  if (outcome.hands_over) {
    walks_ = !walks_;
    gait().begin(now, body_, outcome.first);
  }
  rest_.update(now.state, !walks_ && body_.legs.all_down());
}

// No other event shares the tick of a restart.
void Planner::finish_calibration(const RobotState& state) {
  EventList& events = body_.events;
  if (events.empty()) events.add({.kind = calibration_.take_end()});
  restarts_ = calibration_.is_wanted() && events.empty() && !calibration_.is_going_on() &&
              rest_.is_at_rest(state);
  if (restarts_) events.add({.kind = PlanEvent::calibration});
  if (restarts_) return;
  if (!calibration_.is_due()) limits_.report(events);
  events.add({.kind = calibration_.take_waiting()});
}

void Planner::write_plan(const Situation& now) {
  plan_.time = now.time;
  for (const Leg k : body_.legs.all()) {
    plan_.feet[index(k)] = body_.legs[k].plan(now.time);
    plan_.feet[index(k)].friction = body_.grip.friction(k);
  }
  plan_.com = gait().com(now, body_);
  plan_.com_zmp_slack = body_.com.zmp_slack();
  const double height = body_.options.stance.height + now.user.height;
  torso_.update(body_.plane, yaw_, yaw_rate_, plan_.com, height, calibration_.motion());
  plan_.torso = torso_.plan();
  friction_frame_.update(body_.plane.normal);
  plan_.R_WC = estimation::control_frame(friction_frame_.normal(), yaw_);
  plan_.terrain_point = body_.plane.point;
  plan_.calibration = calibration_.stage();
  plan_.events = body_.events;
}

bool Planner::is_undisturbed(const RobotState& state) const {
  return plan_.num_contacts() == body_.options.gait.num_legs() &&
         std::ranges::none_of(state.slips, std::identity{}) &&
         state.external_force.head<2>().isZero();
}

}  // namespace surefoot::gaits
