#include "surefoot/gaits/planner.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/gaits/undisturbed.hpp"
#include "surefoot/math/rotation.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace surefoot::gaits {

namespace {

constexpr double kBlendDuration = 0.2;    // of references, from gait to gait, at least [s]
constexpr double kMaxChangeSpeed = 0.65;  // at which gaits change: the feet stand for longer [m/s]
// Where other legs step together, the first ones of the new gait don't begin at the end of their
// stance, so the others carry the robot for long.
constexpr double kMaxSwitchSpeed = 0.3;
constexpr double kMaxRestSpeed = 0.15;  // before a gait that begins at rest [m/s]
constexpr double kChangeMargin = 1.1;   // of the speed in a change of gait, over the gait's

/// Those of the gait of legs that step in turn, or the own ones.
const PlannerOptions& of_crawl(const PlannerOptions& own, const std::vector<NamedGait>& gaits) {
  const auto steps = [](const PlannerOptions& o) { return !o.rhythm.enabled && !o.rhythm.stands; };
  const auto crawl = std::ranges::find_if(
      gaits, [&](const NamedGait& gait) { return steps(gait.options) && !gait.make; });
  return steps(own) || crawl == gaits.end() ? own : crawl->options;
}

bool steps_alike(const RhythmOptions& a, const RhythmOptions& b) {
  return a.enabled && b.enabled && std::ranges::equal(a.offset, b.offset);
}

std::shared_ptr<Gait> made(const NamedGait& gait, double period, const Scale& scale) {
  if (!gait.make) return nullptr;
  std::shared_ptr<Gait> own = gait.make(gait.options, period, scale);
  if (own == nullptr) throw Error("gait \"" + gait.name + "\": its factory gave no gait");
  return own;
}

}  // namespace

Planner::Planner(const PlannerOptions& options, double period, const Scale& scale,
                 const std::vector<NamedGait>& gaits, int first)
    : body_(options, period, scale),
      flat_stand_(options.force, period, scale),
      crawl_(of_crawl(options, gaits)),
      choice_(options, gaits, first),
      present_(choice_.first()),
      wanted_(present_),
      limits_(options, period, scale),
      torso_(options.torso, period),
      friction_frame_(options.friction_frame, period),
      calibration_(options.calibration, scale),
      rest_(scale),
      hips_(options.gait.num_legs(), Vec2::Zero()) {
  plan_.feet.resize(options.gait.num_legs());
  for (int gait = UserCommand::kOwnGait; gait < choice_.size(); ++gait)
    rhythms_.emplace_back(choice_.options(gait), scale);
  own_.emplace_back();
  names_.emplace_back();
  for (const NamedGait& gait : gaits) {
    own_.push_back(made(gait, period, scale));
    names_.push_back(gait.name);
  }
  if (present_ == UserCommand::kOwnGait) return;
  body_.use(choice_.options(present_), 0.0);
  limits_.use(choice_.options(present_));
}

void Planner::begin_anew(const Planner& fresh) {
  const int steps_taken = body_.steps_taken;
  *this = fresh;
  body_.steps_taken = steps_taken;
  for (const std::shared_ptr<Gait>& own : own_) {
    if (own != nullptr) own->restart();
  }
}

void Planner::set_friction(double friction) {
  if (!(friction > 0.0) || !std::isfinite(friction)) {
    throw Error(formatted("friction is %g; valid is a number above 0", friction));
  }
  body_.grip.expect(friction);
  flat_stand_.set_friction(friction);
}

const MotionPlan& Planner::update(const UserCommand& command, const RobotState& state,
                                  const model::Dynamics& dynamics, const HierarchyOutcome& last) {
  if (dynamics.has_flat_feet()) {
    flat_stand_.update(command, state, dynamics, plan_);
    return plan_;
  }
  try {
    plan(command, state, dynamics, last);
  } catch (const std::exception& error) {
    const auto place = static_cast<std::size_t>(present_ + 1);
    if (own_[place] == nullptr) throw;
    throw Error("gait \"" + names_[place] + "\": " + error.what());
  }
  return plan_;
}

void Planner::plan(const UserCommand& command, const RobotState& state,
                   const model::Dynamics& dynamics, const HierarchyOutcome& last) {
  body_.events = {};
  if (!initialised_) calibration_.expect_switch(command.calibrate);  // a calibration begins anyway
  if (!initialised_ || restarts_) initialise(state, dynamics);
  calibration_.update(state.time, command.calibrate, is_undisturbed(state));
  wanted_ = choice_.wanted(command, wanted_);
  const UserCommand user = limit(command);
  Situation now{state.time, yaw_, user, state, dynamics, last, plan_, body_};
  move_legs(now);
  finish_calibration(state);
  write_plan(now);
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
                         .stands = !walks_ || (!walk().is_static() && walk().waits(body_)),
                         .starts_at_rest = choice_.options(wanted_).rhythm.enabled,
                         .calibrates = calibration_.is_due(),
                         .speed_max = speed_max()};
  if (!walk().is_static()) return context;
  context.caution = std::max(context.caution, body_.balance.caution());
  const Mat2 R = rotation_about_z(-yaw_).topLeftCorner<2, 2>();
  for (Vec2& hip : context.hips) hip -= R * body_.balance.shift();
  return context;
}

// The heading waits for the feet: otherwise late steps would leave them twisted under the torso.
UserCommand Planner::limit(const UserCommand& command) {
  CommandContext now = command_context();
  now.knows_gait = choice_.has(command.gait);
  const bool stands = choice_.options(wanted_).rhythm.stands;
  const bool walks = command.walk && !calibration_.is_due() && !stands;
  UserCommand asked = command;
  if (stands || (!walks && !walk().is_static())) {  // it stops step by step
    asked.velocity.setZero();
    asked.yaw_rate = 0.0;
  }
  UserCommand user = limits_.update(asked, now);
  user.walk = user.walk && walks;
  if (walk().is_static()) {
    user.yaw_rate *= limits_.strides().turning_share(user.yaw_rate, body_.legs.footholds(),
                                                     body_.legs.down(), yaw_, now.cycle_duration);
  }
  const bool turns = user.walk || !walk().is_static();
  yaw_rate_ = turns && !gait().waits(body_) ? user.yaw_rate : 0.0;
  yaw_ += body_.period * yaw_rate_;
  return user;
}

// A gait that is slower than the present one begins when the robot is as slow.
bool Planner::may_change() const {
  return wanted_ != present_ && walk().speed() <= kChangeMargin * speed_max();
}

double Planner::speed_max() const {
  const RhythmOptions &wanted = choice_.options(wanted_).rhythm,
                      &present = choice_.options(present_).rhythm;
  if (!walks_ || wanted_ == present_) return wanted.enabled ? wanted.speed_max : kInfinity;
  const double change = begins_at_rest(wanted, body_.scale) ? kMaxRestSpeed
                        : steps_alike(wanted, present)      ? kMaxChangeSpeed
                                                            : kMaxSwitchSpeed;
  return std::min({wanted.speed_max, present.speed_max, body_.scale.speed() * change});
}

void Planner::change_gait(double time) {
  present_ = wanted_;
  body_.use(choice_.options(present_), time);
  limits_.use(choice_.options(present_));
  body_.events.add({.kind = PlanEvent::gait_changed});
}

void Planner::move_legs(Situation& now) {
  if (!walks_ && wanted_ != present_ && body_.legs.all_down()) change_gait(now.time);
  now.yields = walks_ && now.user.walk && may_change();
  now.next = &choice_.options(now.user.walk ? wanted_ : UserCommand::kOwnGait);
  gait().observe(now, body_);
  if (learns_ground_ && !calibration_.is_going_on()) relearn_ground();
  const GaitOutcome outcome = gait().advance(now, body_);
  if (outcome.begins_step) limits_.begin_step(command_context());
  has_new_gait_ =
      outcome.has_new_reference || (outcome.hands_over && (now.yields || !walk().is_static()));
  if (outcome.hands_over) {
    walks_ = now.yields || !walks_;
    if (now.yields) change_gait(now.time);
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
  const ComPlan com = plan_.com;
  const TorsoPlan torso = plan_.torso;
  plan_.time = now.time;
  for (const Leg k : body_.legs.all()) {
    plan_.feet[index(k)] = body_.legs[k].plan(now.time);
    plan_.feet[index(k)].friction = body_.grip.friction(k);
  }
  plan_.com = gait().com(now, body_);
  plan_.com_zmp_slack = body_.com.zmp_slack();
  const double height = body_.options.stance.height + (now.user.height + gait().height());
  torso_.update(body_.plane, yaw_, yaw_rate_, plan_.com, height, turn(now.time));
  plan_.torso = torso_.plan();
  const Motion<double> bounce = gait().bounce();
  plan_.torso.height += bounce.p;
  plan_.torso.height_rate += bounce.v;
  plan_.torso.height_acceleration += bounce.a;
  // A planned COM begins where it is, again with each plan: an offset would drive it away.
  const ComPlan& from = gait().is_static() ? plan_.com : com;
  if (has_new_gait_)
    blend_.begin(now.time, from, torso, plan_, body_.scale.time() * kBlendDuration);
  blend_.apply(now.time, plan_);
  friction_frame_.update(body_.plane.normal);
  plan_.R_WC = estimation::control_frame(friction_frame_.normal(), yaw_);
  plan_.terrain_point = body_.plane.point;
  plan_.calibration = calibration_.stage();
  plan_.gait = present_;
  plan_.events = body_.events;
}

Motion<Vec3> Planner::turn(double time) {
  const Motion<double> pitch = gait().pitch();
  if (has_new_gait_)
    blend_.begin_pitch(time, pitch_, pitch, body_.scale.time() * kBlendDuration, body_.scale);
  const Motion<double> left = blend_.pitch(time);
  pitch_ = {pitch.p + left.p, pitch.v + left.v, pitch.a + left.a};
  Motion<Vec3> result = calibration_.motion();
  result.p.y() += pitch_.p;
  result.v.y() += pitch_.v;
  result.a.y() += pitch_.a;
  return result;
}

bool Planner::is_undisturbed(const RobotState& state) const {
  return gaits::is_undisturbed(plan_, state);
}

}  // namespace surefoot::gaits
